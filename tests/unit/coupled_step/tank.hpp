// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A box of fluid at D/8 with discs in it, for pressure and viscosity with rigid grains.
#pragma once

#include <random>

#include "fluid_adapter/coupled_step/coupled_step.hpp"
#include "tests/unit/multiplier/memory_field.hpp"

namespace turbidite {

constexpr int cells_across = 48;
constexpr double cell_size = 1.0 / 8.0;
constexpr double time_step = 0.01;

inline BoxFluid box_fluid(Side side, double viscosity) {
    const auto plane = [&](End end) {
        const AxisOperator axis{cells_across, cell_size, end, end};
        return PlaneOperator{axis, axis};
    };
    BoxFluid fluid;
    fluid.velocity = plane(side == Side::cyclic ? End::periodic
                           : side == Side::wall ? End::dirichlet
                                                : End::neumann);
    fluid.pressure = plane(side == Side::cyclic ? End::periodic
                           : side == Side::wall ? End::neumann
                                                : End::dirichlet);
    fluid.viscosity = viscosity;
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
    step.operators().flux_residual(time_step, none.data(), step.velocity(0), step.velocity(1),
                                   {step.excess(0).data(), step.excess(1).data(), 0.0, none.data()},
                                   {}, r.data());
    const std::vector<double>&x = step.excess(0), &y = step.excess(1);
    constexpr int n = cells_across;
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
            r[j * n + i] -=
                (x[j * (n + 1) + i + 1] - x[j * (n + 1) + i] + y[(j + 1) * n + i] - y[j * n + i]) /
                cell_size;
    return r;
}

/// Three discs with gaps of a cell and more, one of which touches nothing.
inline std::vector<ImmersedGrain> three_discs_of(double density_ratio) {
    return {disc(1, 1.513, 2.007, {0.1, -0.5, 0.7}, density_ratio),
            disc(2, 2.66, 2.03, {-0.2, 0.3, -0.4}, density_ratio),
            disc(3, 4.01, 4.02, {0.0, -1.0, 0.0}, density_ratio)};
}

struct Tank {
    explicit Tank(Side side, double viscosity = 0.01, double density_ratio = 1.5)
        : field(cells_across, cells_across, side, cell_size),
          grains(three_discs_of(density_ratio)),
          step(box_fluid(side, viscosity)),
          box(step.operators()) {
        PointPlacement(PointRules{}).place(field, grains, points);
        step.pressure_solve();
        for (int axis = 0; axis < 2; ++axis) {
            std::vector<double> u(size());
            fill_randomly(u, 5 + axis);
            std::copy(u.begin(), u.end(), step.velocity(axis));
        }
        settings.tolerance = 1e-12;
        settings.reduction = 1.0;
        system.assemble(field, grains, points);
        flow.begin(system, velocity(), momenta_of(grains), prescribed_motions(grains));
        uzawa_cg(flow, settings, work);
        flow.impose();
    }

    std::size_t size() const { return static_cast<std::size_t>(cells_across) * cells_across; }
    CellVelocity velocity() { return {step.velocity(0), step.velocity(1)}; }
    RigidGrains rigid() { return RigidGrains(system, flow, velocity(), settings); }

    /// Momentum of all fluid.
    Planar momentum() {
        Planar sum = Planar::Zero();
        for (std::size_t c = 0; c < size(); ++c)
            sum += cell_size * cell_size * Planar(step.velocity(0)[c], step.velocity(1)[c], 0.0);
        return sum;
    }

    MemoryField field;
    std::vector<ImmersedGrain> grains;
    CollocationPoints points;
    BoxStep step;
    BoxOperators box;
    SaddleOperator system;
    ConstrainedFlow flow;
    MultiplierSettings settings;
    MultiplierWorkspace work;
};

}  // namespace turbidite
