// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/requirements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "launcher/adapter_test/partner.hpp"

namespace turbidite {
namespace {

constexpr double round_off = 1e-9;
constexpr double deepest_overlap = 0.05;  // [D]
constexpr double at_rest = 0.02;          // [u_c]

// Far from each other and from all sides; ids are identifiers, in no order.
const std::string apart =
    "id,x,y\n1000000007,2,8\n5,4.5,8\n3,7,8\n42,9.5,8\n41,12,8\n9000000000000,14,8\n";
const std::string above_the_floor = "id,x,y\n7,3,0.6\n8,6,0.7\n9,9,0.8\n";
const std::string two_in_a_row = "id,x,y,vx\n1,6,5,1\n2,7.05,5,-1\n";
const std::string near_a_side = "id,x,y,vx\n1,15,5,5\n2,4,8,0\n3,8,8,0\n";

Finding failure_of(const Trial& trial) {
    return {Grade::failed, fmt::format("ended with code {}: {}",
                                       static_cast<int>(trial.outcome.code), trial.outcome.error)};
}

double worst(const std::vector<double>& column, const std::vector<double>& expected) {
    if (column.size() != expected.size()) return INFINITY;
    double error = 0.0;
    for (std::size_t i = 0; i < column.size(); ++i)
        error =
            std::max(error, std::isnan(column[i]) ? INFINITY : std::abs(column[i] - expected[i]));
    return error;
}

Finding within(double error, double limit, const std::string& what) {
    return {error <= limit ? Grade::met : Grade::failed,
            fmt::format("{} differs by {:.1e}, allowed {:.0e}", what, error, limit)};
}

/// Velocity after each window. Free fall with the weight (M - m_f) g on the inertia cM has the
/// acceleration g; the scripted fluid then divides by 1 + gamma dt/cM, cM = (rho_r - 1) pi/4.
std::vector<double> expected_velocity(const Trial& trial) {
    const Settings& s = trial.settings;
    const double g = s.real("run.gravity"), dt = s.real("run.step");
    const double inertia = 0.5 * std::numbers::pi / 4.0;
    const bool wet = s.flag("fluid.enabled");
    const double share = wet ? 1.0 / (1.0 + partner_drag * dt / inertia) : 1.0;
    std::vector<double> velocity{0.0};
    for (std::int64_t k = 0; k < s.integer("run.windows"); ++k)
        velocity.push_back(share * (velocity.back() - g * dt));
    return velocity;
}

Finding judge_fall(const Trial& trial) {
    if (!trial.done()) return failure_of(trial);
    const auto expected = expected_velocity(trial);
    const Finding velocity =
        within(worst(trial.history.at("mean_velocity_y"), expected), round_off, "velocity");
    if (velocity.grade == Grade::failed) return velocity;
    // q + dt U in every window; codes with sub-steps are up to one window apart.
    const double dt = trial.settings.real("run.step");
    std::vector<double> height{8.0};
    for (std::size_t i = 1; i < expected.size(); ++i)
        height.push_back(height.back() + dt * expected[i]);
    const double error = worst(trial.history.at("mean_position_y"), height);
    return within(error, dt * std::abs(expected.back()), "position");
}

Finding falls_without_a_fluid(const Candidate& candidate, const std::filesystem::path& folder) {
    return judge_fall(play_trial(candidate, {"dry", apart, {"fluid.enabled=false"}}, folder));
}

Finding settles_in_a_drag(const Candidate& candidate, const std::filesystem::path& folder) {
    return judge_fall(play_trial(candidate, {"drag", apart, {}}, folder));
}

Finding uses_responses(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(candidate, {"joint", apart, {"coupling.scheme=joint"}}, folder);
    if (trial.outcome.code == ExitCode::handshake_refused)
        return {Grade::not_supported, "effective_inertia is not claimed"};
    return judge_fall(trial);
}

Finding lands(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate, {"landing", above_the_floor, {"time.end=3", "output.interval=0.1"}}, folder);
    if (!trial.done()) return failure_of(trial);
    const double speed = trial.last("mean_speed"), height = trial.last("mean_position_y");
    if (height < 0.5 - deepest_overlap)
        return {Grade::failed,
                fmt::format("grains sink into the floor: mean height {:.3g} D", height)};
    if (!(speed < at_rest))
        return {Grade::failed, fmt::format("grains are not at rest: mean speed {:.2g} u_c", speed)};
    return {Grade::met,
            fmt::format("at rest at {:.4g} D, grain_balance {:.0e}", height, trial.grain_balance)};
}

Finding collides(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate, {"collision", two_in_a_row, {"time.end=0.5", "fluid.enabled=false"}}, folder);
    if (!trial.done()) return failure_of(trial);
    const double overlap = *std::max_element(trial.history.at("max_penetration").begin(),
                                             trial.history.at("max_penetration").end());
    if (!(overlap <= deepest_overlap))
        return {Grade::failed, fmt::format("grains overlap by {:.3g} D", overlap)};
    // Both have the same speed; without a contact they keep 1 u_c along x.
    const double fall = trial.last("mean_velocity_y"), speed = trial.last("mean_speed");
    const double along = std::sqrt(std::max(0.0, speed * speed - fall * fall));
    if (!(along < 0.5))
        return {Grade::failed,
                fmt::format("two grains that met at 1 u_c go on with {:.2g} u_c", along)};
    return within(std::abs(trial.last("mean_velocity_x")), round_off, "momentum along the contact");
}

Finding loses_grains(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(
        candidate,
        {"leaving", near_a_side, {"time.end=1", "domain.right=free", "fluid.enabled=false"}},
        folder);
    if (trial.outcome.code == ExitCode::participant_failed && trial.history.empty())
        return {Grade::not_supported, "refuses free sides: " + trial.outcome.error};
    if (!trial.done()) return failure_of(trial);
    const double left = trial.last("grains");
    if (left != 2.0)
        return {Grade::failed,
                fmt::format("{} grains at the end, 2 expected: one crosses a free side", left)};
    return {Grade::met, "one grain left and was counted"};
}

Finding stops_on_request(const Candidate& candidate, const std::filesystem::path& folder) {
    const Trial trial = play_trial(candidate, {"stop", apart, {"time.end=100"}, true}, folder);
    if (trial.outcome.code != ExitCode::terminated) return failure_of(trial);
    return {Grade::met, "left in order after one window"};
}

Finding repeats_itself(const Candidate& candidate, const std::filesystem::path& folder) {
    std::vector<Trial> trials;
    for (const char* name : {"first", "second"})
        trials.push_back(play_trial(
            candidate, {name, above_the_floor, {"time.end=1", "output.interval=0.1"}}, folder));
    for (const Trial& trial : trials)
        if (!trial.done()) return failure_of(trial);
    for (const char* column : {"mean_velocity_x", "mean_velocity_y", "mean_position_y"})
        if (trials[0].history.at(column) != trials[1].history.at(column))
            return {Grade::failed, fmt::format("{} differs between two equal runs", column)};
    return {Grade::met, "two equal runs are equal to the last digit"};
}

Finding goes_on(const Candidate& candidate, const std::filesystem::path& folder) {
    const std::string output = "output.interval=0.1";
    const TrialCase parts{"parts", above_the_floor, {"time.end=0.45", output}};
    const Trial whole =
        play_trial(candidate, {"whole", above_the_floor, {"time.end=1", output}}, folder);
    if (!whole.done()) return failure_of(whole);
    if (const Trial first = play_trial(candidate, parts, folder); !first.done())
        return failure_of(first);
    const std::optional<Trial> second = resume_trial(parts, {"time.end=1"}, folder);
    if (!second) return {Grade::not_supported, "save and restore are not claimed"};
    if (!second->done()) return failure_of(*second);
    for (const char* column : {"mean_velocity_x", "mean_velocity_y", "mean_position_x",
                               "mean_position_y", "mean_speed", "kinetic_energy"})
        if (whole.history.at(column) != second->history.at(column))
            return {Grade::failed,
                    fmt::format("{} differs from that of a run in one part", column)};
    return {Grade::met, "a run in two parts is equal to one in one part, to the last digit"};
}

}  // namespace

const std::vector<Requirement>& requirements() {
    static const std::vector<Requirement> list = {
        {"falls freely without a fluid", falls_without_a_fluid, false},
        {"settles in a linear drag (split)", settles_in_a_drag, false},
        {"uses the fluid's inertia (joint)", uses_responses, true},
        {"lands and comes to rest", lands, false},
        {"collides and keeps momentum", collides, false},
        {"announces grains that leave", loses_grains, true},
        {"ends in order on a stop request", stops_on_request, false},
        {"repeats itself", repeats_itself, false},
        {"goes on from a checkpoint", goes_on, true},
    };
    return list;
}

}  // namespace turbidite
