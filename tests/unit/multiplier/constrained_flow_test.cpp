// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/saddle_operator.hpp"

#include <gtest/gtest.h>

#include "fluid_adapter/multiplier/plane/uzawa_cg.hpp"
#include "tests/unit/multiplier/dense_reference.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {
namespace {

/// A field, grains and their points.
struct Problem {
    Problem(std::vector<ImmersedGrain> given, bool boundary, Side side = Side::wall)
        : field(96, 96, side), grains(std::move(given)) {
        PointRules rules;
        rules.boundary = boundary;
        PointPlacement(rules).place(field, grains, points);
    }

    /// Begins with the present field.
    void begin() {
        system.assemble(field, grains, points);
        flow.begin(system, {field.velocity(0), field.velocity(1)}, momenta_of(grains),
                   prescribed_motions(grains));
    }

    /// Solves with the present field to a slip below `tolerance`; u is not changed yet.
    MultiplierResult solve(double tolerance) {
        begin();
        return solve_on(tolerance);
    }

    /// Continues from the present state of the system.
    MultiplierResult solve_on(double tolerance) {
        MultiplierSettings settings;
        settings.tolerance = tolerance;
        settings.reduction = 1.0;
        return uzawa_cg(flow, settings, work);
    }

    MemoryField field;
    std::vector<ImmersedGrain> grains;
    CollocationPoints points;
    SaddleOperator system;
    ConstrainedFlow flow;
    MultiplierWorkspace work;
};

/// Two discs that nearly touch, and a separate one.
std::vector<ImmersedGrain> three_discs() {
    return {disc(1, 1.513, 2.007, {0.1, -0.5, 0.7}), disc(2, 2.52, 2.03, {-0.2, 0.3, -0.4}),
            disc(3, 4.01, 4.02, {0.0, -1.0, 0.0})};
}

/// Gaps of 0.1 to 0.3 D: boundary points of neighbours share cells.
std::vector<ImmersedGrain> loose_heap() {
    return {disc(1, 1.5, 2.0, {0.1, -0.5, 0.7}), disc(2, 2.61, 2.03, {-0.2, 0.3, -0.4}),
            disc(3, 2.03, 3.07, {0.0, -1.0, 0.0}), disc(4, 3.4, 3.05, {0.4, -0.2, 0.3})};
}

/// Of the heap, one grain is held and one is driven.
std::vector<ImmersedGrain> held_heap() {
    std::vector<ImmersedGrain> grains = loose_heap();
    grains[1].contact_motion = {};
    grains[1].prescribed = grains[2].prescribed = true;
    return grains;
}

/// Touching rows of grains, the hardest configuration: points are dropped in every gap.
std::vector<ImmersedGrain> packing(int rows, int columns) {
    std::vector<ImmersedGrain> grains;
    for (int row = 0; row < rows; ++row)
        for (int i = 0; i < columns; ++i)
            grains.push_back(disc(static_cast<GrainId>(grains.size()) + 1,
                                  0.75 + 1.0 * i + 0.5 * (row % 2), 0.7 + 0.8660254 * row,
                                  {0.1 * i, -0.2, 0.3 * row}));
    return grains;
}

std::vector<ImmersedGrain> dense_packing() {
    return packing(4, 3);
}

/// One grain with neighbours all around.
std::vector<ImmersedGrain> small_packing() {
    return packing(3, 3);
}

/// All grains of a touching packing are held, as in a porous medium.
std::vector<ImmersedGrain> held_packing() {
    std::vector<ImmersedGrain> grains = small_packing();
    for (ImmersedGrain& grain : grains) grain.prescribed = true;
    return grains;
}

std::vector<Planar> no_pushes(const Problem& problem) {
    return std::vector<Planar>(problem.grains.size(), Planar::Zero());
}

std::vector<Planar> pushes(std::size_t count) {
    std::vector<Planar> result;
    for (std::size_t g = 0; g < count; ++g)
        result.emplace_back(0.02 - 0.01 * double(g), 0.05, -0.03 * double(g));
    return result;
}

double largest_difference(const std::vector<Planar>& a, const std::vector<Planar>& b) {
    double largest = 0.0;
    for (std::size_t g = 0; g < a.size(); ++g) largest = std::max(largest, (a[g] - b[g]).norm());
    return largest;
}

std::vector<double> random_vector(int size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    std::vector<double> result(size);
    for (double& v : result) v = value(random);
    return result;
}

TEST(BoundaryOperator, TransposeIdentity) {
    // <L, B u - T U> = <B^T L, u> - <T^T L, U> for arbitrary vectors.
    Problem problem(three_discs(), true);
    problem.field.fill_randomly(1);
    const BoundaryOperator boundary(problem.points);
    const std::vector<double> L = random_vector(boundary.rows(), 2);
    const std::vector<Planar> motions = {{0.3, -0.2, 1.0}, {0.5, 0.1, -2.0}, {-0.7, 0.4, 0.3}};

    std::vector<double> slip(boundary.rows());
    const std::vector<PlaneVector> u = at_slots(problem.field, problem.points);
    boundary.apply(u.data(), motions.data(), slip.data());
    double left = 0.0;
    for (int i = 0; i < boundary.rows(); ++i) left += L[i] * slip[i];

    std::vector<PlaneVector> f(problem.points.slots());
    std::vector<Planar> sums(3);
    boundary.spread(L.data(), f.data());
    boundary.sum_by_grain(L.data(), sums.data());
    double right = 0.0;
    for (std::size_t slot = 0; slot < f.size(); ++slot)
        right += f[slot].x * u[slot].x + f[slot].y * u[slot].y;
    for (int g = 0; g < 3; ++g) right -= sums[g].dot(motions[g]);
    EXPECT_NEAR(left, right, 1e-11);
}

/// Multipliers with these values.
Multipliers with_sums(const Problem& problem, const std::vector<double>& values) {
    Multipliers result{values, std::vector<Planar>(problem.grains.size())};
    BoundaryOperator(problem.points).sum_by_grain(values.data(), result.on_grains.data());
    return result;
}

TEST(SaddleOperator, OperatorAndPreconditionerAreSymmetricAndPositive) {
    Problem problem(loose_heap(), true);
    SaddleOperator& system = problem.system;
    system.assemble(problem.field, problem.grains, problem.points);
    const int rows = system.rows();
    const std::vector<double> a = random_vector(rows, 3), b = random_vector(rows, 4);
    std::vector<double> image_a(rows), image_b(rows);
    const auto check = [&](auto operation) {
        operation(a, image_a);
        operation(b, image_b);
        const double ab = system.dot(a.data(), image_b.data());
        EXPECT_NEAR(system.dot(b.data(), image_a.data()), ab, 1e-10 * std::abs(ab) + 1e-9);
        EXPECT_GT(system.dot(a.data(), image_a.data()), 0.0);
    };
    using Vector = std::vector<double>;
    check([&](const Vector& x, Vector& y) { system.apply(with_sums(problem, x), y.data()); });
    check([&](const Vector& x, Vector& y) {
        Multipliers z = with_sums(problem, x);
        system.precondition(x.data(), z);
        y = z.values;
    });
}

TEST(SaddleOperator, PreconditionerIsTheInverseForAGrainByItself) {
    Problem problem({disc(1, 3.013, 3.007)}, true);
    SaddleOperator& system = problem.system;
    system.assemble(problem.field, problem.grains, problem.points);
    const std::vector<double> x = random_vector(system.rows(), 5);
    std::vector<double> image(system.rows());
    Multipliers back = with_sums(problem, x);
    system.apply(with_sums(problem, x), image.data());
    system.precondition(image.data(), back);
    for (int i = 0; i < system.rows(); ++i) EXPECT_NEAR(back.values[i], x[i], 1e-11);
}

TEST(SaddleOperator, ThePreconditionerKnowsWhatItsResultDoesToTheGrains) {
    Problem problem(loose_heap(), true);
    problem.system.assemble(problem.field, problem.grains, problem.points);
    const std::vector<double> r = random_vector(problem.system.rows(), 6);
    Multipliers z = with_sums(problem, r);
    problem.system.precondition(r.data(), z);
    EXPECT_LT(largest_difference(z.on_grains, with_sums(problem, z.values).on_grains), 1e-10);
}

/// B m^-1 B^T w through all cells.
std::vector<double> through_cells(const Problem& problem, const std::vector<double>& w) {
    const BoundaryOperator boundary(problem.points);
    std::vector<PlaneVector> cells(problem.points.slots());
    boundary.spread(w.data(), cells.data());
    for (std::size_t slot = 0; slot < cells.size(); ++slot) {
        const double mass = problem.field.reference_mass() * problem.points.stencilled[slot].volume;
        cells[slot] = {cells[slot].x / mass, cells[slot].y / mass};
    }
    const std::vector<Planar> rest(problem.grains.size(), Planar::Zero());
    std::vector<double> result(w.size());
    boundary.apply(cells.data(), rest.data(), result.data());
    return result;
}

TEST(PointCoupling, IsTheProductThroughAllCells) {
    for (const auto& grains : {three_discs(), loose_heap(), dense_packing()}) {
        Problem problem(grains, true);
        PointCoupling coupling;
        BoundaryBlocks blocks;
        coupling.begin(problem.field, problem.points);
        blocks.factorise(problem.field, problem.grains, problem.points, coupling);
        int shared = 0;
        for (int slot = 0; slot < problem.points.slots(); ++slot) shared += coupling.shared(slot);
        EXPECT_GT(shared, 0);
        EXPECT_LT(shared, problem.points.slots());
        const std::vector<double> w = random_vector(2 * problem.points.boundary_points(), 7);
        const std::vector<double> expected = through_cells(problem, w);
        std::vector<double> y(w.size(), 1e9);
        coupling.apply(problem.field, w.data(), y.data());
        for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(y[i], expected[i], 1e-11);
    }
}

// In a cyclic box of 1.2 D a grain shares cells with its own images, 3 cells away.
TEST(ConstrainedFlow, AGrainThatMeetsItsOwnImageSatisfiesTheConstraint) {
    for (const bool prescribed : {true, false}) {
        std::vector<ImmersedGrain> grains = {disc(1, 0.613, 0.607, {0.1, -0.5, 0.7})};
        grains[0].prescribed = prescribed;
        MemoryField field(19, 19, Side::cyclic);
        field.fill_randomly(8);
        CollocationPoints points;
        PointPlacement({}).place(field, grains, points);
        DenseReference reference(field, grains, points);
        const std::vector<Planar> wanted = reference.motions({Planar::Zero()});
        SaddleOperator system;
        ConstrainedFlow flow;
        MultiplierWorkspace work;
        MultiplierSettings settings;
        settings.tolerance = 1e-12;
        system.assemble(field, grains, points);
        flow.begin(system, {field.velocity(0), field.velocity(1)}, momenta_of(grains),
                   prescribed_motions(grains));
        EXPECT_TRUE(uzawa_cg(flow, settings, work).converged);
        EXPECT_LT(largest_difference(flow.motions(), wanted), 1e-9);
        flow.impose();
        const BoundaryOperator boundary(points);
        std::vector<double> slip(boundary.rows());
        boundary.apply(at_slots(field, points).data(), flow.motions().data(), slip.data());
        for (const double value : slip) EXPECT_NEAR(value, 0.0, 1e-8);
    }
}

TEST(ConstrainedFlow, OneDiscInStillFluidByHand) {
    // U = cM U45 / (cM + m n): rho_s = 1.5 gives cM = pi/8, and n cells of mass m = 1/256.
    Problem problem({disc(1, 3.0, 3.0, {0.0, -1.0, 0.0})}, false);
    problem.solve(1e-4);
    const double cM = 3.14159265358979 / 8.0, mn = problem.points.size() / 256.0;
    EXPECT_NEAR(problem.flow.motions()[0].y(), -cM / (cM + mn), 1e-13);
}

struct Case {
    const char* name;
    std::vector<ImmersedGrain> (*grains)();
    bool boundary;
    double density_factor;  // factor of cM and cI; negative means lighter than the fluid
};

void PrintTo(const Case& scene, std::ostream* out) {
    *out << scene.name;
}

class Against : public testing::TestWithParam<Case> {
 protected:
    Against() : problem(scaled(), GetParam().boundary) { problem.field.fill_randomly(5); }

    static std::vector<ImmersedGrain> scaled() {
        std::vector<ImmersedGrain> grains = GetParam().grains();
        for (ImmersedGrain& grain : grains) {
            grain.effective_mass *= GetParam().density_factor;
            grain.effective_inertia *= GetParam().density_factor;
        }
        return grains;
    }

    Problem problem;
};

TEST_P(Against, TheDenseReference) {
    DenseReference reference(problem.field, problem.grains, problem.points);
    const std::vector<Planar> wanted = reference.motions(no_pushes(problem));
    EXPECT_TRUE(problem.solve(1e-12).converged);
    EXPECT_LT(largest_difference(problem.flow.motions(), wanted), 1e-9);
}

TEST_P(Against, TheDenseReferenceWithImpulsesThatComeLater) {
    const std::vector<Planar> given = pushes(problem.grains.size());
    DenseReference reference(problem.field, problem.grains, problem.points);
    const std::vector<Planar> wanted = reference.motions(given);
    problem.solve(1e-12);
    problem.flow.push(given);
    EXPECT_TRUE(problem.solve_on(1e-12).converged);
    EXPECT_LT(largest_difference(problem.flow.motions(), wanted), 1e-9);
}

TEST_P(Against, MomentumOfFluidAndGrains) {
    // cM (U - U45) = J + dt lambda, and the fluid loses dt lambda, to rounding whatever the
    // tolerance.
    const std::vector<Planar> given = pushes(problem.grains.size());
    const Planar before = problem.field.momentum();
    problem.solve(1e-1);
    problem.flow.push(given);
    problem.solve_on(1e-1);
    problem.flow.impose();
    const Planar change = problem.field.momentum() - before;
    Planar taken = Planar::Zero();
    for (std::size_t g = 0; g < problem.grains.size(); ++g) {
        const ImmersedGrain& grain = problem.grains[g];
        const Planar& impulse = problem.flow.impulses()[g];
        const Planar gained = problem.flow.motions()[g] - planar(grain.contact_motion);
        taken += impulse;
        if (grain.prescribed) {
            EXPECT_EQ(gained, Planar(Planar::Zero()));
            EXPECT_GT(impulse.norm(), 1e-3);  // what holds it is acted on
            continue;
        }
        EXPECT_NEAR(grain.effective_mass * gained.x(), impulse.x() + given[g].x(), 1e-12);
        EXPECT_NEAR(grain.effective_mass * gained.y(), impulse.y() + given[g].y(), 1e-12);
        EXPECT_NEAR(grain.effective_inertia * gained.z(), impulse.z() + given[g].z(), 1e-12);
    }
    EXPECT_NEAR(change.x(), -taken.x(), 1e-12);
    EXPECT_NEAR(change.y(), -taken.y(), 1e-12);
}

TEST_P(Against, TheConstraintItself) {
    // After impose, u at every point is the grain's velocity: exactly in covered cells, at boundary
    // points to the tolerance.
    problem.solve(1e-10);
    problem.flow.impose();
    const std::vector<Planar>& motions = problem.flow.motions();
    const CollocationPoints& points = problem.points;
    for (int g = 0; g < points.grains(); ++g)
        for (int i = points.interior_begin[g]; i < points.interior_begin[g + 1]; ++i) {
            const InteriorCell& point = points.interior[i];
            EXPECT_NEAR(problem.field.velocity(0)[point.cell],
                        motions[g].x() - motions[g].z() * point.arm_y, 1e-13);
            EXPECT_NEAR(problem.field.velocity(1)[point.cell],
                        motions[g].y() + motions[g].z() * point.arm_x, 1e-13);
        }
    const BoundaryOperator boundary(points);
    std::vector<double> slip(boundary.rows());
    boundary.apply(at_slots(problem.field, points).data(), motions.data(), slip.data());
    for (const double value : slip) EXPECT_NEAR(value, 0.0, 1e-8);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Against,
    testing::Values(
        Case{"apart_interior", three_discs, false, 1.0}, Case{"apart", three_discs, true, 1.0},
        Case{"loose", loose_heap, true, 1.0}, Case{"dense", dense_packing, true, 1.0},
        Case{"dense_interior", dense_packing, false, 1.0}, Case{"held", held_heap, true, 1.0},
        Case{"held_dense", held_packing, true, 1.0}, Case{"held_interior", held_heap, false, 1.0},
        Case{"held_light", held_heap, true, -0.4}, Case{"light", loose_heap, true, -0.4},
        Case{"lighter", loose_heap, true, -1.2}, Case{"lighter_dense", small_packing, true, -1.2},
        Case{"nearly_singular", small_packing, true, -1.4},
        Case{"lightest", loose_heap, true, -1.8}, Case{"lightest_dense", small_packing, true, -1.8},
        Case{"light_interior", loose_heap, false, -0.4}),
    [](const auto& info) { return info.param.name; });

class WithOrWithoutBoundary : public testing::TestWithParam<bool> {};

TEST_P(WithOrWithoutBoundary, AnAnnouncedImpulseIsNotCountedTwice) {
    // A host that has already applied J_h and announces it gets the same velocity as one that has
    // not, and the fluid the same impulse.
    const Planar held(0.02, -0.05, 0.01);
    ImmersedGrain plain = disc(1, 3.013, 3.007, {0.1, -0.5, 0.7}), announced = plain;
    announced.announced_impulse = impulse(held);
    announced.contact_motion =
        twist(planar(plain.contact_motion) + Planar(held.x() / plain.effective_mass,
                                                    held.y() / plain.effective_mass,
                                                    held.z() / plain.effective_inertia));
    Problem first({plain}, GetParam()), second({announced}, GetParam());
    for (Problem* problem : {&first, &second}) {
        problem->solve(1e-12);
        problem->flow.impose();
    }
    EXPECT_LT((first.flow.motions()[0] - second.flow.motions()[0]).norm(), 1e-12);
    EXPECT_LT((first.flow.impulses()[0] - second.flow.impulses()[0]).norm(), 1e-12);
}

TEST_P(WithOrWithoutBoundary, ARigidMotionOfAllIsLeftAlone) {
    // u = U + w x (x - X) everywhere is linear, and quadratic interpolation reproduces it: no slip.
    const Planar motion(0.3, -0.8, 1.1);
    Problem problem({disc(1, 3.013, 3.007, motion)}, GetParam());
    problem.field.fill([&](double x, double y) {
        return Planar(motion.x() - motion.z() * (y - 3.007), motion.y() + motion.z() * (x - 3.013),
                      0.0);
    });
    problem.solve(1e-4);
    problem.flow.impose();
    EXPECT_LT(problem.flow.impulses()[0].norm(), 1e-13);
    EXPECT_LT((problem.flow.motions()[0] - motion).norm(), 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Points, WithOrWithoutBoundary, testing::Bool());

/// W is linear: a velocity imposed in two parts, one of them in two shares, is the velocity imposed
/// at once, with the same motions and impulses.
TEST(ConstrainedFlow, ImposesAVelocityInParts) {
    Problem whole(loose_heap(), true), parts(loose_heap(), true);
    MemoryField change(96, 96, Side::wall);
    change.fill_randomly(21);
    whole.field.fill_randomly(22);
    parts.field.fill_randomly(22);
    const int cells = whole.field.owned_cells();
    for (int axis = 0; axis < 2; ++axis)
        for (int c = 0; c < cells; ++c) whole.field.velocity(axis)[c] += change.velocity(axis)[c];
    whole.solve(1e-12);
    whole.flow.push(pushes(4));
    whole.solve_on(1e-12);
    whole.flow.impose();

    parts.solve(1e-12);
    parts.flow.impose();
    ConstrainedFlow response;
    response.begin(parts.system, {change.velocity(0), change.velocity(1)});
    MultiplierSettings settings;
    settings.tolerance = 1e-12;
    EXPECT_GT(uzawa_cg(response, settings, parts.work).iterations, 0);
    response.impose();
    GrainChange four_fold;
    response.copy_to(four_fold);
    for (double& value : four_fold) value *= 4.0;
    parts.flow.add(four_fold, 0.25);
    for (int axis = 0; axis < 2; ++axis)
        for (int c = 0; c < cells; ++c) parts.field.velocity(axis)[c] += change.velocity(axis)[c];
    parts.flow.push(pushes(4));
    parts.solve_on(1e-12);
    parts.flow.impose();

    EXPECT_LT(largest_difference(whole.flow.motions(), parts.flow.motions()), 1e-10);
    EXPECT_LT(largest_difference(whole.flow.impulses(), parts.flow.impulses()), 1e-10);
    for (int axis = 0; axis < 2; ++axis)
        for (int c = 0; c < cells; ++c)
            ASSERT_NEAR(whole.field.velocity(axis)[c], parts.field.velocity(axis)[c], 1e-10);
}

TEST(EffectiveInertia, IsWhatAnImpulseMoves) {
    // Exact for a separate grain: a push causes the velocity predicted by the effective inertia.
    Problem problem({disc(1, 3.013, 3.007)}, true);
    problem.solve(1e-13);
    const Planar push(0.3, -0.2, 0.1);
    problem.flow.push({push});
    problem.solve_on(1e-13);
    const Planar wanted = problem.system.effective_inertia()[0].inverse() * push;
    EXPECT_LT((problem.flow.motions()[0] - wanted).norm(), 1e-11);
}

TEST(EffectiveInertia, HoldsTheFluidOfAboutTheDisc) {
    // cM + rho_f V(R) would be pi/8 + pi/4 = 1.18; boundary points tie additional fluid outside the
    // disc.
    Problem problem({disc(1, 3.013, 3.007)}, true);
    problem.system.assemble(problem.field, problem.grains, problem.points);
    const Eigen::Matrix3d& inertia = problem.system.effective_inertia()[0];
    EXPECT_GT(inertia(0, 0), 1.18);
    EXPECT_LT(inertia(0, 0), 1.18 * 1.15);
    EXPECT_LT((inertia - inertia.transpose()).norm(), 1e-14);
}

TEST(EffectiveInertia, IsNearlyRightAmongNeighbours) {
    // A grain is also moved by pushes on grains that share its cells, which its own inertia does
    // not contain. The difference must be small, or `joint` would need many rounds.
    Problem problem(loose_heap(), true);
    problem.solve(1e-13);
    const std::vector<Planar> before = problem.flow.motions(), given = pushes(4);
    problem.flow.push(given);
    problem.solve_on(1e-13);
    double largest = 0.0;
    for (int g = 0; g < 4; ++g) {
        const Planar told = problem.system.effective_inertia()[g].inverse() * given[g];
        const Planar rest = problem.flow.motions()[g] - before[g] - told;
        largest = std::max(largest, rest.norm() / told.norm());
    }
    EXPECT_GT(largest, 1e-6);  // the grains do share cells
    EXPECT_LT(largest, 0.2);
}

TEST(UzawaCg, OneIterationForGrainsThatShareNoCells) {
    Problem problem({disc(1, 1.513, 2.007), disc(2, 4.01, 4.02)}, true);
    problem.field.fill_randomly(8);
    const MultiplierResult result = problem.solve(1e-10);
    EXPECT_TRUE(result.converged);
    EXPECT_EQ(result.iterations, 1);
}

TEST(UzawaCg, FewIterationsAmongNeighbours) {
    Problem loose(loose_heap(), true), dense(dense_packing(), true);
    for (Problem* problem : {&loose, &dense}) {
        problem->field.fill_randomly(9);
        const MultiplierResult result = problem->solve(1e-5);
        EXPECT_TRUE(result.converged);
        EXPECT_GE(result.iterations, 2);
        EXPECT_LE(result.iterations, 25);
    }
}

TEST(UzawaCg, InteriorPointsNeedNone) {
    Problem problem(dense_packing(), false);
    problem.field.fill_randomly(10);
    const MultiplierResult result = problem.solve(1e-12);
    EXPECT_EQ(result.iterations, 0);
    EXPECT_TRUE(result.converged);
}

TEST(UzawaCg, SaysWhenItRanOutOfIterations) {
    Problem problem(loose_heap(), true);
    problem.field.fill_randomly(11);
    MultiplierSettings settings;
    settings.iterations = 1;
    problem.begin();
    const MultiplierResult result = uzawa_cg(problem.flow, settings, problem.work);
    EXPECT_FALSE(result.converged);
    EXPECT_EQ(result.iterations, 1);
    EXPECT_GT(result.residual, 1e-4);
}

TEST(UzawaCg, AShortStepIsStillSolvedToAHundredth) {
    // Slip 1e-5 of u_c, below the tolerance of 1e-4: without the second criterion nothing would be
    // solved.
    Problem problem({disc(1, 3.013, 3.007, {0.0, -1e-5, 0.0})}, true);
    problem.begin();
    const MultiplierResult result = uzawa_cg(problem.flow, {}, problem.work);
    EXPECT_GT(result.iterations, 0);
    EXPECT_LE(result.residual, 1e-7);
}

TEST(UzawaCg, NoGrainsNoWork) {
    Problem problem({}, true);
    const MultiplierResult result = problem.solve(1e-4);
    EXPECT_EQ(result.iterations, 0);
    EXPECT_TRUE(result.converged);
}

TEST(SaddleOperator, RefusesAGrainWithoutInertia) {
    ImmersedGrain ghost = disc(7, 30.0, 3.0);  // outside the grid: covers no fluid
    ghost.effective_mass *= -1.0;
    Problem problem({ghost}, true);
    EXPECT_THROW(problem.system.assemble(problem.field, problem.grains, problem.points),
                 std::runtime_error);
}

// Four cells wide, with a cell's corner in the middle: its points take all cells inside.
TEST(SaddleOperator, RefusesANeutralGrainWithoutCells) {
    ImmersedGrain small = disc(7, 3.0, 3.0, Planar::Zero(), 1.0);
    small.radius = 0.125;
    small.effective_mass = small.effective_inertia = 0.0;
    Problem problem({small}, true);
    ASSERT_EQ(problem.points.interior_begin[1], 0);
    try {
        problem.begin();
        FAIL() << "A is singular";
    } catch (const std::runtime_error& refusal) {
        EXPECT_NE(std::string(refusal.what()).find("grain 7 has the fluid's density"),
                  std::string::npos)
            << refusal.what();
    }
}

}  // namespace
}  // namespace turbidite
