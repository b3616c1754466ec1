// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box in space: their cells keep fluid out, and spheres get what they leave.
#include "fluid_adapter/multiplier/space/wall_cells.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <queue>

#include "fluid_adapter/multiplier/space/interior_constraint.hpp"
#include "tests/unit/multiplier/space_field.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;

SpaceWall at_rest(SpaceWallKind kind, const Vec3& place, const Vec3& a) {
    SpaceWall wall;
    wall.kind = kind;
    wall.place = wall.pivot = place;
    wall.a = a;
    wall.motion = constant_motion({});
    return wall;
}

SpaceWall plate(const Vec3& corner, const Vec3& a, const Vec3& b) {
    SpaceWall wall = at_rest(SpaceWallKind::plate, corner, a);
    wall.b = b;
    return wall;
}

SpaceWall cone(const Vec3& from, const Vec3& axis, double first, double last) {
    SpaceWall wall = at_rest(SpaceWallKind::cone, from, axis);
    wall.radius = first;
    wall.radius2 = last;
    return wall;
}

/// Bodies of walls two cells thick, and what they refer to.
struct Walls {
    explicit Walls(const std::vector<SpaceWall>& walls, double time = 0.0) : shapes(walls.size()) {
        for (std::size_t w = 0; w < walls.size(); ++w) {
            const PlacedWall placed = place(walls[w], time, 0.01);
            shapes[w] = {placed.surface, edge};
            ImmersedGrain body;
            body.id = -7 - static_cast<GrainId>(w);
            body.wall = &shapes[w];
            body.prescribed = true;
            body.contact_motion = placed.twist;
            body.position = {placed.pivot[0], placed.pivot[1], placed.pivot[2]};
            bodies.push_back(body);
        }
    }
    Walls(const Walls&) = delete;  // bodies refer to shapes
    Walls& operator=(const Walls&) = delete;

    std::vector<WallBody> shapes;
    std::vector<ImmersedGrain> bodies;
};

/// How many cells can be reached through faces between free cells.
std::size_t reached(const SpaceField& field, std::vector<int> owner, const CellPlace& from) {
    const CellGrid& grid = field.grid();
    std::queue<CellPlace> next;
    std::size_t count = 0;
    const auto visit = [&](const CellPlace& at) {
        const CellPlace in{grid.wrapped(0, at.i), grid.wrapped(1, at.j), grid.wrapped(2, at.k)};
        const int cell = field.cell(in.i, in.j, in.k);
        if (cell < 0 || owner[cell] != -1) return;
        owner[cell] = 0;
        ++count;
        next.push(in);
    };
    for (visit(from); !next.empty(); next.pop())
        for (int axis = 0; axis < 3; ++axis)
            for (const int side : {-1, 1}) visit(next.front().beside(axis, side));
    return count;
}

/// Of a cylinder, two discs and a cone along a unit vector, 1.8 high.
std::vector<SpaceWall> closed_can(const Vec3& foot, const Vec3& up) {
    SpaceWall shell = at_rest(SpaceWallKind::cylinder, foot, 1.2 * up);
    shell.radius = 0.9;
    SpaceWall floor = at_rest(SpaceWallKind::ring, foot, up);
    floor.radius2 = 0.9;
    SpaceWall lid = at_rest(SpaceWallKind::ring, foot + 1.8 * up, up);
    lid.radius2 = 0.4;
    return {shell, floor, lid, cone(foot + 1.2 * up, 0.6 * up, 0.9, 0.4)};
}

/// A plate across a box in any direction, and a closed can of a cylinder, a cone and two discs:
/// what is on one side cannot be reached from the other.
TEST(WallCells, OfTwoCellsLetNoFluidThrough) {
    const SpaceField field({31, 30, 32}, Side::wall);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> turn(-1.0, 1.0);
    for (int trial = 0; trial < 20; ++trial) {
        const Rotation way = rotation(pi * Vec3{turn(random), turn(random), turn(random)});
        const Vec3 middle{1.55 + 0.1 * turn(random), 1.5 + 0.1 * turn(random), 1.6};
        const Vec3 a = way({8.0, 0.0, 0.0}), b = way({0.0, 8.0, 0.0});
        const Walls one({plate(middle - 0.5 * (a + b), a, b)});
        SphereCells cells(field.layers());
        cells.find(one.bodies);
        const std::vector<int> owner = found_owners(field, cells, 1);
        const auto free = static_cast<std::size_t>(std::count(owner.begin(), owner.end(), -1));
        const std::size_t first =
            static_cast<std::size_t>(std::find(owner.begin(), owner.end(), -1) - owner.begin());
        const int at = static_cast<int>(first);
        const std::size_t side = reached(field, owner, {at % 31, at / (31 * 32), at / 31 % 32});
        EXPECT_LT(side, free) << trial;
        EXPECT_GT(side, free / 5) << trial;

        const Vec3 up = way({0.0, 1.0, 0.0}), foot = middle - 1.0 * up;
        const Walls can(closed_can(foot, up));
        cells.find(can.bodies);
        const std::vector<int> owner_in_can = found_owners(field, cells, 4);
        const CellGrid& grid = field.grid();
        const std::size_t inside =
            reached(field, owner_in_can,
                    {grid.layer(0, middle[0]), grid.layer(1, middle[1]), grid.layer(2, middle[2])});
        // pi r^2 h of the faces inside, 0.8 D and 1.0 D, and of the cone's part
        EXPECT_GT(inside, 2000u) << trial;
        EXPECT_LT(inside, 3500u) << trial;
        EXPECT_TRUE(cells.find_wedges().sides().empty()) << "fluid leaks where walls at rest meet";
    }
}

/// Each of its walls has its own place for a pivot, on the axis: they are one body as long as they
/// turn alike.
TEST(WallCells, OfACanThatTurnsHaveNoFilmsAtItsJoints) {
    const SpaceField field({31, 30, 32}, Side::wall);
    const Rotation way = rotation(Vec3{0.4, -1.1, 0.7});
    const Vec3 up = way({0.0, 1.0, 0.0});
    std::vector<SpaceWall> walls = closed_can(Vec3{1.55, 1.5, 1.6} - 0.9 * up, up);
    const auto films = [&] {
        const Walls can(walls);
        SphereCells cells(field.layers());
        cells.find(can.bodies);
        return cells.find_wedges().sides().size();
    };
    for (SpaceWall& wall : walls) wall.motion = constant_motion({{0.1, 0.0, 0.2}, 3.0 * up});
    EXPECT_EQ(films(), 0u);
    walls[2].motion = constant_motion({{0.1, 0.0, 0.2}, 2.0 * up});
    EXPECT_GT(films(), 20u) << "the lid turns more slowly";
    walls[2].motion = constant_motion({{0.1, 0.0, 0.3}, 3.0 * up});
    EXPECT_GT(films(), 20u) << "the lid slides off";
}

/// Two layers of centres lie within two cells, wherever the plate is; three where they lie just on
/// its faces.
TEST(WallCells, OfAPlateAreItsThickness) {
    const SpaceField field({20, 20, 20}, Side::cyclic);
    for (const double at : {0.97, 1.0, 1.03, 1.05}) {
        const Walls walls({plate({0.0, at, 0.0}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0})});
        SphereCells cells(field.layers());
        cells.find(walls.bodies);
        std::size_t count = 0;
        for (const CellRun& run : cells.runs(0)) count += run.count;
        EXPECT_EQ(count, (at == 1.05 ? 3u : 2u) * 400u) << at;
    }
}

/// Across the sides of a cyclic box, on one rank and on two, and with arms from its pivot that run
/// on.
TEST(WallCells, AcrossCyclicSidesAreThoseElsewhere) {
    const std::array<int, 3> box{30, 32, 31};
    const SpaceField whole(box, Side::cyclic), low(box, Side::cyclic, 0, 13),
        high(box, Side::cyclic, 13, 19);
    const Walls here({cone({1.31, 1.12, 1.23}, {0.5, 0.6, 0.2}, 0.8, 0.3)}),
        there({cone({2.81, 2.72, 2.73}, {0.5, 0.6, 0.2}, 0.8, 0.3)});
    SphereCells all(whole.layers()), below(low.layers()), above(high.layers()),
        shifted(whole.layers());
    for (SphereCells* cells : {&all, &below, &above}) cells->find(here.bodies);
    shifted.find(there.bodies);
    const std::vector<int> owner = found_owners(whole, all, 1);
    std::vector<int> parts = found_owners(low, below, 1);
    const std::vector<int> upper = found_owners(high, above, 1);
    parts.insert(parts.end(), upper.begin(), upper.end());
    EXPECT_EQ(parts, owner);
    // By whole cells along x, y and z: 15, 16, 15
    const std::vector<int> moved = found_owners(whole, shifted, 1);
    for (int j = 0; j < box[1]; ++j)
        for (int k = 0; k < box[2]; ++k)
            for (int i = 0; i < box[0]; ++i)
                ASSERT_EQ(moved[whole.cell((i + 15) % 30, (j + 16) % 32, (k + 15) % 31)],
                          owner[whole.cell(i, j, k)]);
    for (const CellRun& run : shifted.runs(0)) EXPECT_LT(run.first.norm(), 1.3);
}

/// A drum that turns about its axis stays where it is to the last cell; one that turns about
/// another axis does not.
TEST(WallCells, OfADrumThatTurnsStay) {
    const SpaceField field({30, 30, 30}, Side::wall);
    const Vec3 axis{0.3, 0.4, 1.2};
    SpaceWall drum = at_rest(SpaceWallKind::cylinder, {1.3, 1.3, 0.9}, axis);
    drum.radius = 0.9;
    drum.pivot = drum.place + 0.25 * axis;
    const auto cells_at = [&](const Vec3& spin, double time) {
        drum.motion = constant_motion({{}, spin});
        const Walls walls({drum}, time);
        SphereCells cells(field.layers());
        cells.find(walls.bodies);
        return found_owners(field, cells, 1);
    };
    const std::vector<int> start = cells_at(2.0 * axis, 0.0);
    EXPECT_EQ(cells_at(2.0 * axis, 1.234), start);
    EXPECT_NE(cells_at({0.0, 0.0, 1.0}, 1.234), start);
}

/// A search again finds what is kept, and what has moved.
TEST(WallCells, FollowAWallThatMoves) {
    const SpaceField field({30, 30, 30}, Side::wall);
    SpaceWall gate = plate({0.52, 0.81, 0.63}, {1.0, 0.1, 0.0}, {0.0, 0.0, 1.0});
    gate.motion = constant_motion({{0.0, 1.0, 0.0}, {}});
    SphereCells kept(field.layers());
    for (const double time : {0.0, 0.0, 0.31, 0.95}) {
        const Walls walls({gate}, time);
        kept.find(walls.bodies);
        SphereCells anew(field.layers());
        anew.find(walls.bodies);
        EXPECT_EQ(found_owners(field, kept, 1), found_owners(field, anew, 1));
        double height = 0.0;
        for (const CellRun& run : kept.runs(0)) height += run.first.y() * run.count;
        EXPECT_GT(kept.runs(0).size(), 10u);
        EXPECT_NEAR(walls.bodies[0].position.y(), 0.81 + time, 1e-12);
    }
}

/// A sphere that lies on an inclined plate and in a pipe that cuts its surface: no cell has two
/// bodies, walls keep theirs, and a film fills the wedge between them, from both.
TEST(WallCells, SpheresGetWhatWallsLeave) {
    const SpaceField field({30, 30, 30}, Side::wall);
    SpaceWall pipe = at_rest(SpaceWallKind::cylinder, {0.0, 1.5, 1.5}, {3.0, 0.0, 0.0});
    pipe.radius = 0.3;
    const Walls walls({pipe});
    std::vector<ImmersedGrain> bodies = {sphere(1, {1.52, 1.5, 2.3})};
    bodies.push_back(walls.bodies[0]);
    SphereCells cells(field.layers()), wall_alone(field.layers());
    cells.find(bodies);
    wall_alone.find(walls.bodies);
    const std::vector<int> owner = found_owners(field, cells, 2),
                           alone = found_owners(field, wall_alone, 1);
    std::size_t of_sphere = 0;
    for (std::size_t c = 0; c < owner.size(); ++c) {
        of_sphere += owner[c] == 0;
        EXPECT_TRUE(alone[c] != 0 || owner[c] == 1) << c;
    }
    const double whole = pi / 6.0 / std::pow(edge, 3);
    EXPECT_LT(of_sphere, whole - 5.0) << "the pipe cuts it";
    EXPECT_GT(of_sphere, 0.9 * whole);
    std::size_t from_sphere = 0, from_wall = 0;
    for (const CellSide& side : cells.find_wedges().sides())
        (owner[side.cell] == 0 ? from_sphere : from_wall) += 1;
    EXPECT_GT(from_sphere, 20u);
    EXPECT_GT(from_wall, 20u);
}

/// Fluid in a wall has its velocity, and the wall takes what the fluid loses.
TEST(WallCells, MoveWithTheWall) {
    SpaceField field({30, 30, 30}, Side::wall);
    field.fill_randomly(4);
    SpaceWall paddle = plate({0.5, 1.0, 0.5}, {2.0, 0.0, 0.0}, {0.0, 0.0, 2.0});
    paddle.pivot = {1.0, 1.0, 1.0};
    paddle.motion = constant_motion({{0.1, -0.2, 0.3}, {0.0, 0.5, 2.0}});
    const Walls walls({paddle});
    InteriorConstraint constraint(field);
    constraint.place(walls.bodies);
    const Vec3 before = field.momentum();
    constraint.solve(field.all());
    constraint.impose();
    std::size_t count = 0;
    for (const CellRun& run : constraint.cells().runs(0))
        for (int c = 0; c < run.count; ++c, ++count) {
            const Vec3 arm{run.first.x() + c * edge, run.first.y(), run.first.z()};
            const Vec3 wanted = walls.bodies[0].contact_motion.at(arm);
            for (int axis = 0; axis < 3; ++axis)
                ASSERT_NEAR(field.velocity(axis)[run.cell + c], wanted[axis], 1e-12);
        }
    EXPECT_GT(count, 800u);
    const Vec3 lost = before - field.momentum();
    EXPECT_GT(norm(lost), 1e-3);
    EXPECT_LT(norm(constraint.impulse(0).linear - lost), 1e-12);
}

/// Owners of single cells between a plate and spheres, counted from the left, or from the right.
std::vector<int> beside_a_plate(unsigned seed, bool mirrored, int& shut_in) {
    const double middle = 1.5;
    const auto mirror = [&](double x) { return mirrored ? 2.0 * middle - x : x; };
    SpaceWall wall = plate({mirror(1.45), -0.5, -0.5}, {0.0, 4.0, 0.0}, {0.0, 0.0, 4.0});
    wall.motion = constant_motion({{0.0, 1.0, 0.0}, {}});
    const Walls walls({wall});
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(0.3, 2.7), size(0.4, 0.7);
    std::vector<ImmersedGrain> bodies;
    for (int id = 0; id < 14; ++id) {
        const double px = place(random), py = place(random), pz = place(random);
        bodies.push_back(sphere(id, {mirror(px), py, pz}, size(random)));
    }
    bodies.push_back(walls.bodies[0]);
    const SpaceField field({30, 30, 30}, Side::wall);
    SphereCells cells(field.layers());
    cells.find(bodies);
    shut_in = static_cast<int>(cells.shut_in());
    std::vector<int> owner(field.owned_cells(), -1);
    for (std::size_t g = 0; g < bodies.size(); ++g)
        for (const CellRun& run : cells.runs(g))
            for (int c = 0; c < run.count; ++c) {
                const int i = run.cell % 30 + c;
                owner[run.cell + c + (mirrored ? 29 - 2 * i : 0)] = static_cast<int>(g);
            }
    return owner;
}

/// Whichever side the wall is on.
TEST(WallCells, ACellThatIsShutInJoinsTheSphereBesideAWall) {
    int with_some = 0;
    for (unsigned seed = 1; seed <= 60; ++seed) {
        int here = 0, there = 0;
        const std::vector<int> as_it_is = beside_a_plate(seed, false, here);
        EXPECT_EQ(as_it_is, beside_a_plate(seed, true, there)) << seed;
        EXPECT_EQ(here, there);
        with_some += here > 0;
    }
    EXPECT_GT(with_some, 20);
}

/// A cell that is shut in by a wall moves as this image of it does, also farther than half a period
/// from the pivot.
TEST(WallCells, AShutInCellHasTheArmOfTheWallAroundIt) {
    const SpaceField field({30, 30, 30}, Side::cyclic);
    const double far = 2.25, middle = 1.45;  // of 3
    SpaceWall shell =
        at_rest(SpaceWallKind::cylinder, {2.45, middle - 0.12, middle}, {0.0, 0.24, 0.0});
    shell.radius = 0.12;
    SpaceWall floor = at_rest(SpaceWallKind::ring, shell.place, {0.0, 1.0, 0.0});
    floor.radius2 = 0.12;
    SpaceWall lid = floor;
    lid.place = shell.place + shell.a;
    std::vector<SpaceWall> can{shell, floor, lid};
    for (SpaceWall& wall : can) wall.pivot = {2.45 - far, middle, middle};
    const Walls walls(can);
    SphereCells cells(field.layers());
    cells.find(walls.bodies);
    ASSERT_EQ(cells.shut_in(), 1);
    const CellRun& joined = cells.runs(0).back();
    EXPECT_EQ(joined.cell, field.cell(24, 14, 14));
    EXPECT_NEAR(joined.first.x(), far, 1e-12);
    EXPECT_NEAR(joined.first.y(), 0.0, 1e-12);
}

}  // namespace
}  // namespace turbidite
