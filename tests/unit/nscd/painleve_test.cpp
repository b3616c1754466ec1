// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Painleve's rod: uniform, mass 1, length 2, sliding on its lower end at an angle phi to the floor.
// With I = 1/3 and the arm (-cos, -sin)
//
//     W_nn = 1 + 3 cos^2,   W_nt = -3 sin cos,   so W_nn + s mu W_nt < 0 needs
//     mu > (tan^2 + 4)/(3 tan), least at tan = 2: mu = 4/3
//
// Beyond it no force at the contact of a sliding rod prevents penetration; as an impulse problem it
// always has a solution.
#include <gtest/gtest.h>

#include "granular_adapter/nscd/problem/plane/delassus.hpp"
#include "granular_adapter/nscd/solvers/nlgs.hpp"
#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

/// The rod on the floor, moving downwards at `fall`, with its lower end sliding at `slip`.
ContactProblem rod(double tangent, double friction, double fall, double slip) {
    const double phi = std::atan(tangent);
    ContactProblem problem;
    problem.bodies = std::vector<PlanarTensor>{{1.0, 3.0}};
    problem.free = {{{slip, -fall, 0.0}, {}}};
    Contact contact;
    contact.b = 0;
    contact.normal = {0.0, 1.0, 0.0};
    contact.tangent = tangent_of(contact.normal);
    contact.arm_b = {-std::cos(phi), -std::sin(phi), 0.0};
    contact.friction = friction;
    problem.contacts = {contact};
    return problem;
}

double slope(double tangent, double friction) {
    const Block w = Delassus(rod(tangent, friction, 0.0, 0.0)).block(0);
    return w.nn - friction * std::abs(w.nt);
}

TEST(Painleve, BeginsAtFourThirds) {
    EXPECT_GT(slope(2.0, 4.0 / 3.0 - 1e-9), 0.0);
    EXPECT_LT(slope(2.0, 4.0 / 3.0 + 1e-9), 0.0);
    for (const double tangent : {0.5, 1.0, 1.9, 2.1, 4.0})
        EXPECT_GT(slope(tangent, 4.0 / 3.0), 0.0) << "2 is where it begins";
}

// Falling or rising, sliding in either direction, with friction below and far beyond the critical
// value.
TEST(Painleve, AlwaysHasAnAnswer) {
    SolverSettings settings;
    // At the limit of closing only rounding is left: 1e-16 against a floor of 1e-12.
    settings.tolerance = 1e-3;
    for (const double friction : {1.0, 4.0 / 3.0, 1.5, 10.0})
        for (const double fall : {-1.0, -1e-6, 0.0, 1e-6, 0.01, 1.0})
            for (const double slip : {-1.0, -0.01, 0.0, 0.01, 1.0}) {
                const ContactProblem problem = rod(2.0, friction, fall, slip);
                const SolverResult result = Nlgs().solve(problem, Impulses(1), settings);
                EXPECT_TRUE(result.converged) << friction << " " << fall << " " << slip;
                const ContactVector u = contact_velocity(problem.contacts[0], result.velocities);
                EXPECT_GE(u.n, -1e-12);
                EXPECT_GE(result.impulses[0].n, 0.0);
                if (fall <= 0.0) {
                    EXPECT_EQ(result.impulses[0], (ContactVector{}));
                }
            }
}

}  // namespace
}  // namespace turbidite::nscd
