// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/md/md_adapter.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <stdexcept>
#include <utility>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/grains/by_grain.hpp"
#include "granular_adapter/grains/case_bodies.hpp"
#include "granular_adapter/md/first_positions.hpp"
#include "granular_adapter/md/rows.hpp"
#include "granular_adapter/nscd/engine/theta_scheme.hpp"
#include "granular_adapter/nscd/problem/byte_stream.hpp"
#include "granular_adapter/nscd_adapter/contact_records.hpp"

namespace turbidite {
namespace {

using Clock = std::chrono::steady_clock;

// A contact impulse below this fraction of the terms of a grain's momentum balance is rounding.
constexpr double round_off = 1e-11;

// Springs that are too soft let a grain through a wall, however short the sub-steps.
constexpr const char* stiffer = "use a larger contact.md_stiffness, or a smaller time.step";

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string in_window(const Window& window) {
    return "in window " + std::to_string(window.index);
}

void refuse_cyclic(const std::vector<Border>& borders) {
    for (const Border& border : borders)
        if (border.side == BorderKind::cyclic)
            throw std::invalid_argument("domain." + border.name +
                                        " = cyclic, which this molecular dynamics does not support "
                                        "in this version; allowed: wall, free");
}

std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
    return list;
}

void refuse_other_shapes(const ShapeTable& shapes, const std::vector<std::string>& known) {
    for (const ShapeRecord& shape : shapes)
        if (std::find(known.begin(), known.end(), shape.kind) == known.end())
            throw std::invalid_argument(
                "shape \"" + shape.kind +
                "\" is unknown to this molecular dynamics; allowed: " + listed(known));
}

}  // namespace

MdAdapter::MdAdapter(std::string adapter_name, MdHost& host)
    : adapter_name_(std::move(adapter_name)), host_(host) {}

Hello MdAdapter::describe() const {
    Hello hello;
    hello.role = Role::grains;
    hello.adapter = adapter_name_;
    hello.adapter_version = TURBIDITE_VERSION;
    hello.host_code = host_.code();
    hello.dimension = host_.dimension();
    hello.capabilities.saves_state = true;
    hello.capabilities.restores_within_window = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.native_substeps = true;
    hello.capabilities.shapes = host_.shapes();
    hello.capabilities.contact_laws = {"linear-spring-dashpot"};
    return hello;
}

Motion MdAdapter::initialise(const Settings& settings, const ShapeTable& shapes,
                             const std::vector<GrainState>& grains) {
    const auto start = Clock::now();
    run_ = run_values(settings);
    hold_ = settings.flag("coupling.md_hold");
    repeats_ = settings.has("run.repeats_windows") && settings.flag("run.repeats_windows");
    substep_count_ = settings.integer("run.md_substeps");
    borders_ = lay_borders(settings);
    if (!host_.repeats()) refuse_cyclic(borders_);
    box_.length = run_.period;
    refuse_other_shapes(shapes, host_.shapes());
    agree([&] {
        if (const auto light = first_light_grain(run_, shapes, grains)) refuse_light_grain(*light);
        add_grains(bodies_, run_, shapes, grains);
        // From the positions of the protocol to those of the host.
        ahead_ = take_first_positions(bodies_, lead(), run_, shapes, walls_of(borders_));
        check_inside(bodies_, borders_, "at the start");
    });
    if (broken_) return motion(bodies_);
    held_.assign(bodies_.size(), {});
    host_.create(settings, shapes, bodies_);
    follow_migration(nullptr);
    report_ = {};
    report_.max_penetration = deepest_overlap(bodies_, run_, shapes, walls_of(borders_));
    report_.wall_seconds = seconds_since(start);
    return motion(at_protocol_positions());
}

/// What velocities are behind the host's positions, in time [s].
double MdAdapter::velocity_lag() const {
    // s: delta for leap-frog, 0 for velocity Verlet.
    return host_.velocity_lag() * (run_.step / static_cast<double>(substep_count_));
}

/// How far the protocol's positions are ahead of the host's, in time [s].
double MdAdapter::lead() const {
    return 0.5 * (run_.step - velocity_lag());
}

Substeps MdAdapter::substeps(const Window& window) const {
    const double count = static_cast<double>(substep_count_);
    return {substep_count_, window.step / count, window.write_output};
}

/// The host applies the same gravity to every body; the difference to the body's own weight is a
/// load.
Load MdAdapter::load(std::size_t i, double dt) const {
    // F = J_h/dt + (cM - m_w) g e_y: the weight is m_w g, but the host itself adds -cM g e_y.
    const Vec3 buoyant{0.0, (bodies_.mass[i] - bodies_.weight_mass[i]) * run_.gravity, 0.0};
    return {(1.0 / dt) * held_[i].impulse + buoyant, (1.0 / dt) * held_[i].angular_impulse};
}

Motion MdAdapter::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    const auto start = Clock::now();
    if (!responses.empty() && !repeats_)
        throw std::runtime_error(
            "responses of the fluid were received " + in_window(window) +
            ", but molecular dynamics cannot use them: use coupling.scheme split");
    if (!responses.empty()) repeat(window, responses);
    // The first round of a window, which later ones begin from.
    if (responses.empty() && repeats_) present_.start = save();
    Motion result = play(window);
    result.report.wall_seconds = report_.wall_seconds = seconds_since(start);
    return result;
}

/// Back to t^n with other impulses to hold.
void MdAdapter::repeat(const Window& window, const std::vector<FreeResponse>& targets) {
    const auto ordered = by_grain(bodies_.id, targets, "response", in_window(window));
    std::vector<Held> held = held_;
    for (std::size_t i = 0; i < held.size(); ++i) {
        const Twist& found = bodies_.twist[i];
        // Held next: J_h + cM (U - U^{n+4/5}), which leads to U if contacts stay as they were.
        held[i].impulse =
            held[i].impulse + bodies_.mass[i] * (ordered[i]->velocity - found.velocity);
        held[i].angular_impulse =
            held[i].angular_impulse +
            bodies_.world_inertia(i) * (ordered[i]->angular_velocity - found.spin);
    }
    read(present_.start);
    held_ = std::move(held);
}

Motion MdAdapter::play(const Window& window) {
    host_.read(bodies_);
    agree(
        [&] { check_inside(bodies_, borders_, in_window(window) + " before contacts", stiffer); });
    present_.advanced = true;
    if (broken_) return motion(at_protocol_positions());
    // Answered are q^n, at which the fluid solves step 5, and U^{n+4/5}: positions are taken before
    // the sub-steps, velocities and impulses after them.
    nscd::Bodies sent = at_protocol_positions();
    std::vector<Load> loads;
    for (std::size_t i = 0; i < bodies_.size(); ++i) loads.push_back(load(i, window.step));
    SubstepReport run = host_.run(substeps(window), loads);
    follow_migration(&sent);
    present_.orientation_at_start = sent.orientation;
    host_.read(bodies_);
    agree([&] { check_inside(bodies_, borders_, in_window(window) + " after contacts", stiffer); });
    book_contacts(sent.twist, run, window.step);
    present_.contacts.reset();
    if (window.write_output) present_.contacts = std::move(run.touching);
    sent.twist = bodies_.twist;
    sent.contact_impulse = bodies_.contact_impulse;
    sent.contact_angular_impulse = bodies_.contact_angular_impulse;
    report_ = {};
    report_.contacts = run.contacts;
    report_.iterations = substep_count_;
    report_.max_penetration = run.max_penetration;
    return motion(sent);
}

/// J_c = cM (U^{n+4/5} - U^n) - J_h - weight dt, unless the host summed the impulses.
void MdAdapter::book_contacts(const std::vector<Twist>& before, const SubstepReport& run,
                              double dt) {
    present_.touched.assign(bodies_.size(), 0);
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Vec3 weight{0.0, -bodies_.weight_mass[i] * run_.gravity * dt, 0.0};
        // cM (U^{n+4/5} - U^n), and the same for the spin
        const Vec3 gained = bodies_.mass[i] * (bodies_.twist[i].velocity - before[i].velocity);
        const Vec3 turned = bodies_.world_inertia(i) * (bodies_.twist[i].spin - before[i].spin);
        const Held& held = held_[i];
        Vec3& impulse = bodies_.contact_impulse[i];
        Vec3& angular = bodies_.contact_angular_impulse[i];
        impulse = gained - held.impulse - weight;
        angular = turned - held.angular_impulse;
        const double scale = norm(held.impulse) + norm(weight) + norm(gained) +
                             bodies_.mass[i] * norm(before[i].velocity);
        // By the balance of momentum in all windows, also where the host has summed the impulses:
        // which grains are moved with the kick must not depend on whether a window has output.
        present_.touched[i] = norm(impulse) > round_off * scale;
        if (run.impulses.empty()) continue;
        // The host's sum has all forces but gravity: less the loads that it was given, J_c remains.
        const Load given = load(i, dt);
        impulse = run.impulses[i] - dt * given.force;
        angular = run.angular_impulses[i] - dt * given.torque;
    }
}

Motion MdAdapter::apply_kick(const Window& window, const std::vector<Kick>& kicks) {
    const auto start = Clock::now();
    if (!present_.advanced)
        throw std::logic_error("apply_kick must be preceded by advance in the same window");
    present_.advanced = false;
    agree([&] {
        if (run_.wet || !kicks.empty()) take_kicks(window, kicks);
        check_inside(bodies_, borders_, in_window(window) + " after the kick", stiffer);
    });
    ahead_.reset();  // the first window is over
    if (!broken_) remove_leavers();
    report_.wall_seconds = seconds_since(start);
    Motion result = motion(at_protocol_positions());
    result.contacts = std::exchange(present_.contacts, std::nullopt);
    return result;
}

/// A check that may fail on one rank only: the others learn of it, so that they do not wait for
/// that rank. They go on as if nothing had happened until the coupler ends the run.
template <class Check>
void MdAdapter::agree(Check check) {
    std::exception_ptr failure;
    try {
        check();
    } catch (...) {
        failure = std::current_exception();
    }
    const bool all_pass = broken_ ? false : host_.on_all_ranks(!failure);
    if (failure) std::rethrow_exception(failure);
    broken_ = !all_pass;
}

void MdAdapter::take_kicks(const Window& window, const std::vector<Kick>& kicks) {
    const std::vector<Twist> with_contact = bodies_.twist;
    const auto ordered = by_grain(bodies_.id, kicks, "kick", in_window(window));
    take_velocities(bodies_, kicks, in_window(window), run_.dimension);
    // x^{n+1} = x' + (dt + s)/2 (U^{n+1} - U^{n+4/5}), without contact only.
    const double lag = 0.5 * (window.step + velocity_lag());
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        const Twist& now = bodies_.twist[i];
        if (!present_.touched[i]) {
            bodies_.position[i] =
                bodies_.position[i] + lag * (now.velocity - with_contact[i].velocity);
            // From t^n on about one axis: turns about two do not commute in space, and the state
            // must be that of t^n turned by dt omega^{n+1}.
            bodies_.orientation[i] = rotated(present_.orientation_at_start[i], lag * now.spin);
        }
        // The multiplier impulse of this window is J_h of the next, in place of what the last of
        // its repetitions has held.
        held_[i] =
            hold_ ? Held{ordered[i]->multiplier_impulse, ordered[i]->multiplier_angular_impulse}
                  : Held{};
    }
    host_.write(bodies_);
}

void MdAdapter::remove_leavers() {
    // Judged at the positions of the protocol, as the contact engine does.
    const std::vector<std::uint8_t> stays = those_inside(at_protocol_positions(), borders_);
    report_.removed = std::count(stays.begin(), stays.end(), 0);
    // On several ranks all go on, since what follows is collective.
    if (report_.removed == 0 && !host_.shares_bodies()) return;
    std::vector<Held> kept;
    std::vector<GrainId> gone;
    for (std::size_t i = 0; i < stays.size(); ++i)
        if (stays[i])
            kept.push_back(held_[i]);
        else
            gone.push_back(bodies_.id[i]);
    held_ = std::move(kept);
    if (present_.contacts) drop_contacts_of(host_.from_all_ranks(gone), *present_.contacts);
    bodies_.keep(stays);
    host_.keep(stays);
}

/// Bodies, with those at the protocol's positions if they are given, and what they hold, after the
/// host has moved them between ranks.
void MdAdapter::follow_migration(nscd::Bodies* sent) {
    if (!host_.migrated()) return;
    RowPacker packer;
    const auto visit = [&](auto&& each) {
        nscd::Bodies::for_each_array(bodies_, each);
        if (sent) nscd::Bodies::for_each_array(*sent, each);
        each(held_);
        if (ahead_) each(*ahead_);
    };
    // One row of bytes per body, with all arrays in the same order on both sides.
    visit([&](auto& array) { packer.measure(array); });
    std::vector<char> rows = packer.empty_rows(bodies_.size());
    visit([&](auto& array) { packer.pack(array, rows); });
    rows = host_.migrate(rows, packer.row_size());
    visit([&](auto& array) { packer.unpack(rows, array); });
}

nscd::Bodies MdAdapter::at_protocol_positions() const {
    nscd::Bodies sent = bodies_;
    nscd::move(sent, sent.twist, lead(), box_);
    if (ahead_) put_where(*ahead_, bodies_, sent);
    return sent;
}

Motion MdAdapter::motion(const nscd::Bodies& bodies) const {
    Motion result{grain_states(bodies), report_};
    for (std::size_t i = 0; i < held_.size(); ++i) {
        // The fluid subtracts what the grains have felt already: cM (U^{n+1} - U^{n+4/5}) = dt
        // lambda - J_h.
        result.grains[i].announced_impulse = held_[i].impulse;
        result.grains[i].announced_angular_impulse = held_[i].angular_impulse;
    }
    return result;
}

SavedState MdAdapter::save() const {
    nscd::ByteWriter writer;
    nscd::Bodies::for_each_array(bodies_, [&](const auto& array) { writer.array(array); });
    writer.array(held_);
    writer.array(host_.save());
    return writer.take();
}

void MdAdapter::restore(const SavedState& state) {
    ahead_.reset();
    read(state);
}

void MdAdapter::read(const SavedState& state) {
    nscd::ByteReader reader(state);
    nscd::Bodies::for_each_array(bodies_, [&](auto& array) {
        array = reader.array<typename std::decay_t<decltype(array)>::value_type>();
    });
    held_ = reader.array<Held>();
    host_.restore(reader.array<char>());
    follow_migration(nullptr);
    present_.advanced = false;
}

}  // namespace turbidite
