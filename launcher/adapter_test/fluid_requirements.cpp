// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A fluid against scripted grains, which fall freely and touch nothing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "launcher/adapter_test/requirements.hpp"

namespace turbidite {
namespace {

constexpr double solver_tolerance = 1e-4;  // of u_c, with the defaults of the case

const std::string in_the_middle = "id,x,y\n1000000007,4,6\n";
const std::string two_apart = "id,x,y\n5,2.03,6.02\n3,5.6,5\n";
const std::string across_the_middle = "id,x,y,vx\n1,3.3,6,3\n2,4.9,3,-3\n";
const std::string near_a_side = "id,x,y,vx\n1,7.45,5,5\n2,2,6,0\n3,4.5,6,0\n";
const std::string start_in_plane = "id,x,y\n1,6.03,6.017\n";
const std::string start_in_space = "id,x,y\n1,2.03,2.017\n";
const std::string driven = "id,x,y,vx,vy,motion\n7,3,4,0.5,0,driven\n8,3,6.5,0,0,free\n";

/// A grain released from rest resists like 1 + its added mass, in potential flow m_f for a disc and
/// m_f/2 for a sphere: dU/dt = (r - 1)/(r + 1) g or (r - 1)/(r + 1/2) g at density ratio r. At
/// Re = 1000 after 0.01 t_c the boundary layer takes 1.1 % of a disc's, the walls 0.5 %
/// (tests/physics/start_up_test.cpp). A sphere is taken as large as it is.
Finding starts_like_potential_flow(const Candidate& candidate,
                                   const std::filesystem::path& folder) {
    const bool space = candidate.dimension == 3;
    TrialCase start{"start",
                    space ? start_in_space : start_in_plane,
                    {"fluid.cells_per_diameter=16", "fluid.reynolds=1000", "time.step=0.001",
                     "time.end=0.01", "output.interval=0.001"}};
    start.overrides.push_back(space ? "domain.size=[4, 4, 4]" : "domain.size=[12, 12]");
    if (space) start.overrides.push_back("fluid.surface_shift=0");
    const Trial trial = play_trial(candidate, start, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    const auto& fall = trial.history.at("mean_velocity_y");
    const double dt = trial.settings.real("run.step"), g = trial.settings.real("run.gravity");
    const double ratio = trial.settings.real("grains.density_ratio");
    const double added = space ? 0.5 : 1.0;
    // A disc's less 1.1 % for the boundary layer and 0.5 % for the walls.
    const double expected = (space ? 1.0 : 0.984) * (ratio - 1.0) / (ratio + added);
    // Of the last window: -dU_y/dt in g.
    const double found = (fall[fall.size() - 2] - fall.back()) / dt / g;
    return {std::abs(found - expected) <= 0.1 * expected ? Grade::met : Grade::failed,
            fmt::format("acceleration {:.4f} g, potential flow {:.4f} g, allowed 10 %", found,
                        expected)};
}

Finding keeps_symmetry(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial =
        play_trial(candidate, {"symmetric", in_the_middle, {"time.end=0.5"}}, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    const double fall = trial.last("mean_velocity_y");
    const double dt = trial.settings.real("run.step"), g = trial.settings.real("run.gravity");
    // 50 windows of 0.01 t_c are 0.5 t_c.
    const double free_fall = 50.0 * g * dt;
    if (!(fall < -0.01 && -fall < free_fall))
        return {Grade::failed, fmt::format("a grain falls with {:.3g} u_c after 0.5 t_c, in vacuum "
                                           "with {:.3g} u_c",
                                           -fall, free_fall)};
    Finding finding = within(worst(trial.history.at("mean_velocity_x"),
                                   std::vector<double>(trial.history.at("time").size(), 0.0)),
                             solver_tolerance, "velocity across the axis of symmetry");
    finding.text += fmt::format(", falls with {:.3g} u_c", -fall);
    return finding;
}

/// cM (U^{n+1} - U^{n+4/5}) = dt ∫λ of every grain, and the fluid's own momentum.
Finding balances(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(candidate, {"balance", two_apart, {"time.end=0.5"}}, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    const double grains = trial.maximum("grain_balance"), fluid = trial.maximum("fluid_balance");
    // Grains to round-off, since the coupler computes their balance from what was sent; the fluid's
    // own one is as good as its solvers.
    return {grains <= round_off && fluid <= 1e-3 ? Grade::met : Grade::failed,
            fmt::format("grain_balance {:.1e}, allowed {:.0e}; fluid_balance {:.1e}, allowed 1e-03",
                        grains, round_off, fluid)};
}

/// The mean of the driven grain and a free one: the driven one keeps its velocity, so the free one
/// has twice the mean less 0.5 along x, and the fluid has dragged it along by less than that.
Finding respects_given_motion(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(candidate, {"driven", driven, {"time.end=0.5"}}, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    const auto& x = trial.history.at("mean_position_x");
    // The history has means over both grains: twice the mean is the sum.
    const double moved = 2.0 * (x.back() - x.front());
    const double free = moved - 0.25;  // the driven one moves by 0.5 u_c * 0.5 t_c
    if (!(std::abs(free) < 0.05))
        return {Grade::failed,
                fmt::format("a grain that is driven with 0.5 u_c and a free one moved by {:.3g} D "
                            "together in 0.5 t_c, 0.25 D expected",
                            moved)};
    return {Grade::met, fmt::format("a driven grain goes its way, a free one moves by {:.2g} D "
                                    "along with it",
                                    free)};
}

Finding responds(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial split =
        play_trial(candidate, {"without_rounds", two_apart, {"time.end=0.3"}}, folder);
    if (!split.done()) return failure_of(split.outcome);
    const Trial joint = play_trial(
        candidate, {"responses", two_apart, {"time.end=0.3", "coupling.scheme=joint"}}, folder);
    if (joint.outcome.code == ExitCode::handshake_refused)
        return {Grade::not_supported, "effective_inertia is not claimed"};
    if (!joint.done()) return failure_of(joint.outcome);
    return within(worst(split, joint, {"mean_velocity_x", "mean_velocity_y", "mean_position_y"}),
                  solver_tolerance, "without contacts, the motion under joint and split");
}

Finding lets_grains_go(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate, {"leaving", near_a_side, {"time.end=1.5", "domain.right=free"}}, folder);
    if (!trial.done()) return failure_of(trial.outcome);
    if (trial.last("grains") != 2.0)
        return {Grade::failed,
                fmt::format("{} grains at the end, 2 expected", trial.last("grains"))};
    return {Grade::met, "one grain left through a free side, two go on"};
}

Finding same_on_two_ranks(const Candidate& candidate, const std::filesystem::path& folder) {
    return moves_alike(candidate, {"", across_the_middle, {"time.end=0.4"}}, {"fluid.ranks=2"},
                       solver_tolerance, folder)
        .finding;
}

const TrialCase at_a_distance{"distance", two_apart, {}};

Finding keeps_order(const Candidate& candidate, const std::filesystem::path& folder) {
    return refuses_disorder(candidate, at_a_distance, Kind::constraint, folder);
}

Finding stops_on_request(const Candidate& candidate, const std::filesystem::path& folder) {
    return ends_on_request(candidate, {"", in_the_middle, {}}, folder);
}

Finding repeats_itself(const Candidate& candidate, const std::filesystem::path& folder) {
    return runs_alike(candidate, at_a_distance, folder);
}

Finding goes_on(const Candidate& candidate, const std::filesystem::path& folder) {
    return goes_on_alike(candidate, {"whole", two_apart, {"output.interval=0.05"}}, folder);
}

}  // namespace

const std::vector<Requirement>& fluid_requirements() {
    static const std::vector<Requirement> list = {
        {"starts like potential flow", starts_like_potential_flow, false},
        {"keeps the symmetry of a box", keeps_symmetry, false},
        {"balances momentum", balances, false},
        {"respects a given motion", respects_given_motion, true},
        {"answers with its inertia (joint)", responds, true},
        {"lets grains leave", lets_grains_go, true},
        {"moves the same on two ranks", same_on_two_ranks, true},
        {"refuses messages out of order", keeps_order, false},
        {"ends in order on a stop request", stops_on_request, false},
        {"repeats itself", repeats_itself, false},
        {"goes on from a checkpoint", goes_on, true},
    };
    return list;
}

}  // namespace turbidite
