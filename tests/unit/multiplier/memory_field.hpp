// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A fluid field stored in two arrays, and grains on it, for tests of the multiplier method.
#pragma once

#include <functional>
#include <numeric>
#include <random>
#include <vector>

#include "coupler/shapes/disc.hpp"
#include "coupler/shapes/immersed_body.hpp"
#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/plane/boundary_operator.hpp"
#include "fluid_adapter/multiplier/plane/planar.hpp"

namespace turbidite {

/// n x m cells of edge h = 1/16 (D = rho_f = 1), all sides of one kind.
class MemoryField final : public FluidField {
 public:
    MemoryField(int n, int m, Side side, double h = 1.0 / 16.0) {
        grid_.counts = {n, m, 1};
        grid_.spacing = {h, h, 1.0};
        grid_.sides[0] = grid_.sides[1] = {side, side};
        x_.resize(n * m);
        y_.resize(n * m);
        index_.resize(n * m);
        std::iota(index_.begin(), index_.end(), 0);
        cells_ = {index_.data(), {0, 0}, {n, m}, {0, 0}};
    }

    /// Cells between the given edges.
    MemoryField(const std::vector<double>& x_edges, const std::vector<double>& y_edges, Side side)
        : MemoryField(static_cast<int>(x_edges.size()) - 1, static_cast<int>(y_edges.size()) - 1,
                      side) {
        grid_.stretch(0, x_edges);
        grid_.stretch(1, y_edges);
    }

    /// n cells of edge h along x, rows between the given edges.
    MemoryField(int n, const std::vector<double>& y_edges, Side side, double h)
        : MemoryField(n, static_cast<int>(y_edges.size()) - 1, side, h) {
        grid_.stretch(1, y_edges);
    }

    MemoryField(const MemoryField&) = delete;

    const CellGrid& grid() const override { return grid_; }
    const CellTable& cells() const override { return cells_; }
    int local_cells() const override { return static_cast<int>(x_.size()); }
    int owned_cells() const override { return local_cells(); }
    double reference_mass() const override { return grid_.spacing[0] * grid_.spacing[1]; }
    double* velocity(int axis) override { return axis == 0 ? x_.data() : y_.data(); }

    void fill(const std::function<Planar(double, double)>& velocity_at) {
        for (int j = 0; j < grid_.counts[1]; ++j)
            for (int i = 0; i < grid_.counts[0]; ++i) {
                const Planar u = velocity_at(grid_.centre(0, i), grid_.centre(1, j));
                x_[cell(i, j, 0)] = u.x();
                y_[cell(i, j, 0)] = u.y();
            }
    }

    void fill_randomly(unsigned seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<double> value(-1.0, 1.0);
        for (double& u : x_) u = value(random);
        for (double& u : y_) u = value(random);
    }

    Planar momentum() const {
        Planar sum = Planar::Zero();
        for (int j = 0; j < grid_.counts[1]; ++j)
            for (int i = 0; i < grid_.counts[0]; ++i) {
                const int c = cell(i, j, 0);
                sum += cell_mass(i, j) * Planar(x_[c], y_[c], 0.0);
            }
        return sum;
    }

 private:
    CellGrid grid_;
    std::vector<double> x_, y_;
    std::vector<int> index_;
    CellTable cells_;
};

/// u in the cells used for interpolation, by slot.
inline std::vector<PlaneVector> at_slots(MemoryField& field, const CollocationPoints& points) {
    std::vector<PlaneVector> u;
    for (const StencilCell& at : points.stencilled)
        u.push_back({field.velocity(0)[at.cell], field.velocity(1)[at.cell]});
    return u;
}

/// A disc of diameter 1 with the given motion after the contact step.
inline ImmersedGrain disc(GrainId id, double x, double y, const Planar& motion = Planar::Zero(),
                          double density_ratio = 1.5) {
    static const Disc shape;
    const ImmersedBody body = immersed_body(shape, 0.5, density_ratio, 1.0, 1.0);
    ImmersedGrain grain;
    grain.id = id;
    grain.shape = &shape;
    grain.radius = 0.5;
    grain.position = {x, y, 0.0};
    grain.effective_mass = body.effective_mass;
    grain.effective_inertia = body.effective_inertia(2, 2);
    grain.contact_motion = twist(motion);
    return grain;
}

}  // namespace turbidite
