// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/collocation_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <set>

#include "fluid_adapter/multiplier/neighbours.hpp"
#include "fluid_adapter/multiplier/plane/boundary_operator.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {
namespace {

constexpr double h = 1.0 / 16.0;

CollocationPoints place(const MemoryField& field, const std::vector<ImmersedGrain>& grains,
                        bool boundary = true) {
    PointRules rules;
    rules.boundary = boundary;
    CollocationPoints points;
    PointPlacement(rules).place(field, grains, points);
    return points;
}

int boundary_points(const CollocationPoints& points, int g) {
    return points.boundary_begin[g + 1] - points.boundary_begin[g];
}

/// Chord of a full ring: 2 R sin(pi/n) >= 1.5 h with R = 8 h gives n = floor(pi / asin(1.5/16))
/// = 33.
constexpr int full_ring = 33;

TEST(CollocationPoints, AreaOfInteriorCellsIsThatOfTheDisc) {
    // pi (D/2)^2 / h^2 = 201.06 cells; a grid deviates by the cells that are cut, a few per cent at
    // most.
    MemoryField field(64, 64, Side::wall);
    const CollocationPoints points = place(field, {disc(1, 2.013, 2.007)}, false);
    EXPECT_NEAR(points.size(), 201.06, 4.0);
}

TEST(CollocationPoints, BoundaryStencilsAreNoInteriorPoints) {
    MemoryField field(64, 64, Side::wall);
    const CollocationPoints points = place(field, {disc(1, 2.013, 2.007)});
    ASSERT_EQ(boundary_points(points, 0), full_ring);
    std::set<int> stencilled, by_slot;
    for (std::size_t s = 0; s < points.slot.size(); ++s)
        stencilled.insert(points.cell(static_cast<int>(s)));
    for (const StencilCell& at : points.stencilled) by_slot.insert(at.cell);
    EXPECT_EQ(stencilled, by_slot);
    EXPECT_EQ(stencilled.size(), points.stencilled.size());
    ASSERT_GT(points.interior.size(), 100u);
    for (const InteriorCell& point : points.interior) EXPECT_EQ(stencilled.count(point.cell), 0u);
}

TEST(CollocationPoints, AGrainAcrossACyclicSideHasAllItsPoints) {
    MemoryField field(64, 64, Side::cyclic);
    const CollocationPoints middle = place(field, {disc(1, 2.01, 2.02)});
    // 2.01 - 2 D: the same position relative to the grid, shifted by 32 whole cells.
    const CollocationPoints across = place(field, {disc(1, 0.01, 0.02)});
    EXPECT_EQ(across.size(), middle.size());
    EXPECT_EQ(boundary_points(across, 0), full_ring);
    for (int p = 0; p < full_ring; ++p) {
        EXPECT_NEAR(across.arm_x[p], middle.arm_x[p], 1e-12);
        EXPECT_NEAR(across.arm_y[p], middle.arm_y[p], 1e-12);
    }
    for (std::size_t i = 0; i < across.interior.size(); ++i) {
        EXPECT_NEAR(across.interior[i].arm_x, middle.interior[i].arm_x, 1e-12);
        EXPECT_NEAR(across.interior[i].arm_y, middle.interior[i].arm_y, 1e-12);
    }
}

/// A point interpolates from cells further out than itself, also when the grain has turned.
TEST(CollocationPoints, StencilsReachOutwardsHoweverTheGrainHasTurned) {
    MemoryField field(64, 64, Side::wall);
    for (const double angle : {0.0, 1.0, 1.7, 3.1, 4.5}) {
        ImmersedGrain grain = disc(1, 2.013, 2.007);
        grain.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
        const CollocationPoints points = place(field, {grain});
        ASSERT_EQ(boundary_points(points, 0), full_ring);
        for (int p = 0; p < full_ring; ++p) {
            const StencilBox& box = points.box[p];
            const double out_x = h * (0.5 * (box.low_x + box.high_x) + 0.5) - 2.013,
                         out_y = h * (0.5 * (box.low_y + box.high_y) + 0.5) - 2.007;
            EXPECT_GE(std::abs(out_x), std::abs(points.arm_x[p]) - 1e-9) << angle;
            EXPECT_GE(std::abs(out_y), std::abs(points.arm_y[p]) - 1e-9) << angle;
        }
    }
}

/// A plate of 3.9 D below a disc, in a period of 4 D: the same points are dropped wherever the disc
/// is, also where the two ends of the plate are below it.
TEST(CollocationPoints, PointsNearAnyImageOfAWallAreDropped) {
    MemoryField field(64, 64, Side::cyclic);
    const double radius = std::hypot(1.95, 0.0625), a = 1.95 / radius, b = 0.0625 / radius;
    const auto outline = make_shape({"polygon", {a, -b, a, b, -a, b, -a, -b}});
    ImmersedGrain plate;
    plate.id = -5;
    plate.shape = outline.get();
    plate.radius = radius;
    plate.position = {2.0, 1.0, 0.0};
    plate.has_boundary_points = false;
    const int expected = place(field, {disc(1, 2.0, 1.6), plate}).dropped.near_wall;
    EXPECT_GT(expected, 3);
    for (const double x : {0.0, 3.5, 3.75})
        EXPECT_EQ(place(field, {disc(1, x, 1.6), plate}).dropped.near_wall, expected) << x;
}

TEST(CollocationPoints, PointsNearAWallAreDropped) {
    MemoryField field(64, 64, Side::wall);
    // The disc touches the floor: points with 8 h + 8 h sin(angle) < 2 h are dropped, that is
    // sin(angle) < -0.75, a fraction (pi - 2 asin(0.75)) / 2 pi = 0.230 of the ring, or 7.6 points.
    const CollocationPoints points = place(field, {disc(1, 2.0, 0.5)});
    EXPECT_NEAR(points.dropped.near_wall, 0.230 * full_ring, 1.0);
    EXPECT_EQ(boundary_points(points, 0), full_ring - points.dropped.near_wall);
}

TEST(CollocationPoints, TouchingGrainsLoseTheSamePointsWhateverTheirOrder) {
    MemoryField field(64, 64, Side::wall);
    const ImmersedGrain a = disc(1, 1.5, 2.0), b = disc(2, 2.5, 2.0);
    const CollocationPoints ab = place(field, {a, b});
    const CollocationPoints ba = place(field, {b, a});
    EXPECT_GT(ab.dropped.near_point, 4);
    EXPECT_EQ(boundary_points(ab, 0), boundary_points(ba, 1));
    EXPECT_EQ(boundary_points(ab, 1), boundary_points(ba, 0));
    EXPECT_EQ(ab.interior_begin[1], ba.interior_begin[2] - ba.interior_begin[1]);
}

// Across a period of two diameters two discs touch on both sides: as many points are dropped there
// as in the middle of a row of discs.
TEST(CollocationPoints, EveryImageCounts) {
    MemoryField wide(96, 64, Side::cyclic), narrow(32, 64, Side::cyclic),
        single(17, 64, Side::cyclic);
    const int at_one_contact =
        place(wide, {disc(1, 2.0, 2.0), disc(2, 3.0, 2.0)}).dropped.near_point;
    ASSERT_GT(at_one_contact, 4);
    const CollocationPoints two = place(narrow, {disc(1, 0.5, 2.0), disc(2, 1.5, 2.0)});
    EXPECT_EQ(two.dropped.near_point, 2 * at_one_contact);
    EXPECT_EQ(boundary_points(two, 0), boundary_points(two, 1));
    // A disc that has a gap of a cell to its own image, and two with the same gap.
    const int of_itself = place(single, {disc(1, 0.5, 2.0)}).dropped.near_point;
    EXPECT_GT(of_itself, 2);
    MemoryField pair(34, 64, Side::cyclic);
    const double period = 17 * h;
    EXPECT_EQ(place(pair, {disc(1, 0.5, 2.0), disc(2, 0.5 + period, 2.0)}).dropped.near_point,
              2 * of_itself);
}

TEST(CollocationPoints, SurvivorsOfDifferentGrainsKeepTheirDistance) {
    MemoryField field(64, 64, Side::wall);
    const std::vector<ImmersedGrain> grains = {disc(1, 1.5, 2.0), disc(2, 2.45, 2.0)};  // overlap
    const CollocationPoints points = place(field, grains);
    EXPECT_GT(points.dropped.inside_grain, 0);
    for (int p = points.boundary_begin[0]; p < points.boundary_begin[1]; ++p)
        for (int q = points.boundary_begin[1]; q < points.boundary_begin[2]; ++q) {
            const double dx = 1.5 + points.arm_x[p] - 2.45 - points.arm_x[q];
            const double dy = points.arm_y[p] - points.arm_y[q];
            EXPECT_GE(std::hypot(dx, dy), 1.5 * h);
        }
}

TEST(CollocationPoints, EveryCellHasOneOwner) {
    MemoryField field(64, 64, Side::wall);
    const CollocationPoints points =
        place(field, {disc(1, 1.5, 2.0), disc(2, 2.4, 2.0), disc(3, 1.95, 2.7)}, false);
    std::set<int> once;
    for (const InteriorCell& point : points.interior) once.insert(point.cell);
    EXPECT_GT(once.size(), 400u);
    EXPECT_EQ(once.size(), points.interior.size());
}

TEST(CollocationPoints, AGrainLeavingThroughAFreeSideKeepsWhatIsInside) {
    MemoryField field(64, 64, Side::open);
    const CollocationPoints points = place(field, {disc(1, 0.0, 2.0)});  // half out
    EXPECT_GT(points.dropped.off_grid, 10);
    EXPECT_NEAR(points.interior.size(), 201 / 2 - 30, 30);
    for (const InteriorCell& point : points.interior) EXPECT_GT(point.arm_x, 0.0);
    for (const double x : points.arm_x) EXPECT_GT(x, -h);
}

TEST(CollocationPoints, ReusedMemoryGivesTheSamePoints) {
    MemoryField field(64, 64, Side::wall);
    PointPlacement placement(PointRules{});
    CollocationPoints points;
    placement.place(field, {disc(1, 1.0, 1.0), disc(2, 2.5, 2.5)}, points);
    placement.place(field, {disc(1, 2.013, 2.007)}, points);
    const CollocationPoints fresh = place(field, {disc(1, 2.013, 2.007)});
    EXPECT_EQ(points.slot, fresh.slot);
    EXPECT_EQ(points.weight, fresh.weight);
    ASSERT_EQ(points.slots(), fresh.slots());
    for (int slot = 0; slot < fresh.slots(); ++slot)
        EXPECT_EQ(points.stencilled[slot].cell, fresh.stencilled[slot].cell);
    EXPECT_EQ(points.interior.size(), fresh.interior.size());
}

/// Largest error of the interpolation of sin(k x) cos(k y) at the boundary points.
double interpolation_error(double cell) {
    const int n = static_cast<int>(std::lround(4.0 / cell));
    MemoryField field(n, n, Side::wall, cell);
    const auto wave = [](double x, double y) {
        return Planar(std::sin(1.7 * x) * std::cos(1.3 * y), 0.0, 0.0);
    };
    field.fill(wave);
    const CollocationPoints points = place(field, {disc(1, 2.013, 2.007)});
    std::vector<double> slip(2 * points.boundary_points());
    const Planar rest = Planar::Zero();
    BoundaryOperator(points).apply(at_slots(field, points).data(), &rest, slip.data());
    double error = 0.0;
    for (int p = 0; p < points.boundary_points(); ++p)
        error = std::max(
            error,
            std::abs(slip[2 * p] - wave(2.013 + points.arm_x[p], 2.007 + points.arm_y[p]).x()));
    return error;
}

TEST(CollocationPoints, BoundaryInterpolationIsOfThirdOrder) {
    // Quadratic: error ~ h^3, so a factor 8 per halving of h.
    const double coarse = interpolation_error(1.0 / 16.0), fine = interpolation_error(1.0 / 32.0);
    EXPECT_GT(coarse / fine, 6.0);
    EXPECT_LT(coarse / fine, 11.0);
}

ImmersedGrain plate(GrainId id, double x, double y, double half_length, double angle) {
    static std::vector<std::shared_ptr<const Shape>> kept;
    ImmersedGrain body = disc(id, x, y);
    body.radius = std::hypot(half_length, h);
    const double u = half_length / body.radius, v = h / body.radius;
    kept.push_back(make_shape({"polygon", {-u, -v, u, -v, u, v, -u, v}}));
    body.shape = kept.back().get();
    body.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    body.has_boundary_points = false;
    return body;
}

// Wherever it lies, no two cells on different sides of a plate of two cells share a face.
TEST(CollocationPoints, APlateHasNoGaps) {
    MemoryField field(64, 64, Side::wall);
    for (const double angle : {0.0, 0.1, 0.4, 0.7854, 1.2, 1.5708}) {
        const auto body = plate(1, 2.013, 2.007, 4.0, angle);
        std::vector<int> side(64 * 64);
        for (int cell = 0; cell < 64 * 64; ++cell) {
            const double x = (cell % 64 + 0.5) * h - 2.013, y = (cell / 64 + 0.5) * h - 2.007;
            side[cell] = std::cos(angle) * y > std::sin(angle) * x ? 1 : -1;
        }
        const CollocationPoints points = place(field, {body});
        EXPECT_EQ(points.boundary_points(), 0);
        ASSERT_GT(points.interior.size(), 100u);
        for (const InteriorCell& point : points.interior) side[point.cell] = 0;
        for (int cell = 0; cell < 64 * 63; ++cell) {
            EXPECT_NE(side[cell] * side[cell + 64], -1) << angle << " above cell " << cell;
            if (cell % 64 < 63) {
                EXPECT_NE(side[cell] * side[cell + 1], -1) << angle << " beside cell " << cell;
            }
        }
    }
}

// Beside a plate a grain has no points within two cells, as beside a wall, and leaves it its cells.
TEST(CollocationPoints, AGrainBesideAPlateIsAsBesideAWall) {
    MemoryField field(64, 64, Side::wall);
    const double top = 1.0 + h;  // on a face of cells
    const auto wall = plate(2, 2.0, 1.0, 1.5, 0.0);
    const auto body = disc(1, 2.013, top + 0.55);
    const CollocationPoints alone = place(field, {wall});
    const CollocationPoints both = place(field, {body, wall});
    ASSERT_LT(boundary_points(both, 0), full_ring);
    for (int p = 0; p < boundary_points(both, 0); ++p)
        EXPECT_GT(body.position.y() + both.arm_y[p] - top, 2.0 * h);
    EXPECT_EQ(both.interior_begin[2] - both.interior_begin[1], alone.interior_begin[1]);
}

/// Edges of 64 rows: `equal` of height h, the others each 1.1 times as high as the one below.
std::vector<double> rows_that_grow(int equal) {
    std::vector<double> edges = {0.0};
    for (double height = h; edges.size() <= 64; edges.push_back(edges.back() + height))
        if (static_cast<int>(edges.size()) > equal) height *= 1.1;
    return edges;
}

// A long plate has high rows within its length of its middle, not at the disc.
TEST(CollocationPoints, RowsFarFromAGrainDropNoneOfItsPoints) {
    const std::vector<ImmersedGrain> bodies = {disc(1, 3.013, 1.0 + h + 0.55),
                                               plate(2, 3.0, 1.0, 3.0, 0.0)};
    const MemoryField equal(96, rows_that_grow(64), Side::wall, h),
        stretched(96, rows_that_grow(40), Side::wall, h);
    const CollocationPoints expected = place(equal, bodies), found = place(stretched, bodies);
    EXPECT_GT(expected.dropped.near_wall, 0);
    EXPECT_EQ(found.dropped.near_wall, expected.dropped.near_wall);
    EXPECT_EQ(boundary_points(found, 0), boundary_points(expected, 0));
}

// Where rows begin to grow a stencil reaches more than two of the cells at its point.
TEST(CollocationPoints, APlateInHigherRowsKeepsItsCells) {
    const MemoryField field(96, rows_that_grow(24), Side::wall, h);
    for (int k = 0; k < 400; ++k) {
        const double y = 2.0 + 0.01 * (k % 20);
        const ImmersedGrain wall = plate(2, 3.0, y, 2.5, 0.0),
                            below = disc(1, 3.013, y - 0.8 + 0.0005 * k);
        const CollocationPoints alone = place(field, {wall}), both = place(field, {below, wall});
        EXPECT_GT(boundary_points(both, 0), 10);
        EXPECT_EQ(both.interior_begin[2] - both.interior_begin[1], alone.interior_begin[1]) << k;
    }
}

// Long bodies are near many; every pair is found once.
TEST(Neighbours, OfBodiesOfAllSizes) {
    MemoryField field(96, 96, Side::cyclic);
    std::vector<ImmersedGrain> bodies;
    for (int k = 0; k < 60; ++k) {
        bodies.push_back(disc(k, 0.37 * k - 6.0 * (k / 16), 0.4 + 0.5 * (k % 11)));
        bodies.back().radius = 0.1 + 0.002 * k;
        if (k % 20 == 7) bodies.back().radius = 2.2;
    }
    std::set<std::pair<int, int>> expected;
    for (int b = 0; b < 60; ++b)
        for (int a = 0; a < b; ++a)
            if (field.grid().nearest_image(bodies[a].position - bodies[b].position).norm() <
                bodies[a].radius + bodies[b].radius + 0.05)
                expected.emplace(a, b);
    const auto found = near_pairs(field.grid(), bodies, 0.05);
    EXPECT_EQ(found.size(), expected.size());
    EXPECT_EQ((std::set<std::pair<int, int>>(found.begin(), found.end())), expected);
    EXPECT_GT(expected.size(), 60u);
}

TEST(CollocationPoints, RefusesThreeDimensions) {
    class Deep final : public FluidField {
     public:
        Deep() { grid_.dimension = 3; }
        const CellGrid& grid() const override { return grid_; }
        const CellTable& cells() const override { return none_; }
        int local_cells() const override { return 0; }
        int owned_cells() const override { return 0; }
        double reference_mass() const override { return 1.0; }
        double* velocity(int) override { return nullptr; }

     private:
        CellGrid grid_;
        CellTable none_;
    } field;
    CollocationPoints points;
    EXPECT_THROW(PointPlacement(PointRules{}).place(field, {}, points), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite
