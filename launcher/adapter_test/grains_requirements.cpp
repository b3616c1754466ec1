// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains against a scripted fluid: a linear drag with a solution in closed form.
#include "launcher/adapter_test/requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupler/keys/key_spec.hpp"
#include "launcher/adapter_test/altered_recording.hpp"
#include "launcher/adapter_test/contact_requirements.hpp"
#include "launcher/adapter_test/partner.hpp"
#include "launcher/adapter_test/trial_grain.hpp"
#include "launcher/adapter_test/trial_recording.hpp"

namespace turbidite {
namespace {

constexpr double at_rest = 0.02;  // [u_c]

// Far from each other and from all sides; ids are identifiers, in no order.
const std::string apart =
    "id,x,y\n1000000007,2,8\n5,4.5,8\n3,7,8\n42,9.5,8\n41,12,8\n9000000000000,14,8\n";
// In space they also move across the plane.
const std::string apart_and_across =
    "id,x,y,vz\n1000000007,2,8,0.5\n5,4.5,8,0.5\n3,7,8,0.5\n42,9.5,8,0.5\n41,12,8,0.5\n"
    "9000000000000,14,8,0.5\n";
const std::string above_the_floor = "id,x,y\n7,3,0.6\n8,6,0.7\n9,9,0.8\n";
const std::string two_in_a_row = "id,x,y,vx\n1,6,5,1\n2,7.05,5,-1\n";
const std::string across_the_middle =
    "id,x,y,vx\n1,5.5,9,6\n2,10.5,7.5,-6\n3,7.2,6,2\n4,8.8,6,-2\n5,2,8,0\n6,14,8,0\n";
const std::string one_alone = "id,x,y,vx\n4,6.5,8,6\n";
const std::string near_a_side = "id,x,y,vx\n1,15,5,5\n2,4,8,0\n3,8,8,0\n";

/// Far from each other, for this dimension of space.
const std::string& falling(const Candidate& candidate) {
    return candidate.dimension == 3 ? apart_and_across : apart;
}

/// Velocity after each window, from this one and with this acceleration on. By the scripted fluid
/// cM (U^{n+1} - U^{n+4/5}) = -gamma dt U^{n+1}: it divides by 1 + gamma dt/cM.
std::vector<double> in_the_drag(double velocity, double acceleration, const Settings& s) {
    const double dt = s.real("run.step");
    const double inertia = immersed_ratios(s).inertia * volume_of(0.5, s);
    const double share = s.flag("fluid.enabled") ? 1.0 / (1.0 + partner_drag * dt / inertia) : 1.0;
    std::vector<double> velocities{velocity};
    for (std::int64_t k = 0; k < s.integer("run.windows"); ++k)
        velocities.push_back(share * (velocities.back() + acceleration * dt));
    return velocities;
}

/// Free fall with the weight (M - m_f) g on the inertia cM.
std::vector<double> expected_fall(const Settings& s) {
    const ImmersedRatios ratios = immersed_ratios(s);
    return in_the_drag(0.0, -ratios.weight / ratios.inertia * s.real("run.gravity"), s);
}

Finding judge_fall(const Trial& trial) {
    if (!trial.done()) return failure_of(trial.outcome);
    const auto expected = expected_fall(trial.settings);
    const Finding velocity =
        within(worst(trial.history.at("mean_velocity_y"), expected), round_off, "velocity");
    if (velocity.grade == Grade::failed) return velocity;
    if (in_space(trial.settings)) {
        const auto& across = trial.history.at("mean_velocity_z");
        const Finding finding =
            within(worst(across, in_the_drag(across.front(), 0.0, trial.settings)), round_off,
                   "velocity along z");
        if (finding.grade == Grade::failed) return finding;
    }
    // q + dt U in every window; codes with sub-steps are up to one window apart.
    const double dt = trial.settings.real("run.step");
    std::vector<double> height{8.0};
    for (std::size_t i = 1; i < expected.size(); ++i)
        height.push_back(height.back() + dt * expected[i]);
    const double error = worst(trial.history.at("mean_position_y"), height);
    return within(error, dt * std::abs(expected.back()), "position");
}

Finding falls_without_a_fluid(const Candidate& candidate, const std::filesystem::path& folder) {
    return judge_fall(
        play_trial(candidate, {"dry", falling(candidate), {"fluid.enabled=false"}}, folder));
}

TrialCase in_a_drag(const Candidate& candidate) {
    return {"drag", falling(candidate), {}};
}

Finding settles_in_a_drag(const Candidate& candidate, const std::filesystem::path& folder) {
    return judge_fall(play_trial(candidate, in_a_drag(candidate), folder));
}

/// The fall, and that contacts and fluid came to the same velocities in every window.
Finding judge_agreement(const Trial& trial, const std::string& fault) {
    const Finding fall = judge_fall(trial);
    const double apart = trial.maximum("unconverged_joint_windows");
    if (fall.grade == Grade::failed || apart == 0.0) return fall;
    return {
        Grade::failed,
        fmt::format("velocities are up to {:.2g} u_c from the fluid's after {} rounds in {} "
                    "windows: {}",
                    trial.maximum("joint_mismatch"), trial.maximum("joint_rounds"), apart, fault)};
}

Finding uses_responses(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial =
        play_trial(candidate, {"responses", falling(candidate), {"coupling.scheme=joint"}}, folder);
    if (trial.outcome.code == ExitCode::handshake_refused)
        return {Grade::not_supported, "effective_inertia is not claimed"};
    return judge_agreement(trial, "the velocities of the responses are not taken");
}

Finding lands(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate, {"landing", above_the_floor, {"time.end=3", "output.interval=0.1"}}, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    const double speed = trial.last("mean_speed");
    const std::vector<Motion> states = states_of(trial.recording);
    for (const GrainState& grain : states.back().grains) {
        const double above = grain.position[1] / trial.settings.real("run.diameter");
        if (std::abs(above - 0.5) > deepest_overlap)
            return {Grade::failed,
                    fmt::format("grains {} the floor: grain {} is at {:.3g} D",
                                above < 0.5 ? "sink into" : "stay above", grain.id, above)};
    }
    if (!(speed < at_rest))
        return {Grade::failed, fmt::format("grains are not at rest: mean speed {:.2g} u_c", speed)};
    if (const Overlap overlap = judge_overlap(trial); overlap.finding.grade == Grade::failed)
        return overlap.finding;
    return {Grade::met, fmt::format("at rest at {:.4g} D, grain_balance {:.0e}",
                                    trial.last("mean_position_y"), trial.maximum("grain_balance"))};
}

Finding collides(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate, {"collision", two_in_a_row, {"time.end=0.5", "fluid.enabled=false"}}, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    // Both have the same speed; without a contact they keep 1 u_c along x.
    const double fall = trial.last("mean_velocity_y"), speed = trial.last("mean_speed");
    const double along = std::sqrt(std::max(0.0, speed * speed - fall * fall));
    if (!(along < 0.5))
        return {Grade::failed,
                fmt::format("two grains that met at 1 u_c go on with {:.2g} u_c", along)};
    const Overlap overlap = judge_overlap(trial);
    if (overlap.finding.grade == Grade::failed) return overlap.finding;
    if (!(overlap.deepest <= deepest_overlap))
        return {Grade::failed, fmt::format("grains overlap by {:.3g} D", overlap.deepest)};
    return within(std::abs(trial.last("mean_velocity_x")), round_off, "momentum along the contact");
}

Finding loses_grains(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate,
        {"leaving", near_a_side, {"time.end=1", "domain.right=free", "fluid.enabled=false"}},
        folder);
    if (const auto words = refusal_of(trial))
        return {Grade::not_supported, "refuses free sides: " + *words};
    if (!trial.done()) return failure_of(trial.outcome);
    const double left = trial.last("grains");
    if (left != 2.0)
        return {Grade::failed,
                fmt::format("{} grains at the end, 2 expected: one crosses a free side. A program "
                            "that cannot lose grains refuses free sides (docs/write-an-adapter.md)",
                            left)};
    return {Grade::met, "one grain left and was counted"};
}

Finding stops_on_request(const Candidate& candidate, const std::filesystem::path& folder) {
    return ends_on_request(candidate, {"", apart, {}}, folder);
}

const TrialCase short_landing{
    "short-landing", above_the_floor, {"output.interval=0.1", "time.end=1"}};

Finding repeats_itself(const Candidate& candidate, const std::filesystem::path& folder) {
    return runs_alike(candidate, short_landing, folder);
}

Finding goes_on(const Candidate& candidate, const std::filesystem::path& folder) {
    return goes_on_alike(candidate, short_landing, folder);
}

Finding keeps_order(const Candidate& candidate, const std::filesystem::path& folder) {
    return refuses_disorder(candidate, in_a_drag(candidate), Kind::kick, folder);
}

/// Repeats every window until grains and fluid agree: what the drag does, to coupling.tolerance.
Finding repeats_windows(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(candidate,
                                   {"repeated",
                                    falling(candidate),
                                    {"coupling.scheme=sub-iterated", "coupling.tolerance=1e-10"}},
                                   folder);
    if (trial.outcome.code == ExitCode::handshake_refused)
        return {Grade::not_supported, "restores_within_window is not claimed"};
    return judge_agreement(trial, "advance does not go back to t^n, or the impulse is not held");
}

/// The run on one rank and on two.
Finding same_on_two_ranks(const Candidate& candidate, const std::string& name,
                          const std::string& grains, const std::filesystem::path& folder) {
    auto [finding, shared] = moves_alike(candidate, {name + "-", grains, {"time.end=0.6"}},
                                         {"grains.ranks=2"}, round_off, folder);
    if (!shared.done()) return finding;
    if (finding.grade == Grade::failed)
        finding.text += ". A program for one rank refuses grains.ranks = 2";
    const auto moved = grains_that_moved(shared.recording);
    finding.text += fmt::format(", {} grains changed their rank", moved.size());
    return finding;
}

/// Two grains cross the middle, where codes that divide the domain pass them on, two meet there;
/// and then one grain alone, so that a rank has none until it comes.
Finding migrates(const Candidate& candidate, const std::filesystem::path& folder) {
    const Finding many = same_on_two_ranks(candidate, "crossing", across_the_middle, folder);
    if (many.grade != Grade::met) return many;
    const Finding alone = same_on_two_ranks(candidate, "alone", one_alone, folder);
    return alone.grade == Grade::met ? many : alone;
}

}  // namespace

const std::vector<Requirement>& grains_requirements() {
    static const std::vector<Requirement> list = {
        {"falls freely without a fluid", falls_without_a_fluid, false},
        {"settles in a linear drag (split)", settles_in_a_drag, false},
        {"uses the fluid's inertia (joint)", uses_responses, true},
        {"repeats a window (sub-iterated)", repeats_windows, true},
        {"lands and comes to rest", lands, false},
        {"collides and keeps momentum", collides, false},
        {"slides into rolling", slides_into_rolling, true},
        {"collides with friction", collides_with_friction, true},
        {"respects held and driven grains", respects_held_grains, true},
        {"reports its contacts", reports_contacts, true},
        {"announces grains that leave", loses_grains, true},
        {"moves the same on two ranks", migrates, true},
        {"refuses messages out of order", keeps_order, false},
        {"ends in order on a stop request", stops_on_request, false},
        {"repeats itself", repeats_itself, false},
        {"goes on from a checkpoint", goes_on, true},
    };
    return list;
}

}  // namespace turbidite
