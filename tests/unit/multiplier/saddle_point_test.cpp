// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/saddle_point.hpp"

#include <gtest/gtest.h>

#include "fluid_adapter/multiplier/method_list.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {
namespace {

/// A field, grains and their points, solved by one of the methods.
struct Problem {
    Problem(std::vector<ImmersedGrain> given, bool boundary, Side side = Side::wall)
        : field(96, 96, side), grains(std::move(given)) {
        PointRules rules;
        rules.boundary = boundary;
        PointPlacement(rules).place(field, grains, points);
    }

    MultiplierResult solve(const std::string& method, double tolerance) {
        MultiplierSettings settings;
        settings.tolerance = tolerance;
        settings.reduction = 1.0;
        system.assemble(field, grains, points);
        return find_method(method).solve(system, settings, work);
    }

    MemoryField field;
    std::vector<ImmersedGrain> grains;
    CollocationPoints points;
    SaddlePoint system;
    MultiplierWorkspace work;
};

std::vector<ImmersedGrain> three_discs() {
    return {disc(1, 1.513, 2.007, {0.1, -0.5, 0.7}), disc(2, 2.52, 2.03, {-0.2, 0.3, -0.4}),
            disc(3, 4.01, 4.02, {0.0, -1.0, 0.0})};
}

std::vector<double> random_vector(int size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<double> result(size);
    for (double& v : result) v = value(random);
    return result;
}

TEST(ConstraintOperator, TransposeIdentity) {
    // <L, B u - T U - R w> = <B^T L, u> - <T^T L, U> - <R^T L, w> for arbitrary vectors.
    Problem problem(three_discs(), true);
    problem.field.fill_randomly(1);
    const ConstraintOperator constraint(problem.points);
    const std::vector<double> L = random_vector(constraint.rows(), 2);
    const std::vector<Planar> motions = {{0.3, -0.2, 1.0}, {0.5, 0.1, -2.0}, {-0.7, 0.4, 0.3}};

    std::vector<double> slip(constraint.rows());
    constraint.apply(problem.field.velocity(0), problem.field.velocity(1), motions.data(),
                     slip.data());
    double left = 0.0;
    for (int i = 0; i < constraint.rows(); ++i) left += L[i] * slip[i];

    const int cells = problem.field.local_cells();
    std::vector<double> fx(cells), fy(cells);
    std::vector<Planar> sums(3);
    constraint.spread(L.data(), fx.data(), fy.data());
    constraint.sum_by_grain(L.data(), sums.data());
    double right = 0.0;
    for (int c = 0; c < cells; ++c)
        right += fx[c] * problem.field.velocity(0)[c] + fy[c] * problem.field.velocity(1)[c];
    for (int g = 0; g < 3; ++g) right -= sums[g].dot(motions[g]);
    EXPECT_NEAR(left, right, 1e-11);
}

TEST(SaddlePoint, IsSymmetricAndPositive) {
    Problem problem(three_discs(), true);
    problem.system.assemble(problem.field, problem.grains, problem.points);
    const int rows = problem.system.rows();
    const std::vector<double> a = random_vector(rows, 3), b = random_vector(rows, 4);
    std::vector<double> Sa(rows), Sb(rows);
    problem.system.apply(a.data(), Sa.data());
    problem.system.apply(b.data(), Sb.data());
    const double aSb = problem.system.dot(a.data(), Sb.data());
    EXPECT_NEAR(problem.system.dot(b.data(), Sa.data()), aSb, 1e-10 * std::abs(aSb) + 1e-9);
    EXPECT_GT(problem.system.dot(a.data(), Sa.data()), 0.0);
}

TEST(InteriorClosedForm, OneDiscInStillFluid) {
    // U = cM U45 / (cM + m n): rho_s = 1.5 gives cM = pi/8, and n cells of mass m = 1/256.
    Problem problem({disc(1, 3.0, 3.0, {0.0, -1.0, 0.0})}, false);
    problem.solve("interior", 1e-4);
    const double cM = 3.14159265358979 / 8.0, mn = problem.points.size() / 256.0;
    EXPECT_NEAR(problem.system.motions()[0].y(), -cM / (cM + mn), 1e-13);
}

TEST(InteriorClosedForm, EqualsConjugateGradients) {
    Problem exact(three_discs(), false), iterated(three_discs(), false);
    exact.field.fill_randomly(5);
    iterated.field.fill_randomly(5);
    exact.solve("interior", 1e-4);
    // The method named after boundary points is plain CG on whatever points it is given.
    const MultiplierResult result = iterated.solve("interior+boundary", 1e-13);
    EXPECT_TRUE(result.converged);
    for (int g = 0; g < 3; ++g) {
        EXPECT_LT((exact.system.motions()[g] - iterated.system.motions()[g]).norm(), 1e-11);
        EXPECT_LT((exact.system.impulses()[g] - iterated.system.impulses()[g]).norm(), 1e-11);
    }
    for (int c = 0; c < exact.field.local_cells(); ++c)
        EXPECT_NEAR(exact.field.velocity(1)[c], iterated.field.velocity(1)[c], 1e-11);
}

TEST(InteriorClosedForm, RefusesBoundaryPoints) {
    Problem problem(three_discs(), true);
    EXPECT_THROW(problem.solve("interior", 1e-4), std::invalid_argument);
}

TEST(InteriorClosedForm, HoldsForGrainsLighterThanTheFluid) {
    // cM < 0 but cM + m n > 0: momentum is still shared, and the cells move as one.
    ImmersedGrain light = disc(1, 3.0, 3.0, {0.0, 1.0, 0.0});
    light.effective_mass *= -1.0;
    light.effective_inertia *= -1.0;
    Problem problem({light}, false);
    problem.solve("interior", 1e-4);
    const double cM = -3.14159265358979 / 8.0, mn = problem.points.size() / 256.0;
    EXPECT_NEAR(problem.system.motions()[0].y(), cM / (cM + mn), 1e-12);
}

class BothMethods : public testing::TestWithParam<std::string> {};

TEST_P(BothMethods, MomentumGoesFromFluidToGrains) {
    // cM (U - U45) = T^T L and the fluid gets minus it: their sum does not change. Round-off only,
    // whatever the tolerance.
    Problem problem(three_discs(), find_method(GetParam()).boundary_points);
    problem.field.fill_randomly(6);
    const Planar before = problem.field.momentum();
    problem.solve(GetParam(), 1e-2);
    const Planar change = problem.field.momentum() - before;
    Planar given = Planar::Zero();
    for (int g = 0; g < 3; ++g) {
        const ImmersedGrain& grain = problem.grains[g];
        const Planar& impulse = problem.system.impulses()[g];
        const Planar gained = problem.system.motions()[g] - grain.contact_motion;
        EXPECT_NEAR(grain.effective_mass * gained.x(), impulse.x(), 1e-13);
        EXPECT_NEAR(grain.effective_inertia * gained.z(), impulse.z(), 1e-13);
        given += impulse;
    }
    EXPECT_NEAR(change.x(), -given.x(), 1e-12);
    EXPECT_NEAR(change.y(), -given.y(), 1e-12);
}

TEST_P(BothMethods, AnAnnouncedImpulseIsNotCountedTwice) {
    // A host that already spent J_h and says so gets the same velocity as one that did not, and the
    // fluid the same impulse.
    const Planar held(0.02, -0.05, 0.01);
    ImmersedGrain plain = disc(1, 3.013, 3.007, {0.1, -0.5, 0.7}), announced = plain;
    announced.announced_impulse = held;
    announced.contact_motion +=
        Planar(held.x() / plain.effective_mass, held.y() / plain.effective_mass,
               held.z() / plain.effective_inertia);
    const bool boundary = find_method(GetParam()).boundary_points;
    Problem first({plain}, boundary), second({announced}, boundary);
    first.solve(GetParam(), 1e-12);
    second.solve(GetParam(), 1e-12);
    EXPECT_LT((first.system.motions()[0] - second.system.motions()[0]).norm(), 1e-12);
    EXPECT_LT((first.system.impulses()[0] - second.system.impulses()[0]).norm(), 1e-12);
}

TEST_P(BothMethods, ARigidMotionOfAllIsLeftAlone) {
    // u = U + w x (x - X) everywhere is linear, and quadratic interpolation reproduces it: no slip.
    const Planar motion(0.3, -0.8, 1.1);
    Problem problem({disc(1, 3.013, 3.007, motion)}, find_method(GetParam()).boundary_points);
    problem.field.fill([&](double x, double y) {
        return Planar(motion.x() - motion.z() * (y - 3.007), motion.y() + motion.z() * (x - 3.013),
                      0.0);
    });
    problem.solve(GetParam(), 1e-4);
    EXPECT_LT(problem.system.impulses()[0].norm(), 1e-13);
    EXPECT_LT((problem.system.motions()[0] - motion).norm(), 1e-13);
}

TEST_P(BothMethods, AllCellsWellInsideMoveWithTheGrain) {
    Problem problem(three_discs(), find_method(GetParam()).boundary_points);
    problem.field.fill_randomly(7);
    problem.solve(GetParam(), 1e-10);
    const Planar& U = problem.system.motions()[2];  // the disc at (4.01, 4.02)
    for (int p = problem.points.begin[2]; p < problem.points.boundary_begin[2]; ++p) {
        const int cell = problem.points.cell[problem.points.stencil[p]];
        EXPECT_NEAR(problem.field.velocity(0)[cell], U.x() - U.z() * problem.points.arm_y[p], 1e-8);
        EXPECT_NEAR(problem.field.velocity(1)[cell], U.y() + U.z() * problem.points.arm_x[p], 1e-8);
    }
}

INSTANTIATE_TEST_SUITE_P(Methods, BothMethods, testing::Values("interior", "interior+boundary"),
                         [](const auto& info) {
                             return info.param == "interior" ? "interior" : "boundary";
                         });

TEST(UzawaCg, IterationsAreThoseOfAWellConditionedProblem) {
    // Published for Q2-outward points 1.41 h apart, a slip of order one to 1e-5: 12 iterations at
    // density ratio 1.5 (condition number 2.5); the same operator with points 1 h apart takes 24.
    Problem problem({disc(1, 3.013, 3.007)}, true);
    problem.field.fill_randomly(8);
    const MultiplierResult result = problem.solve("interior+boundary", 1e-5);
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.residual, 1e-5);
    EXPECT_GE(result.iterations, 6);
    EXPECT_LE(result.iterations, 20);
}

TEST(UzawaCg, InteriorPointsTakeFourIterations) {
    // Three families of eigenvalues per disc: still cells, translation, rotation.
    Problem problem({disc(1, 3.013, 3.007)}, false);
    problem.field.fill_randomly(9);
    EXPECT_LE(problem.solve("interior+boundary", 1e-5).iterations, 5);
}

TEST(UzawaCg, ADensePackingConverges) {
    // Touching rows, the hardest configuration: points dropped in every gap.
    std::vector<ImmersedGrain> grains;
    for (int row = 0; row < 5; ++row)
        for (int i = 0; i < 4; ++i)
            grains.push_back(disc(static_cast<GrainId>(grains.size()) + 1,
                                  0.75 + 1.0 * i + 0.5 * (row % 2), 0.7 + 0.8660254 * row,
                                  {0.1 * i, -0.2, 0.3 * row}));
    Problem problem(grains, true);
    problem.field.fill_randomly(10);
    const MultiplierResult result = problem.solve("interior+boundary", 1e-4);
    EXPECT_TRUE(result.converged);
    EXPECT_LE(result.iterations, 60);
}

TEST(UzawaCg, SaysWhenItRanOutOfIterations) {
    Problem problem(three_discs(), true);
    problem.field.fill_randomly(11);
    MultiplierSettings settings;
    settings.iterations = 2;
    problem.system.assemble(problem.field, problem.grains, problem.points);
    const MultiplierResult result = uzawa_cg(problem.system, settings, problem.work);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.iterations, 2);
    EXPECT_GT(result.residual, 1e-4);
}

TEST(UzawaCg, AShortStepIsStillSolvedToAHundredth) {
    // Slip 1e-5 of u_c, below the tolerance of 1e-4: without the second rule nothing would be done.
    Problem problem({disc(1, 3.013, 3.007, {0.0, -1e-5, 0.0})}, true);
    problem.system.assemble(problem.field, problem.grains, problem.points);
    const MultiplierResult result = uzawa_cg(problem.system, {}, problem.work);
    EXPECT_GT(result.iterations, 0);
    EXPECT_LE(result.residual, 1e-7);
}

TEST(UzawaCg, NoGrainsNoWork) {
    Problem problem({}, true);
    const MultiplierResult result = problem.solve("interior+boundary", 1e-4);
    EXPECT_EQ(result.iterations, 0);
    EXPECT_TRUE(result.converged);
}

TEST(MethodList, UnknownNameListsTheKnown) {
    try {
        find_method("surface");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("interior+boundary"), std::string::npos);
    }
}

}  // namespace
}  // namespace turbidite
