// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/contact_requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupler/keys/key_spec.hpp"
#include "launcher/adapter_test/trial_grain.hpp"
#include "launcher/adapter_test/trial_recording.hpp"

namespace turbidite {
namespace {

constexpr double friction = 0.3;
// A normal force that is a spring's swings about the weight while a disc slides.
constexpr double rolling_tolerance = 0.03;  // [u_c]
// Small enough that two grains still slip when they part, also if they bounce: at a restitution of
// one mu < v_t/(6 v_n) for discs, v_t/(7 v_n) for spheres.
constexpr double glancing_friction = 0.12;
// Springs whose dashpot is not part of the Coulomb limit push harder in an impact without
// restitution: YADE's 2.2 times, sliding contacts of every code as Coulomb says (docs/md.md).
constexpr double with_a_dashpot = 2.5;
// The normal turns while springs act, by a few hundredths.
constexpr double glancing_tolerance = 0.05;

const std::string on_the_floor = "id,x,y,vx\n11,3,0.5,1\n";
// They meet at 45 degrees with 1 u_c.
const std::string passing = "id,x,y,vx\n12,5,8,0.5\n13,6.2,8.70710678,-0.5\n";
const std::string held_and_driven =
    "id,x,y,vx,motion\n7,4,3,0,fixed\n8,9,3,0.5,driven\n9,4,4.3,0,free\n";
const std::string stacked = "id,x,y\n7,3,0.5\n8,3,1.5\n9,9,0.8\n";

using Dry = std::vector<std::string>;

TrialCase dry(const std::string& name, const std::string& grains, const Dry& more) {
    TrialCase trial{name, grains, {"fluid.enabled=false"}};
    trial.overrides.insert(trial.overrides.end(), more.begin(), more.end());
    return trial;
}

/// Why a trial that did not run to its end did not: `what` the program may refuse.
Finding not_done(const Trial& trial, const std::string& what) {
    if (const auto words = refusal_of(trial))
        return {Grade::not_supported, "refuses " + what + ": " + *words};
    return failure_of(trial.outcome);
}

Vec3 unit(const Vec3& a) {
    return a / norm(a);
}

/// |J_t| <= mu |J_n| in a window, with what the normal may turn in it.
bool within_the_cone(double normal, double tangential, double mu) {
    const double size = std::hypot(normal, tangential);
    return std::abs(tangential) <= mu * std::abs(normal) + 0.02 * size;
}

Finding beyond_the_cone(std::size_t window, double normal, double tangential, double mu) {
    return {Grade::failed,
            fmt::format("in window {} the tangential impulse is {:.3g} of the normal one, "
                        "contact.friction = {}",
                        window, std::abs(tangential / normal), mu)};
}

/// With I = k m R^2: u = max(u_0/(1 + k), u_0 - mu g t), and the surface moves against it:
/// R omega = -(u_0 - u)/k. Discs k = 1/2, spheres 2/5.
Finding judge_rolling(const Trial& trial) {
    const std::vector<Motion> states = states_of(trial.recording);
    const double g = trial.settings.real("run.gravity"), dt = trial.settings.real("run.step");
    const double start = states.front().grains.at(0).velocity[0];
    const double k = inertia_over_mass(trial.settings);
    double velocity = 0.0, spin = 0.0;
    for (std::size_t n = 0; n < states.size(); ++n) {
        const GrainState& grain = states[n].grains.at(0);
        // Friction mu m g slows the grain until its surface rolls: u = u_0/(1 + k).
        const double expected =
            std::max(start / (1.0 + k), start - friction * g * dt * static_cast<double>(n));
        velocity = std::max(velocity, std::abs(grain.velocity[0] - expected));
        const double surface = grain.radius * grain.angular_velocity[2];
        // I omega = -R m (u_0 - u), with I = k m R^2
        spin = std::max(spin, std::abs(surface + (start - expected) / k));
        const Vec3& impulse = grain.contact_impulse;
        if (!within_the_cone(impulse[1], impulse[0], friction))
            return beyond_the_cone(n - 1, impulse[1], impulse[0], friction);
    }
    const Finding slides = within(velocity, rolling_tolerance, "velocity of a grain that slides");
    if (slides.grade == Grade::failed) return slides;
    return within(spin, 2.0 * rolling_tolerance, "velocity of its surface by the spin");
}

/// ((r - r_c) x (v - v_c) + I/m omega) . e_z, c the mean of two equal grains: free of their weight.
double spin_about_the_middle(const Motion& state, double inertia_over_mass) {
    double sum = 0.0;
    for (const GrainState& grain : state.grains)
        // I/m omega
        sum += inertia_over_mass * grain.radius * grain.radius * grain.angular_velocity[2];
    const GrainState &a = state.grains.at(0), &b = state.grains.at(1);
    // Two equal masses: the reduced mass is m/2.
    return sum + 0.5 * cross_z(b.position - a.position, b.velocity - a.velocity);
}

/// The impulse on the second disc along the normal from the first and across it, with the sign of
/// the slip.
struct Glance {
    double normal = 0.0, tangential = 0.0;
};

Glance glance(const Motion& before, const Motion& after) {
    const GrainState &a = before.grains.at(0), &b = before.grains.at(1);
    const Vec3 normal = unit(b.position - a.position);
    // A quarter counter-clockwise of the normal.
    const Vec3 tangent{-normal[1], normal[0], 0.0};
    const double slip = dot(b.velocity - a.velocity, tangent);
    const Vec3& impulse = after.grains.at(1).contact_impulse;
    return {dot(impulse, normal), std::copysign(1.0, slip) * dot(impulse, tangent)};
}

/// The angular momentum that an impulse may change by acting somewhere in the gap or overlap.
constexpr double arm_tolerance = 0.1;  // [D]

Finding judge_glance(const Trial& trial) {
    const std::vector<Motion> states = states_of(trial.recording);
    const bool substeps = capabilities_of(trial.recording).native_substeps;
    const double most = (substeps ? with_a_dashpot : 1.0) * glancing_friction;
    Glance sum;
    for (std::size_t n = 1; n < states.size(); ++n) {
        const Glance now = glance(states[n - 1], states[n]);
        if (!within_the_cone(now.normal, now.tangential, most))
            return beyond_the_cone(n - 1, now.normal, now.tangential, glancing_friction);
        sum.normal += now.normal, sum.tangential += now.tangential;
    }
    if (!(sum.normal > 0.0))
        return {Grade::failed, "two grains on courses that cross did not touch"};
    // Friction acts against the slip: the sum along it is negative.
    const double found = -sum.tangential / sum.normal;
    Finding finding = within(std::abs(found - std::clamp(found, glancing_friction, most)),
                             glancing_tolerance * glancing_friction,
                             "friction over normal impulse of two grains that slip");
    if (finding.grade == Grade::failed) return finding;
    const double mean = trial.history.at("mean_velocity_x").back();
    if (Finding momentum = within(std::abs(mean), round_off, "momentum of two grains");
        momentum.grade == Grade::failed)
        return momentum;
    const GrainState& first = states.front().grains.at(0);
    const double mass = first.density * volume_of(first.radius, trial.settings);
    const double k = inertia_over_mass(trial.settings);
    const double change = mass * std::abs(spin_about_the_middle(states.back(), k) -
                                          spin_about_the_middle(states.front(), k));
    return within(change / std::abs(sum.tangential), arm_tolerance,
                  "angular momentum over friction impulse, in D,");
}

const GrainState& grain_of(const Motion& state, GrainId id) {
    const auto at = std::find_if(state.grains.begin(), state.grains.end(),
                                 [id](const GrainState& grain) { return grain.id == id; });
    if (at == state.grains.end())
        throw Failure(ExitCode::participant_failed, fmt::format("grain {} is missing", id));
    return *at;
}

double distance(const Vec3& a, const Vec3& b) {
    return norm(b - a);
}

Finding judge_held(const Trial& trial) {
    const std::vector<Motion> states = states_of(trial.recording);
    const double dt = trial.settings.real("run.step");
    double held = 0.0, driven = 0.0, lowest = INFINITY;
    for (std::size_t n = 0; n < states.size(); ++n) {
        const Vec3 start = grain_of(states[0], 8).position;
        // The driven grain has 0.5 u_c (held_and_driven).
        const Vec3 place{start[0] + 0.5 * dt * static_cast<double>(n), start[1], start[2]};
        held = std::max(held,
                        distance(grain_of(states[n], 7).position, grain_of(states[0], 7).position));
        driven = std::max(driven, distance(grain_of(states[n], 8).position, place));
        lowest = std::min(lowest, grain_of(states[n], 9).position[1]);
    }
    if (held > round_off)
        return {Grade::failed, fmt::format("a held grain moves by {:.2g} D", held)};
    if (driven > round_off)
        return {Grade::failed,
                fmt::format("a driven grain is {:.2g} D from where its velocity takes it", driven)};
    // The free grain begins 0.3 D above the held one and touches it with its centre at 4 D.
    const double sinks = 4.0 - lowest;
    if (!(sinks <= deepest_overlap))
        return {Grade::failed, fmt::format("a grain sinks {:.2g} D into a held one", sinks)};
    return {Grade::met, "held grains stay, driven ones go their way, and grains rest on them"};
}

/// Sum over a grain's contacts less its contact impulse, the largest of all grains [N s].
double contact_defect(const Motion& state) {
    std::map<GrainId, Vec3> rest;
    for (const GrainState& grain : state.grains) rest[grain.id] = grain.contact_impulse;
    for (const ContactRecord& contact : *state.contacts)
        for (std::size_t axis : {0, 1, 2}) {
            rest[contact.b][axis] -= contact.impulse[axis];
            // `impulse` is on b, and minus as much on a.
            if (contact.wall < 0) rest[contact.a][axis] += contact.impulse[axis];
        }
    double worst = 0.0;
    for (const auto& [id, impulse] : rest) worst = std::max(worst, norm(impulse));
    return worst;
}

std::string words(const Vec3& v) {
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0], v[1], v[2]);
}

/// The first contact whose branch does not lead from centre to centre, or from the wall to the
/// centre, as they are at some time of the window; empty if all do. Stresses are made of them.
std::string branch_fault(const Motion& before, const Motion& state, double diameter) {
    for (const ContactRecord& contact : *state.contacts) {
        const bool pair = contact.wall < 0;
        const GrainState& b = grain_of(state, contact.b);
        Vec3 from = contact.point;
        double moved = distance(grain_of(before, contact.b).position, b.position);
        if (pair) {
            from = grain_of(state, contact.a).position;
            moved += distance(grain_of(before, contact.a).position, from);
        }
        const Vec3 expected = b.position - from;
        if (distance(contact.branch, expected) <= moved + round_off * diameter) continue;
        return fmt::format("a contact of grain {} has the branch {} m, but {} is {} m", contact.b,
                           words(contact.branch),
                           pair ? "centre of b minus centre of a" : "centre minus point",
                           words(expected));
    }
    return "";
}

/// Codes with sub-steps report the contacts of the last one, which agree with the window's impulse
/// when the grains are at rest.
Finding judge_records(const Trial& trial) {
    const std::vector<Motion> states = states_of(trial.recording);
    const bool substeps = capabilities_of(trial.recording).native_substeps;
    const GrainState& grain = states.front().grains.at(0);
    const double weight = volume_of(grain.radius, trial.settings) * grain.density *
                          trial.settings.real("run.gravity") * trial.settings.real("run.step");
    double worst = 0.0;
    std::size_t outputs = 0, contacts = 0;
    for (std::size_t n = substeps ? states.size() - 1 : 1; n < states.size(); ++n) {
        if (!states[n].contacts) continue;
        ++outputs;
        contacts += states[n].contacts->size();
        worst = std::max(worst, contact_defect(states[n]) / weight);
        const std::string fault =
            branch_fault(states[n - 1], states[n], trial.settings.real("run.diameter"));
        if (!fault.empty()) return {Grade::failed, fault};
    }
    if (outputs == 0) return {Grade::not_supported, "single contacts are not sent"};
    Finding finding = within(worst, substeps ? 0.05 : round_off,
                             "contact impulse of a grain and the sum of its contacts, in weights,");
    finding.text += fmt::format(", {} contacts", contacts);
    return finding;
}

}  // namespace

Finding slides_into_rolling(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate,
        dry("rolling", on_the_floor, {"time.end=2", fmt::format("contact.friction={}", friction)}),
        folder);
    return trial.done() ? judge_rolling(trial) : not_done(trial, "friction");
}

Finding collides_with_friction(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial =
        play_trial(candidate,
                   dry("glancing", passing,
                       {"time.end=1", fmt::format("contact.friction={}", glancing_friction)}),
                   folder);
    return trial.done() ? judge_glance(trial) : not_done(trial, "friction");
}

Finding respects_held_grains(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(candidate, dry("held", held_and_driven, {"time.end=1"}), folder);
    return trial.done() ? judge_held(trial) : not_done(trial, "grains with a given motion");
}

Finding reports_contacts(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate, dry("contacts", stacked, {"time.end=3", "output.interval=0.1"}), folder);
    return trial.done() ? judge_records(trial) : failure_of(trial.outcome);
}

double overlap_of(const Motion& state, const Settings& settings) {
    const double size[] = {settings.real("run.size_x"), settings.real("run.size_y"),
                           settings.real("run.size_z")};
    const std::size_t axes = in_space(settings) ? 3 : 2;
    double deepest = 0.0;
    for (const GrainState& b : state.grains) {
        for (std::size_t axis = 0; axis < axes; ++axis)
            deepest = std::max(
                {deepest, b.radius - b.position[axis], b.position[axis] + b.radius - size[axis]});
        for (const GrainState& a : state.grains)
            if (a.id < b.id)
                deepest = std::max(deepest, a.radius + b.radius - distance(a.position, b.position));
    }
    return deepest;
}

// Codes with sub-steps may be half a window behind the positions that they send: these overlapped
// by 5e-9 D more than was told when a sphere landed in a window's end (yade-md, standalone-md).
constexpr double overlap_tolerance = 1e-7;  // [D]

// A window's report is of its end for codes that solve once, and of its sub-steps, the first of
// which begins at q^n, for others.
Overlap judge_overlap(const Trial& trial) {
    const std::vector<Motion> states = states_of(trial.recording);
    const double diameter = trial.settings.real("run.diameter");
    Overlap result;
    double before = 0.0;
    for (std::size_t n = 0; n < states.size(); ++n) {
        const double now = overlap_of(states[n], trial.settings) / diameter;
        const double told = states[n].report.max_penetration / diameter;
        result.deepest = std::max(result.deepest, now);
        // Either end of the window will do: what is told must not be below the smaller overlap of
        // both.
        if (n > 0 && told < std::min(before, now) - overlap_tolerance)
            result.finding = {Grade::failed,
                              fmt::format("grains overlap by {:.2g} D at the end of window {}, and "
                                          "max_penetration says {:.2g} D",
                                          now, n - 1, told)};
        before = now;
    }
    return result;
}

}  // namespace turbidite
