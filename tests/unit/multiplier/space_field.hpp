// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A fluid in space in plain arrays, of one rank or some layers of it, and spheres in it.
#pragma once

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "coupler/shapes/immersed_body.hpp"
#include "coupler/shapes/sphere.hpp"
#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"
#include "fluid_adapter/multiplier/space/sphere_cells.hpp"

namespace turbidite {

constexpr double edge = 0.1;  // D/10

/// Cells of edge D/10 with rho_f = 1, of which this rank has some layers.
class SpaceField : public FluidField {
 public:
    SpaceField(std::array<int, 3> cells, Side side, int first = 0, int count = -1)
        : first_(first), layers_(count < 0 ? cells[1] : count) {
        grid_.dimension = 3;
        grid_.counts = cells;
        grid_.spacing = {edge, edge, edge};
        for (auto& ends : grid_.sides) ends.fill(side);
        for (std::vector<double>& u : velocity_) u.resize(owned_cells());
    }

    const CellGrid& grid() const override { return grid_; }
    const CellTable& cells() const override { return none_; }
    int owned_cells() const override { return grid_.counts[0] * grid_.counts[2] * layers_; }
    int local_cells() const override { return owned_cells(); }
    int first_layer() const override { return first_; }
    double reference_mass() const override { return edge * edge * edge; }
    double* velocity(int axis) override { return velocity_[axis].data(); }

    VelocityPointers all() { return {velocity(0), velocity(1), velocity(2)}; }

    void fill_randomly(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> value(-1.0, 1.0);
        for (std::vector<double>& u : velocity_)
            for (double& v : u) v = value(random);
    }

    Vec3 momentum() const {
        Vec3 sum{};
        for (int axis = 0; axis < 3; ++axis)
            for (const double v : velocity_[axis]) sum[axis] += reference_mass() * v;
        return sum;
    }

    double product(const SpaceField& other) const {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis)
            for (std::size_t c = 0; c < velocity_[axis].size(); ++c)
                sum += velocity_[axis][c] * other.velocity_[axis][c];
        return sum;
    }

 private:
    CellGrid grid_;
    CellTable none_;
    int first_, layers_;
    std::array<std::vector<double>, 3> velocity_;
};

inline ImmersedGrain sphere(GrainId id, const Eigen::Vector3d& at, double radius = 0.5,
                            double density_ratio = 1.5) {
    static const Sphere shape;
    const ImmersedBody body = immersed_body(shape, radius, density_ratio, 1.0, 1.0);
    ImmersedGrain grain;
    grain.id = id;
    grain.shape = &shape;
    grain.radius = radius;
    grain.position = at;
    grain.effective_mass = body.effective_mass;
    grain.effective_inertia = body.effective_inertia(2, 2);
    grain.contact_motion = {{0.1 * static_cast<double>(id), -0.5, 0.2}, {0.3, -0.7, 1.1}};
    return grain;
}

/// Body of each of the rank's cells, -1 none.
inline std::vector<int> found_owners(const SpaceField& field, const SphereCells& cells,
                                     std::size_t bodies) {
    std::vector<int> owner(field.owned_cells(), -1);
    for (std::size_t g = 0; g < bodies; ++g)
        for (const CellRun& run : cells.runs(g))
            for (int c = 0; c < run.count; ++c) {
                EXPECT_EQ(owner[run.cell + c], -1) << "two bodies have cell " << run.cell + c;
                owner[run.cell + c] = static_cast<int>(g);
            }
    return owner;
}

}  // namespace turbidite
