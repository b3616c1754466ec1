// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/immersed_step.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <string>

#include "coupler/protocol/failure.hpp"
#include "tests/run_settings.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {
namespace {

constexpr double step = 0.01;
const Window window{0, 0.0, step};
constexpr double tolerance = 1e-5;  // of the mismatch

Settings settings(double slip_tolerance = 0.1 * tolerance) {
    Settings result = run_settings();
    result.set("run.slip_tolerance", slip_tolerance);
    result.set("fluid.points", std::string("interior+boundary"));
    result.set("fluid.point_spacing", 1.5);
    result.set("fluid.multiplier_iterations", std::int64_t{200});
    result.set("fluid.splitting", std::string("marchuk-yanenko"));
    return result;
}

GrainState grain(GrainId id, double x, double y, const Vec3& velocity = {}) {
    GrainState state;
    state.id = id;
    state.radius = 0.5;
    state.density = 1.5;
    state.position = {x, y, 0.0};
    state.velocity = velocity;
    return state;
}

/// A field with some initial flow, and step 5 on it.
struct Scene {
    explicit Scene(double slip_tolerance = 0.1 * tolerance)
        : field(96, 96, Side::wall), five(field, settings(slip_tolerance), {{"disc", {}}}) {
        field.fill([](double x, double y) {
            return Planar(0.01 * std::sin(x + 2.0 * y), 0.02 * std::cos(x - y), 0.0);
        });
    }

    MemoryField field;
    ImmersedStep five;
};

/// Neighbours whose boundary points share cells.
std::vector<GrainState> neighbours() {
    return {grain(1, 1.5, 2.0, {0.1, -0.5, 0.0}), grain(2, 2.61, 2.03, {-0.2, 0.3, 0.0}),
            grain(3, 2.03, 3.07, {0.0, -1.0, 0.0})};
}

/// What a contact solve would send for these impulses if it used the inertia of the responses.
std::vector<GrainState> after_contacts(std::vector<GrainState> grains,
                                       const std::vector<FreeResponse>& responses) {
    for (std::size_t g = 0; g < grains.size(); ++g) {
        constexpr std::size_t six[] = {0, 1, 5};  // x, y, spin
        Eigen::Matrix3d inertia;
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j)
                inertia(i, j) = inertia(j, i) = responses[g].inertia[upper_entry(six[i], six[j])];
        const Planar impulse(0.01 * double(g + 1), 0.02, -0.004);
        const Planar free(responses[g].velocity[0], responses[g].velocity[1],
                          responses[g].angular_velocity[2]);
        const Planar moved = free + inertia.inverse() * impulse;
        grains[g].velocity = {moved.x(), moved.y(), 0.0};
        grains[g].angular_velocity = {0.0, 0.0, moved.z()};
        grains[g].contact_impulse = {impulse.x(), impulse.y(), 0.0};
        grains[g].contact_angular_impulse = {0.0, 0.0, impulse.z()};
    }
    return grains;
}

double largest_mismatch(const std::vector<FreeResponse>& responses) {
    double largest = 0.0;
    for (const FreeResponse& response : responses) largest = std::max(largest, response.mismatch);
    return largest;
}

TEST(ImmersedStep, AGrainByItselfNeedsOneRound) {
    Scene scene;
    const std::vector<GrainState> grains = {grain(4, 3.013, 3.007, {0.1, -0.5, 0.0})};
    scene.five.take_free(grains, window);
    scene.five.solve();
    scene.five.push(after_contacts(grains, scene.five.responses()));
    EXPECT_LT(largest_mismatch(scene.five.responses()), 1e-9);
}

// Of a grain slower than what contacts and fluid may differ by, nobody knows that it moves.
TEST(ImmersedStep, GrainsThatMoveHaveCrossedCells) {
    Settings coupled = settings();
    coupled.set("coupling.tolerance", 1e-3);
    MemoryField field(96, 96, Side::wall);
    ImmersedStep five(field, coupled, {{"disc", {}}});
    const std::vector<GrainState> grains = {grain(1, 1.5, 2.0, {0.1, -0.5, 0.0}),
                                            grain(2, 3.6, 2.0, {0.0, 0.9e-3, 0.0})};
    five.take_free(grains, {1, step, step});
    EXPECT_EQ(five.grains()[0].moved, Eigen::Vector3d(0.1 * step, -0.5 * step, 0.0));
    EXPECT_EQ(five.grains()[1].moved, Eigen::Vector3d::Zero());
    five.take_free(grains, window);  // the first of the run
    EXPECT_EQ(five.grains()[0].moved, Eigen::Vector3d::Zero());
}

TEST(ImmersedStep, NeighboursAgreeWithinTheToleranceAfterAFewRounds) {
    Scene scene;
    scene.five.take_free(neighbours(), window);
    scene.five.solve();
    double mismatch = 1.0;
    int rounds = 0;
    for (; mismatch > tolerance && rounds < 6; ++rounds) {
        scene.five.push(after_contacts(neighbours(), scene.five.responses()));
        mismatch = largest_mismatch(scene.five.responses());
        if (rounds == 0) {
            EXPECT_GT(mismatch, tolerance);  // the case is not trivial
        }
    }
    EXPECT_LE(mismatch, tolerance);
    EXPECT_LE(rounds, 3);
}

TEST(ImmersedStep, MomentumIsExactWithContactImpulses) {
    // c M (U - U^n) = c M g dt + J + dt lambda, and the fluid loses dt lambda.
    Scene scene;
    const Planar before = scene.field.momentum();
    scene.five.take_free(neighbours(), window);
    scene.five.solve();
    const auto pushed = after_contacts(neighbours(), scene.five.responses());
    scene.five.push(pushed);
    scene.five.impose();
    const double c_mass = 0.5 * 3.14159265358979 / 4.0;  // rho_s = 1.5
    const std::vector<Kick> kicks = scene.five.kicks();
    for (std::size_t g = 0; g < kicks.size(); ++g) {
        const double change = kicks[g].velocity[1] - neighbours()[g].velocity[1];
        EXPECT_NEAR(c_mass * (change + step),
                    pushed[g].contact_impulse[1] + kicks[g].multiplier_impulse[1], 1e-13);
    }
    const Planar change = scene.field.momentum() - before;
    EXPECT_NEAR(change.y(), -scene.five.impulse_to_grains().linear[1], 1e-12);
}

TEST(ImmersedStep, WithoutContactsFreeGrainsAreThoseThatFellBefore) {
    // U^{n+4/5} = U^n - g dt is the result of a contact solve without contacts.
    Scene free_fall, constrained(1e-4);
    free_fall.five.take_free(neighbours(), window);
    free_fall.five.solve();
    std::vector<GrainState> fallen = neighbours();
    for (GrainState& state : fallen) state.velocity[1] -= step;
    constrained.five.take_constrained(fallen, window);
    constrained.five.solve();
    const std::vector<FreeResponse> free = free_fall.five.responses();
    constrained.five.impose();
    const std::vector<Kick> kicks = constrained.five.kicks();
    ASSERT_EQ(free.size(), kicks.size());
    for (std::size_t g = 0; g < kicks.size(); ++g)
        for (int axis = 0; axis < 2; ++axis)
            EXPECT_NEAR(free[g].velocity[axis], kicks[g].velocity[axis], 2e-4);  // tolerances
}

TEST(ImmersedStep, PrescribedGrainsKeepTheirMotionAndTheFluidIsPushed) {
    Scene scene;
    const Planar before = scene.field.momentum();
    std::vector<GrainState> grains = neighbours();
    grains[0].prescribed = grains[1].prescribed = true;
    grains[1].velocity = {};
    scene.five.take_free(grains, window);
    scene.five.solve();
    std::vector<FreeResponse> responses = scene.five.responses();
    for (int g : {0, 1}) {
        EXPECT_EQ(responses[g].velocity, grains[g].velocity);
        for (const double entry : responses[g].inertia) EXPECT_EQ(entry, 0.0);
        responses[g].inertia = responses[2].inertia;  // for after_contacts, which inverts it
    }
    std::vector<GrainState> pushed = after_contacts(grains, responses);
    for (int g : {0, 1}) {
        pushed[g].velocity = grains[g].velocity;
        pushed[g].angular_velocity = {};
    }
    scene.five.push(pushed);
    EXPECT_EQ(scene.five.responses()[0].mismatch, 0.0);
    EXPECT_GT(scene.five.responses()[2].mismatch, 0.0);
    scene.five.impose();
    const std::vector<Kick> kicks = scene.five.kicks();
    for (int g : {0, 1}) EXPECT_EQ(kicks[g].velocity, grains[g].velocity);
    EXPECT_GT(kicks[0].multiplier_impulse[1], 0.1);  // it is driven down against the fluid
    const Planar change = scene.field.momentum() - before;
    EXPECT_NEAR(change.y(), -scene.five.impulse_to_grains().linear[1], 1e-12);
}

TEST(ImmersedStep, AGrainOnItsWayOutIsAnsweredFor) {
    MemoryField field(96, 96, Side::open);
    ImmersedStep five(field, settings(1e-4), {{"disc", {}}});
    five.take_constrained({grain(9, -0.3, 2.0), grain(10, 2.0, 6.2)}, window);
    five.solve();
    five.impose();
    EXPECT_EQ(five.kicks().size(), 2u);
}

TEST(ImmersedStep, NamesAGrainThatTheWindowDidNotBeginWith) {
    Scene scene;
    scene.five.take_free({grain(4, 3.0, 3.0)}, window);
    scene.five.solve();
    try {
        scene.five.push({grain(5, 3.0, 3.0)});
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("grain 5"), std::string::npos);
    }
}

TEST(ImmersedStep, NamesAGrainThatIsSentTwiceInsteadOfAnother) {
    Scene scene;
    scene.five.take_free(neighbours(), window);
    scene.five.solve();
    std::vector<GrainState> pushed = after_contacts(neighbours(), scene.five.responses());
    pushed[2] = pushed[0];
    try {
        scene.five.push(pushed);
        FAIL() << "the impulse on grain 3 is lost";
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("twice for grain 1"), std::string::npos)
            << error.what();
    }
}

/// Whatever changes the motions after the contact solve, such as pressure with rigid grains.
TEST(ImmersedStep, TellsTheMismatchOfTheVelocitiesThatItSends) {
    Scene scene;
    const std::vector<GrainState> grains = {grain(4, 3.013, 3.007, {0.1, -0.5, 0.0})};
    scene.five.take_free(grains, window);
    scene.five.solve();
    const auto pushed = after_contacts(grains, scene.five.responses());
    scene.five.push(pushed);
    EXPECT_LT(scene.five.responses()[0].mismatch, 1e-9);
    scene.five.constraint().push({{{0.02, 0.01, 0.0}, {}}});
    const double told = scene.five.responses()[0].mismatch;
    scene.five.impose();
    const Kick kick = scene.five.kicks()[0];
    const double off = std::hypot(kick.velocity[0] - pushed[0].velocity[0],
                                  kick.velocity[1] - pushed[0].velocity[1]) +
                       0.5 * std::abs(kick.angular_velocity[2] - pushed[0].angular_velocity[2]);
    EXPECT_GT(off, 1e-3);
    EXPECT_NEAR(told, off, 1e-12);
}

double cells_covered(const MemoryField& field, const Constraint& constraint) {
    std::vector<double> outside(field.owned_cells(), 1.0);
    constraint.clear_covered(outside.data());
    return std::accumulate(outside.begin(), outside.end(), double(field.owned_cells()),
                           std::minus<>());
}

/// Of a grain with R_h the fluid sees the similar body of that size, whatever its shape: it covers
/// (R_h/R)^2 of the area, and takes the mass of that much fluid from M.
TEST(ImmersedStep, TheHydrodynamicRadiusShrinksEveryShape) {
    const std::vector<ShapeRecord> shapes = {
        {"disc", {}}, {"triangle", {}}, {"polygon", {0.8, 0.6, -0.8, 0.6, -0.8, -0.6, 0.8, -0.6}}};
    for (const ShapeRecord& shape : shapes) {
        std::array<double, 2> covered{}, mass{};
        for (const int shrunk : {0, 1}) {
            MemoryField field(192, 192, Side::wall, 1.0 / 32.0);
            Settings with = settings();
            with.set("fluid.hydrodynamic_radius", shrunk == 1 ? 0.7 : 1.0);
            with.set("fluid.points", std::string("interior"));
            ImmersedStep five(field, with, {shape});
            five.take_free({grain(1, 3.013, 3.007)}, window);
            covered[shrunk] = cells_covered(field, five.constraint()) / (32.0 * 32.0);
            mass[shrunk] = five.grains()[0].effective_mass;
        }
        const double area = make_shape(shape)->volume(0.5);
        EXPECT_NEAR(covered[0], area, 0.05 * area) << shape.kind;
        EXPECT_NEAR(covered[1], 0.49 * area, 0.05 * area) << shape.kind;
        EXPECT_NEAR(mass[0], 0.5 * area, 1e-12) << shape.kind;  // rho_s = 1.5
        EXPECT_NEAR(mass[1], (1.5 - 0.49) * area, 1e-12) << shape.kind;
    }
}

TEST(ImmersedStep, UnknownPointsListTheKnown) {
    Settings wrong = settings(1e-4);
    wrong.set("fluid.points", std::string("surface"));
    MemoryField field(16, 16, Side::wall);
    try {
        ImmersedStep five(field, wrong, {{"disc", {}}});
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_NE(std::string(error.what()).find("interior+boundary"), std::string::npos);
    }
}

// A disc lighter than the fluid leaves through a free side: beyond it there are no cells to move,
// and it must not move as if it had no mass there.
TEST(ImmersedStep, AGrainOnItsWayOutKeepsItsInertia) {
    for (const double x : {3.0, 5.7, 6.0, 6.3, 6.47}) {
        MemoryField field(96, 96, Side::open);
        field.fill([](double, double) { return Planar(0.2, -0.1, 0.0); });
        Settings coupled = settings(1e-6);
        coupled.set("fluid.splitting", std::string("explicit-multiplier"));
        ImmersedStep five(field, coupled, {{"disc", {}}});
        GrainState light = grain(9, x, 3.0, {0.2, -0.1, 0.0});
        light.density = 0.9;
        five.take_free({light}, window);
        five.solve();
        five.impose();
        // (M - m_f) g dt on M: -(0.9 - 1)/0.9 dt upwards; boundary points hold some fluid more.
        const Kick kick = five.kicks().at(0);
        const double rise = kick.velocity[1] + 0.1, whole = 0.1 / 0.9 * step;
        EXPECT_LT(rise, 1.05 * whole) << x;
        EXPECT_GT(rise, 0.45 * whole) << x;
        EXPECT_LT(0.5 * std::abs(kick.angular_velocity[2]), 0.1 * whole) << x;
    }
}

// The same after a contact solve, which has moved cM alone.
TEST(ImmersedStep, AGrainOnItsWayOutMovesAlikeBeforeAndAfterContacts) {
    const Planar stream(0.2, -0.1, 0.0);
    for (const double x : {5.7, 6.3}) {
        MemoryField free_field(96, 96, Side::open), field(96, 96, Side::open);
        for (MemoryField* of : {&free_field, &field})
            of->fill([&](double, double) { return stream; });
        ImmersedStep free(free_field, settings(1e-7), {{"disc", {}}});
        ImmersedStep constrained(field, settings(1e-7), {{"disc", {}}});
        GrainState state = grain(9, x, 3.0, {0.2, -0.1, 0.0});
        free.take_free({state}, window);
        free.solve();
        free.impose();
        state.velocity[1] -= step;  // (M - m_f) g dt/cM, with R_h = R
        constrained.take_constrained({state}, window);
        constrained.solve();
        constrained.impose();
        const Kick expected = free.kicks().at(0), found = constrained.kicks().at(0);
        for (int axis : {0, 1}) {
            EXPECT_NEAR(found.velocity[axis], expected.velocity[axis], 1e-6) << x;
            EXPECT_NEAR(found.multiplier_impulse[axis], expected.multiplier_impulse[axis], 1e-6)
                << x;
        }
        // It has fallen by less than cM alone would.
        EXPECT_GT(found.velocity[1], -0.1 - 0.6 * step) << x;
    }
}

/// What is said of walls in rows of D/8 that grow above 6 D, at a time; empty: nothing.
std::string refusal_of(const std::string& walls, double time, std::int64_t dimension = 2) {
    Settings rows = settings();
    rows.set("fluid.cells_per_diameter", std::int64_t{8});
    rows.set("fluid.stretch_from", 6.0);
    rows.set("fluid.stretch_ratio", 1.1);
    rows.set("fluid.stretch_largest", 8.0);
    rows.set("run.dimension", dimension);
    rows.set("run.acceleration_z", 0.0);
    for (const char* side : {"domain.front", "domain.back"}) rows.set(side, std::string("wall"));
    rows.set("run.walls", walls);
    std::vector<ImmersedGrain> bodies;
    ImmersedWalls immersed(rows);
    try {
        immersed.append(time, step, bodies);
    } catch (const PhysicsRefused& refused) {
        return refused.what();
    }
    return "";
}

// Two cells thick, they rise by 1 D per t_c.
TEST(ImmersedWalls, ThatMoveToRowsTooHighForThemAreRefused) {
    const std::string shelf = "3 4 4 6 4 0 1 0 5 4 0.3 0.25",
                      gate = "4 5 4 5 5 0 1 0 5 4.5 0.3 0.25";
    EXPECT_EQ(refusal_of(shelf, 1.8), "");
    EXPECT_NE(refusal_of(shelf, 2.5).find("wall 3 has come to higher rows"), std::string::npos);
    EXPECT_EQ(refusal_of(gate, 4.0), "") << "no row is across it";
    const std::string turning = "5 5 6.5 5 8.5 0 0 1 5 7.5 0.3 0.25";
    EXPECT_EQ(refusal_of(turning, 0.0), "");
    EXPECT_NE(refusal_of(turning, 1.5), "");
}

TEST(ImmersedWalls, InSpaceThatMoveToRowsTooHighForThemAreRefused) {
    const std::string rising = " 0.25 0 1 0 0 0 0 5 4 5 0.3 -1";
    const std::string disc = "7 ring 5 4 5 0 1 0 0 0 0 0 1" + rising,
                      pipe = "8 cylinder 5 4 5 0 1 0 0 0 0 1 0" + rising;
    EXPECT_EQ(refusal_of(disc, 1.8, 3), "");
    EXPECT_NE(refusal_of(disc, 2.5, 3).find("wall 7 has come to higher rows"), std::string::npos);
    EXPECT_EQ(refusal_of(pipe, 2.5, 3), "");
}

}  // namespace
}  // namespace turbidite
