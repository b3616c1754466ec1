// SPDX-License-Identifier: GPL-2.0-or-later
//
// Liquid in the wedge around a contact, where the cells belong to grains. Two cells side by side,
// one of each grain, have the divergence of their relative velocity, and pressure forbids it:
// grains that touch on the mesh could neither part nor roll, nor leave a wall. So faces between
// cells of a wedge (multiplier/space/wedges.hpp), also those along it between two cells of one
// grain, through which it fills and drains, carry the flux of a film of thickness delta = h/2. With
// phi = delta/h, the part of the face that it fills,
//
//     de/dt  =  -phi dp/dn - 12 nu/delta^2 e        (flow between two plates)
//     e      =  k (e_old - phi dt dp/dn),           k = 1/(1 + 12 nu dt/delta^2)
//
// h is the size of the cells that are not stretched. A body force a drives the liquid against what
// does not move with it: between bodies whose motion is prescribed a film feels a - dp/dn. Free
// ones are accelerated with the liquid, and their films are taken to feel the pressure alone. Valid
// C++17.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "fluid_adapter/box_step/box_layers.hpp"
#include "fluid_adapter/box_step/row_reader.hpp"
#include "fluid_adapter/multiplier/cell_side.hpp"
#include "fluid_adapter/multiplier/components.hpp"

namespace turbidite {

class WedgeFlow {
 public:
    /// Begins a window of length dt [s] in which these `sides` of cells carry a film, every face
    /// from both of its cells; e as BoxStep::excess, nu [m2/s], h^2 [m2], a [m/s2].
    void begin(const std::vector<CellSide>& sides, const BoxLayers& layers,
               const VelocityPointers& e, double viscosity, double cell_area,
               const std::array<double, 3>& a, double dt);

    /// out += share div(what does not depend on p), of layer j.
    void add_kept(int j, double share, double* out) const;

    /// out -= step div(k phi grad p) of layer j, of which p and the layers beside it have been
    /// read.
    void add_driven(int j, double step, RowReader& p, double* out) const;

    /// e = k (e_old - phi step dp/dn) on the faces of layer j.
    void update(int j, double step, RowReader& p, const VelocityPointers& e) const;

 private:
    struct Face {
        int i, k;                // of the cell in its layer
        int place;               // in e of the axis
        std::int8_t axis, side;  // as in CellSide
        double kept;             // k (e_old + phi dt a)
    };

    double width(int axis, int j) const;
    double slope(const Face& face, int j, RowReader& p) const;

    std::vector<std::vector<Face>> faces_;  // by layer
    const BoxLayers* layers_ = nullptr;
    double driven_ = 0.0;  // k phi
};

}  // namespace turbidite
