// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The multiplier method on cells of different sizes: what is exact on a uniform grid remains exact.
#include <gtest/gtest.h>

#include "fluid_adapter/multiplier/plane/uzawa_cg.hpp"
#include "tests/unit/multiplier/dense_reference.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {
namespace {

/// Edges from 0 to 4: cells grow by a twentieth from one to the next up to the middle, then shrink;
/// sizes in the ratio 1 : 2.5.
std::vector<double> graded_edges() {
    std::vector<double> sizes;
    for (int i = 0; i < 20; ++i) sizes.push_back(std::pow(1.05, i));
    sizes.insert(sizes.end(), sizes.rbegin(), sizes.rend());
    double sum = 0.0;
    for (const double size : sizes) sum += size;
    std::vector<double> edges = {0.0};
    for (const double size : sizes) edges.push_back(edges.back() + 4.0 * size / sum);
    edges.back() = 4.0;
    return edges;
}

std::vector<ImmersedGrain> two_discs() {
    return {disc(1, 1.47, 1.61, {0.1, -0.5, 0.7}), disc(2, 2.55, 2.03, {-0.2, 0.3, -0.4})};
}

class StretchedGrid : public testing::TestWithParam<Side> {
 protected:
    void place() { PointPlacement(PointRules{}).place(field, grains, points); }

    MemoryField field{graded_edges(), graded_edges(), GetParam()};
    std::vector<ImmersedGrain> grains = two_discs();
    CollocationPoints points;
};

TEST_P(StretchedGrid, FindsTheLayerOfEveryPlace) {
    const CellGrid& grid = field.grid();
    EXPECT_GT(grid.size(0, 20) / grid.size(0, 0), 2.0);
    for (int i = 0; i < grid.counts[0]; ++i) {
        EXPECT_EQ(grid.layer(0, grid.centre(0, i)), i);
        EXPECT_EQ(grid.layer_below(0, grid.centre(0, i) + 1e-9), i);
        EXPECT_EQ(grid.layer_below(0, grid.centre(0, i) - 1e-9), i - 1);
    }
    if (!grid.cyclic(0)) return;
    EXPECT_EQ(grid.layer(0, grid.centre(0, 3) - 4.0), 3 - grid.counts[0]);
    EXPECT_NEAR(grid.centre(0, 3 + grid.counts[0]), grid.centre(0, 3) + 4.0, 1e-14);
    EXPECT_NEAR(grid.size(0, -1), grid.size(0, grid.counts[0] - 1), 1e-14);
}

/// The volume of the covered cells is that of the disc, apart from cut cells.
TEST_P(StretchedGrid, CoversTheVolumeOfADisc) {
    PointRules interior_only;
    interior_only.boundary = false;
    PointPlacement(interior_only).place(field, grains, points);
    for (int g = 0; g < 2; ++g)
        EXPECT_NEAR(sum_cells(points, g)[0] * field.reference_mass(), 0.7854, 0.06);
}

TEST_P(StretchedGrid, InterpolatesALinearFieldExactly) {
    if (GetParam() == Side::cyclic) return;  // a linear field is not periodic
    place();
    const auto plane = [](double x, double y) {
        return Planar(0.3 + 1.7 * x - 0.6 * y, -1.1 * x + 0.4 * y - 2.0, 0.0);
    };
    field.fill(plane);
    ASSERT_GT(points.boundary_points(), 20);
    const std::vector<Planar> rest(2, Planar::Zero());
    std::vector<double> slip(2 * points.boundary_points());
    BoundaryOperator(points).apply(at_slots(field, points).data(), rest.data(), slip.data());
    for (int g = 0; g < 2; ++g)
        for (int p = points.boundary_begin[g]; p < points.boundary_begin[g + 1]; ++p) {
            const Planar u = plane(grains[g].position.x() + points.arm_x[p],
                                   grains[g].position.y() + points.arm_y[p]);
            EXPECT_NEAR(slip[2 * p], u.x(), 1e-13);
            EXPECT_NEAR(slip[2 * p + 1], u.y(), 1e-13);
        }
}

/// The weights of a stencil add up to one, so the force spread to the cells equals that of the
/// points.
TEST_P(StretchedGrid, GivesCellsTheForceOfThePoints) {
    place();
    std::vector<double> L(2 * points.boundary_points());
    double sum_x = 0.0, sum_y = 0.0;
    for (std::size_t i = 0; i < L.size(); ++i) {
        L[i] = std::sin(1.7 * static_cast<double>(i));
        (i % 2 == 0 ? sum_x : sum_y) += L[i];
    }
    std::vector<PlaneVector> f(points.slots());
    BoundaryOperator(points).spread(L.data(), f.data());
    for (const PlaneVector& at : f) sum_x -= at.x, sum_y -= at.y;
    EXPECT_NEAR(sum_x, 0.0, 1e-12);
    EXPECT_NEAR(sum_y, 0.0, 1e-12);
}

/// Grains and fluid exchange one impulse, whatever the sizes of the cells; and the answer equals
/// that of a dense solve.
TEST_P(StretchedGrid, KeepsMomentumAndAgreesWithADenseSolve) {
    place();
    field.fill_randomly(7);
    const std::vector<Planar> expected =
        DenseReference(field, grains, points).motions(std::vector<Planar>(2, Planar::Zero()));
    const Planar before = field.momentum();
    SaddleOperator system;
    ConstrainedFlow flow;
    MultiplierWorkspace work;
    MultiplierSettings settings;
    settings.tolerance = 1e-12;
    settings.reduction = 1.0;
    system.assemble(field, grains, points);
    flow.begin(system, {field.velocity(0), field.velocity(1)}, momenta_of(grains),
               prescribed_motions(grains));
    EXPECT_TRUE(uzawa_cg(flow, settings, work).converged);
    flow.impose();
    Planar change = field.momentum() - before;
    for (int g = 0; g < 2; ++g) {
        EXPECT_LT((flow.motions()[g] - expected[g]).norm(), 1e-8);
        const Planar gained = flow.motions()[g] - planar(grains[g].contact_motion);
        EXPECT_NEAR(grains[g].effective_mass * gained.x(), flow.impulses()[g].x(), 1e-12);
        EXPECT_NEAR(grains[g].effective_inertia * gained.z(), flow.impulses()[g].z(), 1e-12);
        change += grains[g].effective_mass * gained;
    }
    EXPECT_NEAR(change.x(), 0.0, 1e-12);
    EXPECT_NEAR(change.y(), 0.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(Sides, StretchedGrid, testing::Values(Side::wall, Side::cyclic),
                         [](const auto& info) {
                             return info.param == Side::wall ? "wall" : "cyclic";
                         });

/// Edges of equal cells give the result of a uniform grid.
TEST(StretchedGridOfEqualCells, IsTheUniformOne) {
    std::vector<double> edges;
    for (int i = 0; i <= 64; ++i) edges.push_back(i / 16.0);
    MemoryField stretched(edges, edges, Side::wall), uniform(64, 64, Side::wall);
    CollocationPoints one, other;
    PointPlacement(PointRules{}).place(stretched, two_discs(), one);
    PointPlacement(PointRules{}).place(uniform, two_discs(), other);
    EXPECT_EQ(one.slot, other.slot);
    EXPECT_EQ(one.stencil, other.stencil);
    ASSERT_EQ(one.weight.size(), other.weight.size());
    for (std::size_t s = 0; s < one.weight.size(); ++s)
        EXPECT_NEAR(one.weight[s], other.weight[s], 1e-12);
    ASSERT_EQ(one.interior.size(), other.interior.size());
    for (std::size_t i = 0; i < one.interior.size(); ++i)
        EXPECT_EQ(one.interior[i].cell, other.interior[i].cell);
}

}  // namespace
}  // namespace turbidite
