// SPDX-License-Identifier: GPL-2.0-or-later
//
// What crosses this rank's sides of the box: the rate of change of the fluid's momentum it causes,
// over rho_f [m4/s2], in the plane per unit length [m3/s2]. Valid C++17.
#pragma once

#include "fluid_adapter/box_step/box_fluid.hpp"

namespace turbidite {

class SideForces {
 public:
    /// Keeps references to all.
    SideForces(const BoxFluid& fluid, const BoxLayers& layers, const VelocityOnSides& sides)
        : fluid_(fluid), layers_(layers), sides_(sides) {}

    using Velocity = std::vector<double*>;

    BoxForce pressure(const double* p) const;

    /// `flux`: phi1 on the faces, or, if `excess`, e: the part of phi1 besides u on a side.
    BoxForce convective(const Velocity& u, const FaceValues& flux, bool excess) const;

    BoxForce viscous(const Velocity& u) const;

 private:
    template <class PerCell>
    BoxForce over_sides(PerCell per_cell) const;

    const BoxFluid& fluid_;
    const BoxLayers& layers_;
    const VelocityOnSides& sides_;
};

}  // namespace turbidite
