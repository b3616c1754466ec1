// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/side_forces.hpp"

namespace turbidite {
namespace {

End end_at(const SeparableOperator& grid, int side) {
    const AxisOperator& axis = side < 2 ? grid.x : side < 4 ? grid.y : grid.z;
    return side % 2 == 0 ? axis.lower : axis.upper;
}

/// Value at the boundary face over the value in the cell next to it.
double at_face(const SeparableOperator& grid, int side) {
    return 0.5 * (1.0 + mirrored(end_at(grid, side)));
}

}  // namespace

/// Sums per_cell(side, at, cell, face) |S| over the cells along the non-cyclic sides. Sides are
/// left, right, bottom, top, and in space those behind and in front; `at` is the place along the
/// side (side_values.hpp), `face` the index of the boundary face among those normal to axis side/2.
template <class PerCell>
BoxForce SideForces::over_sides(PerCell per_cell) const {
    BoxForce sum{};
    const BoxLayers& l = layers_;
    const std::size_t nx = l.nx, ny = l.ny, nz = l.nz, layer = l.layer();
    const auto add = [&](int side, std::size_t at, std::size_t cell, std::size_t face,
                         double area) {
        const BoxForce one = per_cell(side, at, cell, face);
        for (int axis = 0; axis < 3; ++axis) sum[axis] += area * one[axis];
    };
    for (std::size_t row = 0; !l.periodic_x && row < ny * nz; ++row) {
        const double area = l.heights.size(static_cast<int>(row / nz)) * l.hz;
        add(0, row, row * nx, row * (nx + 1), area);
        add(1, row, row * nx + nx - 1, row * (nx + 1) + nx, area);
    }
    for (std::size_t i = 0; i < layer && !l.open_below; ++i) add(2, i, i, i, l.hx * l.hz);
    for (std::size_t i = 0; i < layer && !l.open_above; ++i)
        add(3, i, (ny - 1) * layer + i, ny * layer + i, l.hx * l.hz);
    for (std::size_t j = 0; !l.periodic_z && j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i) {
            const double area = l.hx * l.heights.size(static_cast<int>(j));
            add(4, j * nx + i, j * layer + i, j * (nz + 1) * nx + i, area);
            add(5, j * nx + i, (j + 1) * layer - nx + i, (j * (nz + 1) + nz) * nx + i, area);
        }
    return sum;
}

BoxForce SideForces::pressure(const double* p) const {
    return over_sides([&](int side, std::size_t, std::size_t cell, std::size_t) {
        BoxForce force{};
        // The side pushes inwards with p at its face: that of the cell, or 0 if it is prescribed.
        force[side / 2] = (side % 2 == 0 ? 1.0 : -1.0) * at_face(fluid_.pressure, side) * p[cell];
        return force;
    });
}

BoxForce SideForces::convective(const Velocity& u, const FaceValues& flux, bool excess) const {
    return over_sides([&](int side, std::size_t at, std::size_t cell, std::size_t face) {
        // u at the face: u_b where it is prescribed (share 0), otherwise that of the cell (share 1)
        const double share = at_face(fluid_.velocity, side);
        BoxForce held{};
        for (std::size_t c = 0; c < u.size(); ++c)
            held[c] = share * u[c][cell] + sides_[c][side][at];
        const int axis = side / 2;
        const double through = excess ? held[axis] + flux[axis][face] : flux[axis][face];
        // Momentum carried in by the flux through the face, u phi1
        const double inward = side % 2 == 0 ? through : -through;
        return BoxForce{inward * held[0], inward * held[1], inward * held[2]};
    });
}

BoxForce SideForces::viscous(const Velocity& u) const {
    const auto across = [&](int side) {  // h
        return side < 2   ? layers_.hx
               : side < 4 ? layers_.heights.size(side == 2 ? 0 : layers_.ny - 1)
                          : layers_.hz;
    };
    return over_sides([&](int side, std::size_t at, std::size_t cell, std::size_t) {
        // u_{-1} - u_0 = (f - 1) u_0 + 2 u_b
        const double difference = mirrored(end_at(fluid_.velocity, side)) - 1.0;
        const double per_length = fluid_.viscosity / across(side);
        BoxForce rate{};
        for (std::size_t c = 0; c < u.size(); ++c)  // nu (u_{-1} - u_0)/h
            rate[c] = per_length * (difference * u[c][cell] + 2.0 * sides_[c][side][at]);
        return rate;
    });
}

}  // namespace turbidite
