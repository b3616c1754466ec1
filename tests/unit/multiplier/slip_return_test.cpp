// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres that cross cells: which ones, and what the fluid gets back for it.
#include "fluid_adapter/multiplier/space/slip_return.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "fluid_adapter/multiplier/space/interior_constraint.hpp"
#include "tests/unit/multiplier/space_field.hpp"

namespace turbidite {
namespace {

constexpr std::array<int, 3> box{30, 32, 31};

/// Two that touch, of which one moves across a corner of the cyclic box, and one at rest.
std::vector<ImmersedGrain> moving() {
    std::vector<ImmersedGrain> grains{sphere(1, {1.02, 1.03, 1.01}), sphere(2, {1.98, 1.06, 1.05}),
                                      sphere(3, {0.03, 3.13, 3.07}), sphere(4, {1.5, 2.2, 2.4})};
    const double moves[][3] = {
        {0.031, -0.042, 0.017}, {-0.045, 0.023, 0.038}, {0.047, 0.044, -0.041}, {0.0, 0.0, 0.0}};
    for (std::size_t g = 0; g < grains.size(); ++g) {
        grains[g].moved = {moves[g][0], moves[g][1], moves[g][2]};
        grains[g].motion_before = {{0.2, 0.1 * static_cast<double>(g), -0.3}, {0.1, 0.5, -0.2}};
    }
    return grains;
}

using Crossings = std::map<std::tuple<int, int, int, int>, bool>;  // (grain, i, j, k): covered

Crossings by_definition(const SpaceField& field, const CellOwners& owners,
                        const std::vector<ImmersedGrain>& grains) {
    Crossings all;
    const CellGrid& grid = field.grid();
    for (int j = 0; j < grid.counts[1]; ++j)
        for (int k = 0; k < grid.counts[2]; ++k)
            for (int i = 0; i < grid.counts[0]; ++i)
                for (int g = 0; g < static_cast<int>(grains.size()); ++g) {
                    const ImmersedGrain& own = grains[g];
                    const Eigen::Vector3d arm = grid.nearest_image(
                        Eigen::Vector3d(grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)) -
                        own.position);
                    const bool now = arm.norm() < own.radius,
                               before = (arm + own.moved).norm() < own.radius;
                    if (now != before && owners[{i, j, k}] == (now ? g : CellOwners::none))
                        all[{g, i, j, k}] = now;
                }
    return all;
}

Crossings found(CrossedCells& crossed, const std::vector<ImmersedGrain>& grains) {
    Crossings all;
    for (const CrossedCell& cell : crossed.find(grains)) {
        const auto key = std::make_tuple(cell.grain, cell.at.i, cell.at.j, cell.at.k);
        EXPECT_EQ(all.count(key), 0u);
        all[key] = cell.covered;
    }
    return all;
}

TEST(CrossedCells, AreThoseWhoseCentresTheSurfaceHasPassed) {
    const SpaceField field(box, Side::cyclic);
    const std::vector<ImmersedGrain> grains = moving();
    SphereCells cells(field.layers());
    cells.find(grains);
    CrossedCells crossed(field.layers(), cells.owners());
    const Crossings wanted = by_definition(field, cells.owners(), grains);
    EXPECT_EQ(found(crossed, grains), wanted);
    int covered = 0;
    for (const auto& [key, now] : wanted) covered += now;
    EXPECT_GT(covered, 80);
    EXPECT_GT(wanted.size() - covered, 80u);
}

TEST(CrossedCells, OfASphereThatMeetsItselfThereAreNone) {
    const SpaceField field({9, 32, 9}, Side::cyclic);
    std::vector<ImmersedGrain> grains{sphere(1, {0.4, 1.5, 0.4})};
    grains[0].moved = {0.05, 0.05, 0.05};
    SphereCells cells(field.layers());
    cells.find(grains);
    CrossedCells crossed(field.layers(), cells.owners());
    EXPECT_TRUE(crossed.find(grains).empty());
}

TEST(CrossedCells, OfALengthWhoseSquareIsZeroThereAreNone) {
    SpaceField field(box, Side::cyclic);
    std::vector<ImmersedGrain> grains{sphere(1, {1.53, 1.54, 1.56})};
    SphereCells cells(field.layers());
    cells.find(grains);
    CrossedCells crossed(field.layers(), cells.owners());
    grains[0].moved = {1e-170, 0.0, 0.0};
    crossed.find(grains);
    EXPECT_TRUE(crossed.crossing().empty());
    grains[0].moved = {1e-150, 0.0, 0.0};
    crossed.find(grains);
    EXPECT_EQ(crossed.crossing().size(), 1u);
}

/// A part of the layers, which knows those of the other part beside its own. What is to be summed
/// over the parts is noted at first; with the sums of all in `total` it is they that are returned.
class PartOfField final : public SpaceField {
 public:
    PartOfField(const SpaceField& whole, int first, int count)
        : SpaceField(box, Side::cyclic, first, count), whole_(&whole) {
        for (int axis = 0; axis < 3; ++axis)
            std::copy_n(of_whole(axis, first), owned_cells(), velocity(axis));
    }

    void import_layers(const VelocityPointers&, LayersBeside& beside) const override {
        const int layer = box[0] * box[2], first = first_layer();
        const int after = first + owned_cells() / layer;
        for (int axis = 0; axis < 3; ++axis) {
            const double* below = of_whole(axis, (first + box[1] - 1) % box[1]);
            const double* above = of_whole(axis, after % box[1]);
            beside.below[axis].assign(below, below + layer);
            beside.above[axis].assign(above, above + layer);
        }
    }

    void sum_over_holders(double* rows, int per_grain) const override {
        const int count = 4 * per_grain;  // of moving()
        noted.assign(rows, rows + count);
        if (!total.empty()) std::copy_n(total.begin(), count, rows);
    }

    mutable std::vector<double> noted;
    std::vector<double> total;

 private:
    const double* of_whole(int axis, int layer) const {
        return const_cast<SpaceField*>(whole_)->velocity(axis) + layer * box[0] * box[2];
    }

    const SpaceField* whole_;
};

std::vector<Eigen::Vector3d> play(SpaceField& field, const std::vector<ImmersedGrain>& grains) {
    SphereCells cells(field.layers());
    cells.find(grains);
    return SlipReturn(field, cells.owners()).play(grains, field.all());
}

/// About the origin of the box [kg m2/s], in the images of cells nearest to `at`.
Eigen::Vector3d moment_about(SpaceField& field, const Eigen::Vector3d& at) {
    const CellGrid& grid = field.grid();
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int j = 0; j < box[1]; ++j)
        for (int k = 0; k < box[2]; ++k)
            for (int i = 0; i < box[0]; ++i) {
                const int c = field.cell(i, j, k);
                const Eigen::Vector3d arm = grid.nearest_image(
                    Eigen::Vector3d(grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)) - at);
                sum += field.reference_mass() *
                       arm.cross(Eigen::Vector3d(field.velocity(0)[c], field.velocity(1)[c],
                                                 field.velocity(2)[c]));
            }
    return sum;
}

/// The fluid's momentum stays, in cells that are free, and what it gains in moment the sphere
/// gives, but for cells that it leaves, whose moment is counted where the sphere has got it.
TEST(SlipReturn, GivesTheMomentAlone) {
    SpaceField field(box, Side::cyclic);
    field.fill_randomly(3);
    SpaceField before = field;
    const std::vector<ImmersedGrain> grains = moving();
    const std::vector<Eigen::Vector3d> given = play(field, grains);
    EXPECT_LT(norm(field.momentum() - before.momentum()), 1e-14);
    EXPECT_GT(given[0].norm(), 1e-4);
    EXPECT_EQ(given[3], Eigen::Vector3d::Zero()) << "it does not move";
    SphereCells cells(field.layers());
    cells.find(grains);
    int changed = 0;
    for (int j = 0; j < box[1]; ++j)
        for (int k = 0; k < box[2]; ++k)
            for (int i = 0; i < box[0]; ++i) {
                const int c = field.cell(i, j, k);
                if (field.velocity(0)[c] == before.velocity(0)[c]) continue;
                ++changed;
                EXPECT_EQ((cells.owners()[{i, j, k}]), CellOwners::none);
            }
    EXPECT_GT(changed, 300);
}

TEST(SlipReturn, KeepsTheMomentOfWhatIsCovered) {
    SpaceField field(box, Side::cyclic);
    field.fill_randomly(8);
    // By more than it can in a window
    std::vector<ImmersedGrain> grains{sphere(1, {1.53, 1.54, 1.56})};
    grains[0].moved = {0.75, 0.0, 0.0};
    SphereCells cells(field.layers());
    cells.find(grains);
    // In what it has left there is no slip to be returned.
    for (int c = 0; c < field.owned_cells(); ++c)
        if (c % box[0] < 14)
            for (int axis = 0; axis < 3; ++axis) field.velocity(axis)[c] = 0.0;
    SpaceField before = field;
    const Eigen::Vector3d given = play(field, grains)[0];
    const Eigen::Vector3d gained =
        moment_about(field, grains[0].position) - moment_about(before, grains[0].position);
    EXPECT_GT(given.norm(), 1e-4);
    EXPECT_LT((gained - given).norm(), 1e-12);
}

/// By hand: a sphere that has moved by a cell along x, in fluid that slips along y ahead of it and
/// half as fast behind.
TEST(SlipReturn, IsHalfTheSlipAheadAndBehind) {
    SpaceField field(box, Side::cyclic);
    const auto slip = [](int i) { return i > 15 ? 2.0 : 1.0; };
    for (int c = 0; c < field.owned_cells(); ++c) field.velocity(1)[c] = 0.5 + slip(c % box[0]);
    std::vector<ImmersedGrain> grains{sphere(1, {1.55, 1.55, 1.55}, 0.48)};
    grains[0].moved = {edge, 0.0, 0.0};
    grains[0].motion_before = {{0.0, 0.5, 0.0}, {}};
    const Eigen::Vector3d given = play(field, grains)[0];
    // Centres of the middle row are 0, 0.1, ... from the sphere's: it has the cells 11 to 19 of x,
    // and had 10 to 18. In the mean over both ends the fluid gains nothing.
    const double ahead = field.velocity(1)[field.cell(20, 15, 15)] - 2.5,
                 behind = field.velocity(1)[field.cell(10, 15, 15)] - 1.5;
    EXPECT_NEAR(ahead - behind, 0.5 * (2.0 - 1.0), 0.02);
    EXPECT_GT(ahead, 0.1);
    EXPECT_LT(behind, -0.1);
    EXPECT_DOUBLE_EQ(field.velocity(1)[field.cell(22, 15, 15)], 2.5);
    EXPECT_DOUBLE_EQ(field.velocity(1)[field.cell(8, 15, 15)], 1.5);
    EXPECT_GT(given.z(), 20 * 0.45 * 0.5 * edge * edge * edge);
    EXPECT_LT(std::abs(given.x()) + std::abs(given.y()), 1e-12);
}

/// Of two cells behind a sphere that has moved by two, the inner one has nothing free beside it.
TEST(SlipReturn, IsOfFluidThatWasOutside) {
    SpaceField field(box, Side::cyclic);
    for (int c = 0; c < field.owned_cells(); ++c) field.velocity(1)[c] = 1.0;
    std::vector<ImmersedGrain> grains{sphere(1, {1.55, 1.55, 1.55}, 0.48)};
    grains[0].moved = {2.0 * edge, 0.0, 0.0};
    play(field, grains);
    EXPECT_DOUBLE_EQ(field.velocity(1)[field.cell(9, 15, 15)], 1.5);
    // What the shell loses, as ahead of it, where the cell that was covered adds its half
    EXPECT_NEAR(field.velocity(1)[field.cell(10, 15, 15)],
                field.velocity(1)[field.cell(20, 15, 15)] - 0.5, 1e-12);
}

TEST(SlipReturn, OfFluidThatMovesWithTheSphereIsNothing) {
    SpaceField field(box, Side::cyclic);
    std::vector<ImmersedGrain> grains{sphere(1, {1.53, 1.54, 1.56})};
    grains[0].moved = {0.05, -0.04, 0.03};
    grains[0].motion_before = {{1.0, 0.5, 0.2}, {0.3, 0.2, -0.4}};
    grains[0].stream_gain = {0.01, 0.02, -0.03};
    for (int j = 0; j < box[1]; ++j)
        for (int k = 0; k < box[2]; ++k)
            for (int i = 0; i < box[0]; ++i) {
                const CellGrid& grid = field.grid();
                const Eigen::Vector3d arm =
                    Eigen::Vector3d(grid.centre(0, i), grid.centre(1, j), grid.centre(2, k)) -
                    grains[0].position;
                const Vec3 u = grains[0].motion_before.at({arm.x(), arm.y(), arm.z()});
                for (int axis = 0; axis < 3; ++axis)
                    field.velocity(axis)[field.cell(i, j, k)] =
                        u[axis] + grains[0].stream_gain[axis];
            }
    SpaceField before = field;
    EXPECT_LT(play(field, grains)[0].norm(), 1e-15);
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < field.owned_cells(); ++c)
            ASSERT_NEAR(field.velocity(axis)[c], before.velocity(axis)[c], 1e-14);
}

/// Free cells beside two spheres get something from both.
TEST(SlipReturn, IsTheSameInWhateverOrderGrainsAreSent) {
    SpaceField field(box, Side::cyclic);
    field.fill_randomly(5);
    SpaceField turned = field;
    const std::vector<ImmersedGrain> grains = moving();
    const std::vector<ImmersedGrain> backwards(grains.rbegin(), grains.rend());
    const std::vector<Eigen::Vector3d> given = play(field, grains);
    std::vector<Eigen::Vector3d> given_backwards = play(turned, backwards);
    std::reverse(given_backwards.begin(), given_backwards.end());
    EXPECT_EQ(given, given_backwards);
    EXPECT_GT(given[0].norm(), 1e-4);
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < field.owned_cells(); ++c)
            ASSERT_EQ(field.velocity(axis)[c], turned.velocity(axis)[c]);
}

TEST(SlipReturn, IsTheSameOnRanksOfLayers) {
    SpaceField whole(box, Side::cyclic);
    whole.fill_randomly(4);
    const std::vector<ImmersedGrain> grains = moving();
    const PartOfField low(whole, 0, 11), high(whole, 11, 21);  // through three that move
    PartOfField first = low, second = high;
    play(first, grains), play(second, grains);
    std::vector<double> total = first.noted;
    for (std::size_t n = 0; n < total.size(); ++n) total[n] += second.noted[n];
    EXPECT_GT(std::abs(second.noted[0]), 1e-6);
    first = low, second = high;
    first.total = second.total = total;
    const std::vector<Eigen::Vector3d> of_first = play(first, grains),
                                       of_second = play(second, grains), all = play(whole, grains);
    EXPECT_EQ(of_first, of_second);
    for (std::size_t g = 0; g < grains.size(); ++g) EXPECT_LT((of_first[g] - all[g]).norm(), 1e-15);
    EXPECT_GT(all[0].norm(), 1e-4);
    for (int axis = 0; axis < 3; ++axis)
        for (int c = 0; c < whole.owned_cells(); ++c) {
            const int of_low = first.owned_cells();
            const double part =
                c < of_low ? first.velocity(axis)[c] : second.velocity(axis)[c - of_low];
            ASSERT_NEAR(part, whole.velocity(axis)[c], 1e-15);
        }
}

/// Grains and fluid keep their momentum, as without.
TEST(InteriorConstraint, KeepsMomentumWhereSpheresCrossCells) {
    SpaceField field(box, Side::cyclic);
    field.fill_randomly(3);
    const std::vector<ImmersedGrain> grains = moving();
    const Vec3 before = field.momentum();
    InteriorConstraint constraint(field);
    constraint.place(grains);
    constraint.solve(field.all());
    constraint.impose();
    Vec3 to_grains{};
    for (std::size_t g = 0; g < grains.size(); ++g) {
        const Twist now = constraint.motion(g);
        const Impulse impulse = constraint.impulse(g);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(grains[g].effective_mass *
                            (now.velocity[axis] - grains[g].contact_motion.velocity[axis]),
                        impulse.linear[axis], 1e-14);
        to_grains = to_grains + impulse.linear;
    }
    EXPECT_LT(norm(field.momentum() - before + to_grains), 1e-13);
}

}  // namespace
}  // namespace turbidite
