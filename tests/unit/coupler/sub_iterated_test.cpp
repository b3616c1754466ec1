// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `sub-iterated` with grains that hold an impulse of the fluid and know nothing of its inertia:
// what they and the fluid agree on is the motion of `joint`.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <random>

#include "coupler/hub/handshake.hpp"
#include "coupler/hub/quasi_newton.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

constexpr double floor_height = 4.4995;

/// Inelastic discs over a floor: cM (U - U^n) = J_h + weight dt + J.
class HoldingGrains final : public ScriptedGrains {
 public:
    explicit HoldingGrains(int& rounds, bool shuffles = false)
        : ScriptedGrains("scripted"), rounds_(rounds), shuffles_(shuffles) {
        hello_.capabilities.effective_inertia = false;
        hello_.capabilities.restores_within_window = true;
    }

    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        const RunValues run = run_values(settings);
        gravity_ = run.gravity;
        bodies_ = ImmersedBodies(run, shapes);
        held_.assign(grains.size(), 0.0);
        return ScriptedGrains::initialise(settings, shapes, grains);
    }

    Motion advance(const Window& window, const std::vector<FreeResponse>& targets) override {
        ++rounds_;
        if (targets.empty()) start_ = motion_.grains;
        for (const FreeResponse& target : targets)
            for (std::size_t i = 0; i < held_.size(); ++i)
                if (motion_.grains[i].id == target.id)
                    held_[i] += mass(i) * (target.velocity[1] - motion_.grains[i].velocity[1]);
        motion_.grains = start_;
        motion_.report = {};
        motion_.report.iterations = 1;
        for (std::size_t i = 0; i < held_.size(); ++i) play(motion_.grains[i], i, window.step);
        return sent();
    }

    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        for (std::size_t i = 0; i < held_.size(); ++i) {
            GrainState& grain = motion_.grains[i];
            const double with_contact = grain.velocity[1];
            for (const Kick& kick : kicks)
                if (kick.id == grain.id)
                    grain.velocity = kick.velocity, held_[i] = kick.multiplier_impulse[1];
            const bool touched = grain.contact_impulse[1] > 0.0;
            grain.position[1] += window.step * (touched ? with_contact : grain.velocity[1]);
        }
        return sent();
    }

 private:
    /// In another order every time.
    Motion sent() {
        Motion motion = motion_;
        if (shuffles_) std::shuffle(motion.grains.begin(), motion.grains.end(), random_);
        return motion;
    }

    double mass(std::size_t i) const { return bodies_(motion_.grains[i]).effective_mass; }

    void play(GrainState& grain, std::size_t i, double step) {
        const ImmersedBody body = bodies_(grain);
        grain.announced_impulse = {0.0, held_[i], 0.0};
        grain.velocity[1] += (held_[i] - body.submerged_mass * gravity_ * step) / mass(i);
        const double gap = grain.position[1] - grain.radius - floor_height;
        const double impulse = std::max(0.0, -mass(i) * (grain.velocity[1] + gap / step));
        grain.velocity[1] += impulse / mass(i);
        grain.contact_impulse = {0.0, impulse, 0.0};
        motion_.report.contacts += impulse > 0.0;
    }

    int& rounds_;
    bool shuffles_;
    std::mt19937 random_{1};
    double gravity_ = 0.0;
    ImmersedBodies bodies_;
    std::vector<double> held_;
    std::vector<GrainState> start_;
};

Job landing(const std::string& scheme, const TestFolder& folder, int* rounds = nullptr,
            bool shuffles = false, double apart = 0.0) {
    Job job;
    job.settings = test_settings(scheme);
    job.settings.set("run.output_every", std::int64_t{1});
    job.floor = floor_height;
    job.fluid_ranks = 2;
    // How the grains differ: alike, they could be taken for each other.
    for (std::size_t i = 0; i < job.population.size(); ++i)
        job.population[i].velocity[1] -= apart * static_cast<double>(i);
    if (rounds)
        job.make_grains = [=] { return std::make_unique<HoldingGrains>(*rounds, shuffles); };
    job.run(folder);
    return job;
}

TEST(SubIterated, GrainsThatHoldAnImpulseMoveAsUnderJoint) {
    const TestFolder one("sub-iterated"), other("sub-joint"), third("sub-split");
    int rounds = 0;
    const Job job = landing("sub-iterated", one, &rounds);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    ASSERT_EQ(landing("joint", other).status.code, ExitCode::done);
    int once = 0;
    ASSERT_EQ(landing("split", third, &once).status.code, ExitCode::done);
    const Rows here = read_csv(one.files().history), joint = read_csv(other.files().history),
               split = read_csv(third.files().history);
    ASSERT_EQ(here.size(), joint.size());
    double apart = 0.0;
    for (std::size_t row = 2; row < here.size(); ++row) {
        EXPECT_NEAR(cell(here, row, "mean_velocity_y"), cell(joint, row, "mean_velocity_y"), 1e-8);
        EXPECT_NEAR(cell(here, row, "mean_position_y"), cell(joint, row, "mean_position_y"), 1e-8);
        EXPECT_LT(cell(here, row, "joint_mismatch"), 1e-9);
        EXPECT_LT(cell(here, row, "grain_balance"), 1e-10);
        apart = std::max(apart, std::abs(cell(split, row, "mean_velocity_y") -
                                         cell(joint, row, "mean_velocity_y")));
    }
    EXPECT_GT(cell(here, here.size() - 1, "contacts"), 0.0);
    EXPECT_GT(apart, 1e-4);  // split does not
    const auto windows = static_cast<int>(job.settings.integer("run.windows"));
    EXPECT_EQ(once, windows);
    EXPECT_GE(rounds, 2 * windows);
    EXPECT_LE(rounds, 5 * windows);
}

// Its program may return grains in any order: the iteration follows each of them.
TEST(SubIterated, GrainsInAnotherOrderEveryRoundConvergeAlike) {
    const TestFolder one("sub-order"), other("sub-shuffled");
    int rounds = 0, shuffled = 0;
    ASSERT_EQ(landing("sub-iterated", one, &rounds, false, 0.2).status.code, ExitCode::done);
    const Job job = landing("sub-iterated", other, &shuffled, true, 0.2);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const Rows here = read_csv(one.files().history), there = read_csv(other.files().history);
    ASSERT_EQ(here.size(), there.size());
    for (std::size_t row = 2; row < here.size(); ++row) {
        EXPECT_NEAR(cell(here, row, "mean_position_y"), cell(there, row, "mean_position_y"), 1e-12);
        EXPECT_LT(cell(there, row, "joint_mismatch"), 1e-9);
    }
    EXPECT_EQ(rounds, shuffled);
    EXPECT_GT(cell(here, here.size() - 1, "contacts"), 0.0);
}

TEST(SubIterated, IsRefusedByAdaptersThatCannotRepeatAWindow) {
    const TestFolder folder("sub-refused");
    const Job job = landing("sub-iterated", folder);
    EXPECT_EQ(job.status.code, ExitCode::handshake_refused);
    EXPECT_NE(job.status.reason.find("repetition of a window"), std::string::npos)
        << job.status.reason;
}

// x <- B x + b with three different factors, one of them above 1: exact after four steps.
TEST(QuasiNewton, SolvesALinearProblemInAsManyStepsAsItHasFactors) {
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(6, 6);
    b.diagonal() << 0.67, 0.67, 0.2, 0.2, -1.3, -1.3;
    const Eigen::VectorXd constant = Eigen::VectorXd::LinSpaced(6, -1.0, 2.0);
    const Eigen::VectorXd solution = (Eigen::MatrixXd::Identity(6, 6) - b).lu().solve(constant);
    QuasiNewton iteration;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(6);
    for (int n = 0; n < 4; ++n) x += iteration.step(b * x + constant - x);
    EXPECT_LT((x - solution).norm(), 1e-10);
}

}  // namespace
}  // namespace turbidite
