// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/plane/one_contact.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace turbidite::nscd {
namespace {

/// |natural map| over |r|, with u = W r + b; zero for an exact solution.
double defect(const Block& w, const Plane& b, double friction, const Plane& r) {
    const Plane u = {w.nn * r[0] + w.nt * r[1] + b[0], w.nt * r[0] + w.tt * r[1] + b[1]};
    const Plane f = natural_map(r, u, friction, 1.0 / w.nn);
    const double size = std::hypot(r[0], r[1]), error = std::hypot(f[0], f[1]);
    return size > 0.0 ? error / size : error;
}

class Problems {
 public:
    double uniform(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }

    /// One body of mass 1, touched at the end of an arm: W_dd' = 1 + (arm x d)(arm x d')/I.
    Block one_body() {
        const double n = uniform(-1, 1), t = uniform(-1, 1), i = uniform(0.05, 0.5);
        return {1 + n * n / i, n * t / i, 1 + t * t / i};
    }

    /// Any symmetric positive definite W with condition number up to 1e4.
    Block any() {
        const double low = std::pow(10.0, uniform(-4, 0)), angle = uniform(0, 6.283185307179586);
        const double c = std::cos(angle), s = std::sin(angle);
        return {c * c + low * s * s, (1 - low) * c * s, s * s + low * c * c};
    }

    Plane velocity() { return {uniform(-1, 1), uniform(-1, 1)}; }

 private:
    std::mt19937_64 random_{20111};
};

/// A widely used rule: the direction of sliding is the sign of r_t + mu r_n of the stick trial. It
/// is right if the trial's r_n is positive. If strong coupling makes it negative, a small r_t > 0
/// is taken for sliding in the other direction.
Plane customary_rule(const Block& w, const Plane& b, double friction) {
    if (b[0] >= 0.0) return {0.0, 0.0};
    const double det = w.nn * w.tt - w.nt * w.nt;
    const Plane trial = {(w.nt * b[1] - w.tt * b[0]) / det, (w.nt * b[0] - w.nn * b[1]) / det};
    if (std::abs(trial[1]) <= friction * trial[0]) return trial;
    const double s = trial[1] + friction * trial[0] < 0.0 ? -1.0 : 1.0;
    const double slide = -b[0] / (w.nn + s * friction * w.nt);
    return {slide, s * friction * slide};
}

/// Statistics of a million problems with friction up to `most`, and the success of both rules.
struct Census {
    int failures = 0, customary_failures = 0;
    int coupled = 0;  ///< |W_nt| above half of sqrt(W_nn W_tt)
    int pulling = 0;  ///< closing contacts with r_n < 0 in the stick trial
};

template <class MakeBlock>
Census census(double most, MakeBlock make_block) {
    Problems problems;
    Census count;
    for (int k = 0; k < 1000000; ++k) {
        const Block w = make_block(problems, k);
        const Plane b = problems.velocity();
        const double friction = problems.uniform(0.0, most);
        count.coupled += std::abs(w.nt) > 0.5 * std::sqrt(w.nn * w.tt);
        count.pulling += b[0] < 0.0 && w.nt * b[1] - w.tt * b[0] < 0.0;
        const auto failed = [&](const Plane& r) { return !(defect(w, b, friction, r) < 1e-8); };
        count.failures += failed(solve_contact(w, b, friction));
        count.customary_failures += failed(customary_rule(w, b, friction));
    }
    return count;
}

// The natural map is zero only at solutions. Rounding: condition numbers of W up to 1e4, slopes
// W_nn + s mu W_nt down to about 1e-4 of W_nn: 1e-16 * 1e4 * 1e4 = 1e-8. The customary rule fails
// where the trial has r_n < 0, so these problems reach the branch that matters.
TEST(OneContact, SolvesAMillionProblemsOfAnyCoupling) {
    const Census count = census(2.0, [](Problems& p, int) { return p.any(); });
    EXPECT_EQ(count.failures, 0);
    EXPECT_GT(count.coupled, 500000);
    EXPECT_GT(count.pulling, 50000);
    EXPECT_GT(count.customary_failures, 1000);
}

// A single body: the W of polygons.
TEST(OneContact, SolvesAMillionProblemsOfOneBody) {
    const Census rough = census(2.0, [](Problems& p, int) { return p.one_body(); });
    EXPECT_EQ(rough.failures, 0);
    EXPECT_GT(rough.customary_failures, 1000);
    const Census usual = census(1.0, [](Problems& p, int) { return p.one_body(); });
    EXPECT_EQ(usual.failures, 0);
    EXPECT_GT(usual.customary_failures, 10);
}

// By hand: W = (1, 1.5; 1.5, 4), b = (-1, -4), mu = 2. The trial (1.5 (-4) + 4, 1.5 (-1) + 4)/1.75
// = (-2, 2.5)/1.75 has r_n < 0. Sliding with s = +1: r_n = 1/(1 + 3) = 0.25, r_t = 0.5, u_t = 0.375
// + 2 - 4 < 0, opposite to r_t. The customary rule takes s = -1, since 2.5 < 2 * 2, and gets r_n =
// 1/(1 - 3) < 0.
TEST(OneContact, SlidesAlthoughTheTrialPulls) {
    const Block w{1.0, 1.5, 4.0};
    EXPECT_EQ(solve_contact(w, {-1.0, -4.0}, 2.0), (Plane{0.25, 0.5}));
    EXPECT_EQ(customary_rule(w, {-1.0, -4.0}, 2.0)[0], -0.5);
}

// The check above must be able to fail: sliding in the wrong direction is not a solution.
TEST(OneContact, NaturalMapSeesAWrongBranch) {
    const Block w{1.0, 0.5, 1.0};
    const Plane b{-1.0, 1.0};
    const Plane right = solve_contact(w, b, 0.1);
    EXPECT_LT(defect(w, b, 0.1, right), 1e-14);
    EXPECT_GT(defect(w, b, 0.1, {right[0], -right[1]}), 0.1);
    EXPECT_GT(defect(w, b, 0.1, {1.01 * right[0], right[1]}), 1e-3);
}

// W = 1, b = (-1, b_t): r_n = 1. Sticks while |b_t| <= mu, slides with r_t = -mu sign(b_t) beyond.
TEST(OneContact, SticksInsideTheConeAndSlidesOnIt) {
    const Block w{1.0, 0.0, 1.0};
    EXPECT_EQ(solve_contact(w, {-1.0, 0.25}, 0.3), (Plane{1.0, -0.25}));
    EXPECT_EQ(solve_contact(w, {-1.0, 0.5}, 0.3), (Plane{1.0, -0.3}));
    EXPECT_EQ(solve_contact(w, {-1.0, -0.5}, 0.3), (Plane{1.0, 0.3}));
    EXPECT_EQ(solve_contact(w, {0.5, -0.5}, 0.3), (Plane{0.0, 0.0}));
}

// W = (2, -1.5; -1.5, 1.5), b = (-0.1, -1), mu = 1. Stick trial: A = 1.5 - 2.25/2 = 0.375,
// c = -1 - (-1.5)(-0.1)/2 = -1.075, r_t = 2.867, r_n = -(-0.1 - 4.3)/2 = 2.2 < r_t: rejected.
// Slide, s = +1: r_n = 0.1/(2 - 1.5) = 0.2, u_t = -0.3 + 0.3 - 1 = -1: opposite to r_t = 0.2.
TEST(OneContact, SlidesInTheDirectionOfTheTrial) {
    const Plane r = solve_contact({2.0, -1.5, 1.5}, {-0.1, -1.0}, 1.0);
    EXPECT_NEAR(r[0], 0.2, 1e-14);
    EXPECT_NEAR(r[1], 0.2, 1e-14);
}

// Uniform rod on a plane beyond mu = 4/3: W_nn + mu W_nt < 0 and b_n >= 0 allow two solutions.
TEST(OneContact, TakesNoImpulseInThePainleveCase) {
    EXPECT_EQ(solve_contact({1.6, -1.2, 3.4}, {0.1, -2.0}, 2.0), (Plane{0.0, 0.0}));
}

// mu = 1: cone |t| <= n. Points inside stay; the polar cone is projected to 0; other points onto
// the edge.
TEST(OneContact, ProjectsOnTheCone) {
    EXPECT_EQ(project_on_cone({2.0, -1.0}, 1.0), (Plane{2.0, -1.0}));
    EXPECT_EQ(project_on_cone({-2.0, 1.0}, 1.0), (Plane{0.0, 0.0}));
    EXPECT_EQ(project_on_cone({0.0, -2.0}, 1.0), (Plane{1.0, -1.0}));
}

// mu = 0: the cone is the half-line t = 0, n >= 0. For an opening contact without tangential
// velocity the zero impulse is a solution, however fast it opens.
TEST(OneContact, TheSmoothConeIsAHalfLine) {
    EXPECT_EQ(project_on_cone({-2.0, 0.0}, 0.0), (Plane{0.0, 0.0}));
    EXPECT_EQ(project_on_cone({2.0, 0.0}, 0.0), (Plane{2.0, 0.0}));
    EXPECT_EQ(project_on_cone({2.0, -1.0}, 0.0), (Plane{2.0, 0.0}));
    EXPECT_EQ(natural_map({0.0, 0.0}, {3.0, 0.0}, 0.0, 1.0), (Plane{0.0, 0.0}));
}

}  // namespace
}  // namespace turbidite::nscd
