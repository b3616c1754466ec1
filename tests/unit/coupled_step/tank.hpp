// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A box of fluid at D/8 with discs in it, for pressure and viscosity with rigid grains; its rows
// are equal, or stretched above the discs.
#pragma once

#include <random>
#include <string>

#include "fluid_adapter/coupled_step/coupled_step.hpp"
#include "fluid_adapter/multiplier/plane/plane_constraint.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {

constexpr int cells_across = 48;
constexpr double cell_size = 1.0 / 8.0;
constexpr double time_step = 0.01;

struct TankSides {
    Side side;
    bool stretched = false;
};

/// Names of test parameters.
inline std::string name_of(const TankSides& sides) {
    const std::string name = sides.side == Side::wall   ? "wall"
                             : sides.side == Side::open ? "open"
                                                        : "cyclic";
    return (sides.stretched ? "stretched_" : "") + name;
}

inline constexpr TankSides all_tanks[] = {
    {Side::wall}, {Side::open}, {Side::cyclic}, {Side::wall, true}, {Side::open, true}};

/// Equal up to 4.75 D, then growing by a twelfth each.
inline std::vector<double> stretched_rows() {
    std::vector<double> rows(38, cell_size);
    while (rows.size() < cells_across) rows.push_back(rows.back() * 13.0 / 12.0);
    return rows;
}

inline std::vector<double> edges_of(const std::vector<double>& rows) {
    std::vector<double> edges = {0.0};
    for (const double row : rows) edges.push_back(edges.back() + row);
    return edges;
}

inline BoxFluid box_fluid(const TankSides& sides, double viscosity) {
    const Side side = sides.side;
    const auto plane = [&](End end) {
        const AxisOperator axis{cells_across, cell_size, end, end};
        SeparableOperator both{axis, axis};
        if (sides.stretched) both.y.sizes = stretched_rows();
        return both;
    };
    BoxFluid fluid;
    fluid.velocity = plane(side == Side::cyclic ? End::periodic
                           : side == Side::wall ? End::dirichlet
                                                : End::neumann);
    fluid.pressure = plane(side == Side::cyclic ? End::periodic
                           : side == Side::wall ? End::neumann
                                                : End::dirichlet);
    fluid.viscosity = viscosity;
    fluid.second_order = true;  // it may be, where a test asks for it
    fluid.central = 0.75;
    return fluid;
}

inline void fill_randomly(std::vector<double>& values, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> value(-1.0, 1.0);
    for (double& v : values) v = value(random);
}

inline double product(const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

/// -(D u + div e) of the step's velocity and excess, as it stands.
inline std::vector<double> flux_defect(BoxStep& step) {
    const std::vector<double> none(step.cells(), 0.0);
    std::vector<double> r(step.cells());
    step.operators().flux_residual(time_step, none.data(), {step.velocity(0), step.velocity(1)},
                                   {step.excess_pointers(), none.data()}, {}, r.data());
    const std::vector<double>&x = step.excess(0), &y = step.excess(1);
    constexpr int n = cells_across;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            r[j * n + i] -= (x[j * (n + 1) + i + 1] - x[j * (n + 1) + i]) / cell_size +
                            (y[(j + 1) * n + i] - y[j * n + i]) / step.layers().heights.size(j);
    return r;
}

/// Three discs with gaps of a cell and more, one of which touches nothing.
inline std::vector<ImmersedGrain> three_discs_of(double density_ratio) {
    return {disc(1, 1.513, 2.007, {0.1, -0.5, 0.7}, density_ratio),
            disc(2, 2.66, 2.03, {-0.2, 0.3, -0.4}, density_ratio),
            disc(3, 4.01, 4.02, {0.0, -1.0, 0.0}, density_ratio)};
}

struct Tank {
    explicit Tank(const TankSides& sides, double viscosity = 0.01, double density_ratio = 1.5)
        : rows(sides.stretched ? stretched_rows() : std::vector<double>(cells_across, cell_size)),
          stretched_field(cells_across, edges_of(rows), sides.side, cell_size),
          equal_field(cells_across, cells_across, sides.side, cell_size),
          field(sides.stretched ? stretched_field : equal_field),
          grains(three_discs_of(density_ratio)),
          step(box_fluid(sides, viscosity)),
          box(step.operators()),
          constraint(field, PointRules{}, tight()) {
        step.pressure_solve();
        for (int axis = 0; axis < 2; ++axis) {
            std::vector<double> u(size());
            fill_randomly(u, 5 + axis);
            std::copy(u.begin(), u.end(), step.velocity(axis));
        }
        place_grains();
    }

    static MultiplierSettings tight() {
        MultiplierSettings settings;
        settings.tolerance = 1e-12;
        settings.reduction = 1.0;
        return settings;
    }

    void place_grains() {
        constraint.place(grains);
        constraint.solve(velocity());
        constraint.impose();
    }

    std::size_t size() const { return static_cast<std::size_t>(cells_across) * cells_across; }
    VelocityPointers velocity() { return {step.velocity(0), step.velocity(1)}; }
    RigidGrains rigid() {
        return RigidGrains(constraint, {step.velocity(0), step.velocity(1)}, size());
    }
    const std::vector<Planar>& motions() const { return constraint.flow().motions(); }
    const CollocationPoints& points() const { return constraint.points(); }

    /// Momentum of all fluid.
    Planar momentum() {
        Planar sum = Planar::Zero();
        for (std::size_t c = 0; c < size(); ++c)
            sum += cell_size * rows[c / cells_across] *
                   Planar(step.velocity(0)[c], step.velocity(1)[c], 0.0);
        return sum;
    }

    std::vector<double> rows;  // heights
    MemoryField stretched_field, equal_field;
    MemoryField& field;
    std::vector<ImmersedGrain> grains;
    BoxStep step;
    BoxOperators box;
    PlaneConstraint constraint;
};

}  // namespace turbidite
