// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres in space: which cells are theirs, and the closed form of the constraint.
#include "fluid_adapter/multiplier/space/interior_constraint.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/unit/multiplier/space_field.hpp"

namespace turbidite {
namespace {

/// Overlapping as spheres that touch do where R_h is larger than R, one across a corner of the
/// cyclic box, and one of another size.
std::vector<ImmersedGrain> heap() {
    return {sphere(3, {1.02, 1.03, 1.01}), sphere(1, {1.98, 1.06, 1.05}),
            sphere(2, {1.49, 1.88, 1.1}), sphere(5, {0.03, 2.97, 0.01}),
            sphere(4, {2.2, 2.1, 2.0}, 0.62)};
}

/// Grain of every cell by the definition, -1 none, without cells that are shut in.
std::vector<int> owners(const SpaceField& field, const std::vector<ImmersedGrain>& grains) {
    const CellGrid& grid = field.grid();
    std::vector<int> owner(field.owned_cells(), -1);
    for (int j = 0; j < grid.counts[1]; ++j)
        for (int k = 0; k < grid.counts[2]; ++k)
            for (int i = 0; i < grid.counts[0]; ++i) {
                double least = 0.0;
                const Eigen::Vector3d centre(grid.centre(0, i), grid.centre(1, j),
                                             grid.centre(2, k));
                for (std::size_t g = 0; g < grains.size(); ++g) {
                    const double power =
                        grid.nearest_image(centre - grains[g].position).squaredNorm() -
                        grains[g].radius * grains[g].radius;
                    if (power >= least) continue;
                    least = power;
                    owner[field.cell(i, j, k)] = static_cast<int>(g);
                }
            }
    return owner;
}

TEST(SphereCells, AreThoseInsideDividedByPlanes) {
    for (const Side side : {Side::cyclic, Side::wall}) {
        const SpaceField field({30, 32, 31}, side);
        const std::vector<ImmersedGrain> grains = heap();
        SphereCells cells(field.layers());
        cells.find(grains);
        const std::vector<int> wanted = owners(field, grains);
        const std::vector<int> found = found_owners(field, cells, static_cast<int>(grains.size()));
        int covered = 0, differ = 0;
        for (std::size_t c = 0; c < wanted.size(); ++c) {
            covered += wanted[c] >= 0;
            differ += wanted[c] != found[c];
        }
        EXPECT_GT(covered, 2000);
        EXPECT_EQ(differ, cells.shut_in());
    }
}

/// Of every cell that of the nearest image; calls visit(g, i) for cells in column i of grain g.
template <class Visit>
void expect_right_arms(const SpaceField& field, const SphereCells& cells,
                       const std::vector<ImmersedGrain>& grains, const Visit& visit) {
    const auto [nx, ny, nz] = field.grid().counts;
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (const CellRun& run : cells.runs(g))
            for (int c = 0; c < run.count; ++c) {
                const int i = run.cell % nx + c, k = run.cell / nx % nz, j = run.cell / (nx * nz);
                const Eigen::Vector3d centre(field.grid().centre(0, i), field.grid().centre(1, j),
                                             field.grid().centre(2, k));
                const Eigen::Vector3d arm = run.first + c * edge * Eigen::Vector3d::UnitX();
                const Eigen::Vector3d off =
                    field.grid().nearest_image(centre - grains[g].position) - arm;
                EXPECT_LT(off.norm(), 1e-12);
                visit(static_cast<int>(g), i);
            }
}

TEST(SphereCells, RunsKnowTheirArms) {
    const SpaceField field({30, 32, 31}, Side::cyclic);
    const std::vector<ImmersedGrain> grains = heap();
    SphereCells cells(field.layers());
    cells.find(grains);
    int split = 0;
    expect_right_arms(field, cells, grains, [&](int g, int i) { split += i == 29 && g == 3; });
    EXPECT_GT(split, 10) << "no run crosses the cyclic side";
}

// With a surface shift a sphere may reach farther than half a period: no cell is there twice.
TEST(SphereCells, OfASphereThatMeetsItselfAreThereOnce) {
    for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.47, 0.53, 0.36), {0.02, 0.98, 0.51}}) {
        const SpaceField field({10, 10, 10}, Side::cyclic);
        const std::vector<ImmersedGrain> grains = {sphere(1, at, 0.53)};
        SphereCells cells(field.layers());
        cells.find(grains);
        const std::vector<int> wanted = owners(field, grains);
        EXPECT_GT(std::count(wanted.begin(), wanted.end(), 0), 500);
        EXPECT_EQ(found_owners(field, cells, 1), wanted);
        expect_right_arms(field, cells, grains, [](int, int) {});
    }
}

/// Eight spheres on the corners of a cube, so close that single cells are left between.
std::vector<ImmersedGrain> cage() {
    std::vector<ImmersedGrain> spheres;
    for (int corner = 0; corner < 8; ++corner)
        spheres.push_back(
            sphere(corner,
                   {1.55 + (corner % 2 - 0.5) * 1.0, 1.55 + (corner / 2 % 2 - 0.5) * 1.0,
                    1.55 + (corner / 4 - 0.5) * 1.0},
                   0.83));
    return spheres;
}

TEST(SphereCells, ACellWithSixCoveredNeighboursJoinsTheNearestSphere) {
    const SpaceField field({30, 30, 30}, Side::wall);
    SphereCells cells(field.layers());
    cells.find(cage());
    const std::vector<int> inside = owners(field, cage());
    ASSERT_GT(cells.shut_in(), 0);
    const std::vector<int> found = found_owners(field, cells, 8);
    const int centre = field.cell(15, 15, 15);
    EXPECT_EQ(inside[centre], -1);
    EXPECT_GE(found[centre], 0);
}

/// The cells of a sphere in the order in which they are summed.
std::vector<int> cells_of(const SphereCells& cells, std::size_t grain) {
    std::vector<int> all;
    for (const CellRun& run : cells.runs(grain))
        for (int c = 0; c < run.count; ++c) all.push_back(run.cell + c);
    return all;
}

/// Spheres that leave single cells between them, at random places.
std::vector<ImmersedGrain> crowd(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.3, 2.7), size(0.4, 0.7);
    std::vector<ImmersedGrain> spheres;
    for (int id = 0; id < 20; ++id) {
        const double px = place(random), py = place(random), pz = place(random);
        spheres.push_back(sphere(id, {px, py, pz}, size(random)));
    }
    return spheres;
}

// Sums have the same digits whatever the order in which grains come.
TEST(SphereCells, CellsThatAreShutInComeInTheOrderOfTheMesh) {
    const SpaceField field({30, 30, 30}, Side::wall);
    int with_several = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        std::vector<ImmersedGrain> grains = crowd(seed), backwards = grains;
        std::reverse(backwards.begin(), backwards.end());
        SphereCells cells(field.layers()), again(field.layers());
        cells.find(grains);
        again.find(backwards);
        with_several += cells.shut_in() > 1;
        for (std::size_t g = 0; g < grains.size(); ++g)
            ASSERT_EQ(cells_of(cells, g), cells_of(again, grains.size() - 1 - g)) << seed;
    }
    EXPECT_GT(with_several, 10);
}

/// The definition of wedges, of a box between walls: by cell, with walls as owner -3 and without
/// cells that are shut in.
struct WedgesByDefinition {
    const SpaceField& field;
    std::vector<int> owner;

    int at(const CellPlace& of) const {
        const auto [nx, ny, nz] = field.grid().counts;
        const bool inside =
            of.i >= 0 && of.i < nx && of.j >= 0 && of.j < ny && of.k >= 0 && of.k < nz;
        return inside ? owner[field.cell(of.i, of.j, of.k)] : -3;
    }

    bool has(const CellPlace& of) const {
        if (at(of) < 0) return false;
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1})
                if (const int other = at(of.beside(axis, side)); other != at(of) && other != -1)
                    return true;
        return false;
    }
};

using SideList = std::vector<std::array<int, 3>>;

SideList sorted(const std::vector<CellSide>& sides, int cells_below = 0) {
    SideList list;
    for (const CellSide& of : sides) list.push_back({of.cell + cells_below, of.axis, of.side});
    std::sort(list.begin(), list.end());
    return list;
}

/// Two spheres that touch on the mesh, one of which reaches into the floor and one whose surface is
/// three cells from both of them.
TEST(Wedges, AreWhereSpheresTouchEachOtherOrAWall) {
    const SpaceField field({30, 32, 31}, Side::wall);
    const std::vector<ImmersedGrain> grains = {
        sphere(1, {1.02, 0.46, 1.01}), sphere(2, {1.78, 1.06, 1.05}), sphere(3, {1.5, 2.4, 1.2})};
    SphereCells cells(field.layers());
    cells.find(grains);
    ASSERT_EQ(cells.shut_in(), 0);
    const WedgesByDefinition wedges{field, found_owners(field, cells, 3)};
    SideList wanted;
    int at_wall = 0, of_third = 0;
    for (int j = 0; j < 32; ++j)
        for (int k = 0; k < 31; ++k)
            for (int i = 0; i < 30; ++i) {
                const CellPlace at{i, j, k};
                if (!wedges.has(at)) continue;
                at_wall += j == 0, of_third += wedges.at(at) == 2;
                for (int axis = 0; axis < 3; ++axis)
                    for (const int side : {-1, 1})
                        if (wedges.has(at.beside(axis, side)))
                            wanted.push_back({field.cell(i, j, k), axis, side});
            }
    std::sort(wanted.begin(), wanted.end());
    EXPECT_EQ(sorted(cells.find_wedges().sides()), wanted);
    EXPECT_GT(at_wall, 10);
    EXPECT_GT(static_cast<int>(wanted.size()), 6 * at_wall / 2) << "none between the spheres";
    EXPECT_EQ(of_third, 0);
}

TEST(Wedges, HaveTheCellsThatAreShutIn) {
    const SpaceField field({30, 30, 30}, Side::wall);
    SphereCells cells(field.layers());
    cells.find(cage());
    ASSERT_GT(cells.shut_in(), 0);
    const int centre = field.cell(15, 15, 15);
    const SideList sides = sorted(cells.find_wedges().sides());
    for (int axis = 0; axis < 3; ++axis)
        for (const int side : {-1, 1})
            EXPECT_TRUE(std::binary_search(sides.begin(), sides.end(),
                                           std::array<int, 3>{centre, axis, side}));
}

/// Two ranks of layers have together the cells of one, and the wedges.
TEST(SphereCells, RanksOfLayersHaveTheCellsOfOne) {
    const std::array<int, 3> box{30, 32, 31};
    const SpaceField whole(box, Side::cyclic), low(box, Side::cyclic, 0, 13),
        high(box, Side::cyclic, 13, 19);
    const std::vector<ImmersedGrain> grains = heap();
    SphereCells all(whole.layers()), below(low.layers()), above(high.layers());
    for (SphereCells* cells : {&all, &below, &above}) cells->find(grains);
    std::vector<int> parts = found_owners(low, below, 5);
    const std::vector<int> upper = found_owners(high, above, 5);
    parts.insert(parts.end(), upper.begin(), upper.end());
    EXPECT_EQ(parts, found_owners(whole, all, 5));
    SideList sides = sorted(below.find_wedges().sides());
    const SideList more = sorted(above.find_wedges().sides(), low.owned_cells());
    EXPECT_GT(std::min(sides.size(), more.size()), 20u);
    sides.insert(sides.end(), more.begin(), more.end());
    EXPECT_EQ(sides, sorted(all.find_wedges().sides()));
}

struct Scene {
    Scene() : field({30, 32, 31}, Side::cyclic), grains(heap()), constraint(field) {
        field.fill_randomly(3);
        constraint.place(grains);
    }

    SpaceField field;
    std::vector<ImmersedGrain> grains;
    InteriorConstraint constraint;
};

double largest_deformation(Scene& scene) {
    double largest = 0.0;
    for (std::size_t g = 0; g < scene.grains.size(); ++g)
        for (const CellRun& run : scene.constraint.cells().runs(g))
            for (int c = 0; c < run.count; ++c) {
                const Twist motion = scene.constraint.motion(g);
                const Vec3 arm{run.first.x() + c * edge, run.first.y(), run.first.z()};
                for (int axis = 0; axis < 3; ++axis)
                    largest = std::max(largest, std::abs(scene.field.velocity(axis)[run.cell + c] -
                                                         motion.at(arm)[axis]));
            }
    return largest;
}

/// cM U gains what the fluid loses, in all three directions, and about every axis.
TEST(InteriorConstraint, MovesCellsWithTheirGrainsAndKeepsMomentum) {
    Scene scene;
    const Vec3 before = scene.field.momentum();
    scene.constraint.solve(scene.field.all());
    std::vector<Impulse> pushes(scene.grains.size());
    pushes[1] = {{0.02, -0.01, 0.03}, {0.001, 0.002, -0.003}};
    scene.constraint.push(pushes);
    scene.constraint.impose();
    EXPECT_LT(largest_deformation(scene), 1e-13);
    Vec3 to_grains{};
    for (std::size_t g = 0; g < scene.grains.size(); ++g) {
        const ImmersedGrain& grain = scene.grains[g];
        const Twist now = scene.constraint.motion(g);
        const Impulse impulse = scene.constraint.impulse(g) + pushes[g];
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(
                grain.effective_mass * (now.velocity[axis] - grain.contact_motion.velocity[axis]),
                impulse.linear[axis], 1e-14);
            EXPECT_NEAR(
                grain.effective_inertia * (now.spin[axis] - grain.contact_motion.spin[axis]),
                impulse.moment[axis], 1e-14);
        }
        EXPECT_GT(norm(impulse.moment), 1e-4);
        to_grains = to_grains + scene.constraint.impulse(g).linear;
    }
    EXPECT_LT(norm(scene.field.momentum() - before + to_grains), 1e-13);
    EXPECT_GT(norm(to_grains), 1e-2);
}

TEST(InteriorConstraint, ItsMapOfChangesIsSymmetric) {
    Scene scene;
    scene.constraint.solve(scene.field.all());
    SpaceField a({30, 32, 31}, Side::cyclic), b({30, 32, 31}, Side::cyclic);
    a.fill_randomly(5), b.fill_randomly(6);
    SpaceField wa({30, 32, 31}, Side::cyclic), wb({30, 32, 31}, Side::cyclic);
    wa.fill_randomly(5), wb.fill_randomly(6);
    GrainChange of_a, of_b;
    scene.constraint.make_rigid(wa.all(), 1e-2, of_a);
    scene.constraint.make_rigid(wb.all(), 1e-2, of_b);
    EXPECT_GT(std::abs(a.product(wb) - a.product(b)), 1.0) << "nothing was made rigid";
    EXPECT_NEAR(a.product(wb), b.product(wa), 1e-9 * std::abs(a.product(a)));
    EXPECT_GT(wa.product(a), 0.0);
}

/// What is imposed in two parts is what is imposed at once.
TEST(InteriorConstraint, ChangesAreAdded) {
    Scene whole, parts;
    SpaceField change({30, 32, 31}, Side::cyclic);
    change.fill_randomly(9);
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < change.owned_cells(); ++c)
            whole.field.velocity(axis)[c] += 0.5 * change.velocity(axis)[c];
    whole.constraint.solve(whole.field.all());
    whole.constraint.impose();

    parts.constraint.solve(parts.field.all());
    parts.constraint.impose();
    GrainChange of_grains;
    parts.constraint.make_rigid(change.all(), 1.0, of_grains);
    parts.constraint.add(of_grains, 0.5);
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < change.owned_cells(); ++c) {
            parts.field.velocity(axis)[c] += 0.5 * change.velocity(axis)[c];
            ASSERT_NEAR(parts.field.velocity(axis)[c], whole.field.velocity(axis)[c], 1e-13);
        }
    for (std::size_t g = 0; g < whole.grains.size(); ++g) {
        EXPECT_LT(norm(whole.constraint.motion(g).spin - parts.constraint.motion(g).spin), 1e-12);
        EXPECT_LT(norm(whole.constraint.impulse(g).linear - parts.constraint.impulse(g).linear),
                  1e-13);
    }
    EXPECT_LT(largest_deformation(parts), 1e-12);
}

TEST(InteriorConstraint, PrescribedSpheresKeepTheirMotion) {
    Scene scene;
    scene.grains[0].prescribed = true;
    scene.constraint.place(scene.grains);
    scene.constraint.solve(scene.field.all());
    scene.constraint.push(std::vector<Impulse>(5, {{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}));
    scene.constraint.impose();
    EXPECT_TRUE(scene.constraint.motion(0) == scene.grains[0].contact_motion);
    EXPECT_FALSE(scene.constraint.motion(1) == scene.grains[1].contact_motion);
    EXPECT_GT(norm(scene.constraint.impulse(0).linear), 1e-3);
}

/// What the contact solve uses is right in the mean, and what it misses is small: the coupling of
/// translation and rotation by the grid, at most 5.5 % for a sphere at D/8.
TEST(InteriorConstraint, TheIsotropicInertiaIsNearlyTheWhole) {
    Scene scene;
    scene.constraint.solve(scene.field.all());
    const std::size_t alone = 3;
    const Twist before = scene.constraint.motion(alone);
    std::vector<Impulse> pushes(scene.grains.size());
    pushes[alone] = {{0.02, -0.01, 0.03}, {0.001, 0.002, -0.003}};
    scene.constraint.push(pushes);
    const Twist now = scene.constraint.motion(alone);
    const Twist told = scene.constraint.moved_by(alone, pushes[alone]);
    const Vec3 change = now.velocity - before.velocity;
    EXPECT_GT(norm(change - told.velocity), 0.0);
    EXPECT_LT(norm(change - told.velocity), 0.055 * norm(change));
    EXPECT_LT(norm(now.spin - before.spin - told.spin), 0.055 * norm(now.spin - before.spin));
    EXPECT_EQ(scene.constraint.effective_inertia(alone)[upper_entry(1, 2)], 0.0);
}

TEST(InteriorConstraint, RefusesALightSphereThatCoversTooLittle) {
    SpaceField field({30, 30, 30}, Side::wall);
    InteriorConstraint constraint(field);
    const std::vector<ImmersedGrain> outside = {sphere(8, {-0.45, 1.0, 1.0}, 0.5, 0.2)};
    try {
        constraint.place(outside);
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("grain 8"), std::string::npos) << error.what();
    }
}

/// A sphere with the fluid around it moves as a whole, and a weight acts on it.
struct Carried {
    explicit Carried(double x, double density_ratio) : field({20, 30, 20}, Side::open) {
        ImmersedGrain grain = sphere(1, {x, 1.5, 1.0}, 0.5, density_ratio);
        const ImmersedBody body = immersed_body(*grain.shape, 0.5, density_ratio, 1.0, 1.0);
        mass = body.mass;
        grain.contact_motion = grain.motion_before = {{0.3, -0.4, 0.1}, {}};
        grain.given_impulse.linear[1] = -0.01;
        grain.beyond = fluid_beyond(field.grid(), grain, body.displaced_mass);
        grains = {grain};
        for (int axis = 0; axis < 3; ++axis)
            std::fill_n(field.velocity(axis), field.owned_cells(),
                        grain.contact_motion.velocity[axis]);
    }

    SpaceField field;
    std::vector<ImmersedGrain> grains;
    double mass = 0.0;
};

// Wherever its parts are, all of its mass is moved: M dU = dt F, and it does not turn.
TEST(InteriorConstraint, ASphereThatLeavesKeepsItsInertia) {
    for (const double density : {1.02, 1.5, 3.0})
        for (const double x : {1.0, 1.7, 2.0, 2.3, 2.49}) {
            Carried scene(x, density);
            InteriorConstraint constraint(scene.field);
            constraint.place(scene.grains);
            constraint.solve(scene.field.all());
            const Twist motion = constraint.motion(0);
            const double expected = -0.01 / scene.mass;
            // At D/10 the cells of this sphere have 5 % more volume than it has.
            EXPECT_NEAR(motion.velocity[1] + 0.4, expected, 0.06 * std::abs(expected))
                << density << " at " << x;
            EXPECT_NEAR(motion.velocity[0], 0.3, 1e-3);
            EXPECT_LT(norm(motion.spin) * 0.5, 0.05 * std::abs(expected)) << density << " at " << x;
            EXPECT_EQ(scene.grains[0].beyond.mass > 0.0, x > 1.5);
        }
}

// A body force gives all fluid the same velocity, that beyond the side as well.
TEST(InteriorConstraint, TheFluidBeyondASideFeelsTheBodyForce) {
    for (const double density : {1.02, 3.0})
        for (const double x : {1.0, 1.7, 2.0, 2.3}) {
            Carried scene(x, density);
            ImmersedGrain& grain = scene.grains[0];
            grain.given_impulse = {};
            grain.stream_gain = {0.05, 0.0, 0.02};
            for (const int axis : {0, 2})
                for (int c = 0; c < scene.field.owned_cells(); ++c)
                    scene.field.velocity(axis)[c] += grain.stream_gain[axis];
            InteriorConstraint constraint(scene.field);
            constraint.place(scene.grains);
            constraint.solve(scene.field.all());
            const Twist motion = constraint.motion(0);
            // M dU = m_f a dt
            for (const int axis : {0, 2})
                EXPECT_NEAR(motion.velocity[axis] - grain.contact_motion.velocity[axis],
                            grain.stream_gain[axis] / density,
                            0.06 * grain.stream_gain[axis] / density)
                    << density << " at " << x;
            EXPECT_LT(norm(motion.spin) * 0.5, 0.05 * norm(grain.stream_gain)) << x;
            EXPECT_EQ(grain.beyond.mass > 0.0, x > 1.5);
        }
}

// cM dU = dt F + dt lambda, of which the fluid in the box has lost its part only.
TEST(InteriorConstraint, FluidBeyondASideHasAMomentumOfItsOwn) {
    Carried scene(2.2, 1.5);
    InteriorConstraint constraint(scene.field);
    constraint.place(scene.grains);
    const Vec3 before = scene.field.momentum();
    constraint.solve(scene.field.all());
    constraint.impose();
    const ImmersedGrain& grain = scene.grains[0];
    const Twist motion = constraint.motion(0);
    const Impulse beyond =
        grain.beyond.momentum(grain.fluid_before()) - grain.beyond.momentum(motion);
    const Vec3 change = motion.velocity - grain.contact_motion.velocity;
    const Vec3 impulse = constraint.impulse(0).linear + beyond.linear + grain.given_impulse.linear;
    EXPECT_LT(norm(grain.effective_mass * change - impulse), 1e-14);
    EXPECT_LT(norm(scene.field.momentum() - before + constraint.impulse(0).linear), 1e-13);
    EXPECT_GT(norm(beyond.linear), 1e-4);
}

}  // namespace
}  // namespace turbidite
