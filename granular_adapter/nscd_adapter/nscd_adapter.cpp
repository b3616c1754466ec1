// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"

#include <chrono>
#include <exception>
#include <stdexcept>
#include <utility>

#include "coupler/protocol/even_shares.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "granular_adapter/grains/case_bodies.hpp"
#include "granular_adapter/grains/inner_walls.hpp"
#include "granular_adapter/nscd/laws/law_list.hpp"
#include "granular_adapter/nscd/ranks/gathered.hpp"
#include "granular_adapter/nscd_adapter/contact_records.hpp"
#include "granular_adapter/nscd_adapter/contact_settings.hpp"
#include "granular_adapter/nscd_adapter/free_motion.hpp"

namespace turbidite {
namespace {

class StopWatch {
 public:
    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

 private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::string in_window(const Window& window) {
    return "in window " + std::to_string(window.index);
}

ContactReport report_of(const nscd::StepReport& step) {
    ContactReport report;
    report.contacts = step.contacts;
    report.iterations = step.iterations;
    report.residual = step.residual;
    report.quad = step.change.quad;
    report.max = step.change.max;
    report.converged = step.converged;
    report.max_penetration = step.max_penetration;
    return report;
}

nscd::Engine& initialised(const std::unique_ptr<nscd::Engine>& engine) {
    if (!engine) throw std::logic_error("the contact engine was called before initialise()");
    return *engine;
}

}  // namespace

NscdAdapter::NscdAdapter(std::string adapter_name, std::string host_code)
    : names_{std::move(adapter_name), std::move(host_code)} {
    keep_freed_memory();
}

Hello NscdAdapter::describe() const {
    Hello hello;
    hello.role = Role::grains;
    hello.adapter = names_.adapter;
    hello.adapter_version = TURBIDITE_VERSION;
    hello.host_code = names_.host_code;
    hello.dimension = both_dimensions;
    hello.capabilities.saves_state = true;
    hello.capabilities.serialises_state = true;
    hello.capabilities.effective_inertia = true;
    for (const auto& entry : nscd::wall_detector_list())
        hello.capabilities.shapes.push_back(entry.kind);
    for (const auto& entry : nscd::law_list())
        if (!entry.adds_nothing()) hello.capabilities.contact_laws.push_back(entry.name);
    return hello;
}

Motion NscdAdapter::initialise(const Settings& settings, const ShapeTable& shapes,
                               const std::vector<GrainState>& grains) {
    const StopWatch watch;
    dumps_ = ProblemDumps(settings, run_folder_);
    run_ = run_values(settings);
    positions_ = parse_positions(settings.text("coupling.positions"));
    borders_ = lay_borders(settings);
    driven_.walls = motions_of(settings, "run.wall_motions");
    driven_.grains = motions_of(settings, "run.grain_motions");
    std::vector<nscd::Wall> walls = walls_of(borders_);
    // Sides first, then the walls inside the box, whose keys follow theirs.
    for (const nscd::Wall& wall : inner_walls(settings)) walls.push_back(wall);
    engine_ = std::make_unique<nscd::Engine>(engine_settings(settings), shapes, walls);
    if (ranks_) engine().share_with(*ranks_);
    report_ = {};
    agree([&] {
        // Refused only if no responses come: with them the fluid gives such grains an inertia.
        light_ = first_light_grain(run_, shapes, grains);
        add_grains(bodies(), run_, shapes, grains);
        check_inside(bodies(), borders_, "at the start");
    });
    if (broken_) return motion();
    engine().check_periods();
    twists_.start = bodies().twist;
    // Velocities at t^n go with the bodies to other ranks, for rounds that begin again there.
    engine().carry(twists_.start);
    report_.max_penetration = engine_->max_penetration();
    report_.wall_seconds = watch.seconds();
    return motion();
}

Motion NscdAdapter::advance(const Window& window, const std::vector<FreeResponse>& responses) {
    const StopWatch watch;
    begin_round();
    // What can fail on one rank is agreed on before the next call that all ranks make together:
    // otherwise the others would wait in it for ever.
    agree([&] { check_inside(bodies(), borders_, in_window(window) + " before contacts"); });
    // After begin_round(), which keeps the velocities at t^n or restores them.
    set_velocities(engine().walls(), driven_.walls, window.time, window.step);
    set_velocities(bodies(), driven_.grains, window.time, window.step);
    const nscd::StepReport step = solve_contacts(window, responses);
    agree([&] { check_velocities(bodies(), in_window(window) + " after contacts"); });
    twists_.contact = bodies().twist;
    report_ = report_of(step);
    report_.wall_seconds = watch.seconds();
    return motion();
}

// An advance that is repeated before the kick starts at t^n again; the contact impulses are kept.
void NscdAdapter::begin_round() {
    // Empty after a kick: then this is the first round of a window.
    const bool again = !twists_.contact.empty() && twists_.contact.size() == bodies().size();
    if (again)
        bodies().twist = twists_.start;
    else
        twists_.start = bodies().twist;
}

nscd::StepReport NscdAdapter::solve_contacts(const Window& window,
                                             const std::vector<FreeResponse>& responses) {
    FreeMotion free;
    // A rank without grains gets no responses, but takes part in the same kind of step.
    answered_ = on_any_rank(!responses.empty());
    // Nor does anybody answer where all grains have left.
    const bool any_grain = on_any_rank(bodies().size() > 0);
    agree([&] {
        if (!answered_ && any_grain && light_) refuse_light_grain(*light_);
        if (answered_)
            free =
                free_motion(bodies(), responses, in_window(window), engine().settings().dimension);
    });
    if (broken_) return {};
    // Without responses: free motion under the submerged weight, with the inertia cM of step 4.
    if (!answered_) return engine().step(window.step);
    // Free velocities and inertia of grain and fluid together, from the responses.
    return engine().step_from(free.velocities, std::move(free.mobilities), window.step);
}

Motion NscdAdapter::apply_kick(const Window& window, const std::vector<Kick>& kicks) {
    const StopWatch watch;
    if (twists_.contact.size() != bodies().size())
        throw std::logic_error("apply_kick must be preceded by advance in the same window");
    dumps_.after(window, engine().problem());
    agree([&] {
        // Dry cases have no kicks: the velocities of the contacts are final.
        if (run_.wet || !kicks.empty())
            take_velocities(bodies(), kicks, in_window(window), run_.dimension);
        check_velocities(bodies(), in_window(window) + " after the kick");
    });
    if (broken_) return motion();
    std::optional<std::vector<ContactRecord>> contacts;
    // Before the move: records need the positions at which contacts were found.
    if (window.write_output) contacts = contact_records(engine());
    // With the velocities that the fluid has corrected, against the conditions of this window's
    // contacts.
    report_.contact_violation = engine().contact_violation();
    if (engine().settings().law.film != "none") report_.film_work = engine().film_work();
    // q^{n+1} = q^n + dt U^{n+4/5} or, where a fluid without responses has corrected the velocities
    // and the case says so, q^n + dt U^{n+1}. Gaps were closed for U^{n+4/5}: after responses it is
    // always taken.
    const bool with_contact = answered_ || positions_ == Positions::contact;
    engine().move(window.step, with_contact ? twists_.contact : bodies().twist);
    if (!driven_.walls.empty()) follow_walls(borders_, engine().walls());
    twists_.contact.clear();
    remove_leavers();
    twists_.start = bodies().twist;
    agree([&] { check_places(bodies(), borders_, in_window(window) + " after motion"); });
    if (broken_) return motion();
    report_.removed = static_cast<std::int64_t>(removed_.own.size());
    report_.max_penetration = engine().max_penetration_after_move();
    Motion result = motion();
    if (contacts) drop_contacts_of(removed_.of_all_ranks, *contacts);
    result.contacts = std::move(contacts);
    result.report.wall_seconds = report_.wall_seconds = watch.seconds();
    return result;
}

SavedState NscdAdapter::save() const {
    return engine().save();
}

void NscdAdapter::restore(const SavedState& state) {
    engine().restore(state);
    follow_walls(borders_, engine().walls());
    twists_.contact.clear();
    twists_.start = bodies().twist;
    removed_.own.clear();
}

void NscdAdapter::restore_from(const std::vector<SavedState>& of_ranks) {
    // Every rank reads all of them and keeps its even share.
    engine().restore_from(of_ranks);
    const int ranks = ranks_ ? ranks_->size() : 1, own = ranks_ ? ranks_->rank() : 0;
    std::vector<std::uint8_t> mine;
    for (const int rank : even_shares(grain_states(bodies()), ranks)) mine.push_back(rank == own);
    engine().keep(mine);
    follow_walls(borders_, engine().walls());
    twists_.contact.clear();
    twists_.start = bodies().twist;
    removed_.own.clear();
}

bool NscdAdapter::on_any_rank(bool here) const {
    return ranks_ && !broken_ ? nscd::any(*ranks_, here) : here;
}

/// A check that may fail on one rank only.
template <class Check>
void NscdAdapter::agree(Check check) {
    if (!ranks_) return check();
    if (broken_) return;
    std::exception_ptr failure;
    try {
        check();
    } catch (...) {
        failure = std::current_exception();
    }
    broken_ = on_any_rank(failure != nullptr);
    // The failing rank ends with its own error; the others only know that one of them has failed.
    if (failure) std::rethrow_exception(failure);
}

const nscd::Engine& NscdAdapter::engine() const {
    return initialised(engine_);
}

nscd::Engine& NscdAdapter::engine() {
    return initialised(engine_);
}

NscdAdapter::Positions NscdAdapter::parse_positions(const std::string& text) {
    if (text == "corrected") return Positions::corrected;
    if (text == "contact") return Positions::contact;
    throw std::invalid_argument("coupling.positions = \"" + text +
                                "\"; allowed: corrected, contact");
}

nscd::EngineSettings NscdAdapter::engine_settings(const Settings& settings) const {
    nscd::EngineSettings result = contact_settings(settings);
    result.dimension = run_.dimension;
    result.gravity = {0.0, -run_.gravity, 0.0};
    result.box.length = run_.period;
    return result;
}

void NscdAdapter::remove_leavers() {
    const nscd::Bodies& all = bodies();
    const std::vector<std::uint8_t> stays = those_inside(all, borders_);
    removed_.own.clear();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (!stays[i]) removed_.own.push_back(all.id[i]);
    removed_.of_all_ranks = ranks_ ? nscd::gathered(*ranks_, removed_.own) : removed_.own;
    // On all ranks if on one: keep() also forgets the points of the step, which ranks share.
    if (!removed_.of_all_ranks.empty()) engine().keep(stays);
}

Motion NscdAdapter::motion() const {
    return {grain_states(bodies()), report_};
}

}  // namespace turbidite
