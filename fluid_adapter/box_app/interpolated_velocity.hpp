// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A velocity in space between cells, by linear interpolation or weighted by volumes (OpenFOAM's
// linear and reverseLinear), what it is on sides, and what follows from both: its divergence and
// its curl, as OpenFOAM's Gauss theorem has them. Valid C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"
#include "fluid_adapter/box_step/side_values.hpp"
#include "fluid_adapter/multiplier/covered_share.hpp"

namespace turbidite {

class InterpolatedVelocity {
 public:
    /// Every rank makes one: layers of other ranks next to its own are exchanged. `sides`: what u
    /// is on them.
    InterpolatedVelocity(FluidField& field, BoxRows& rows, const VelocityOnSides& sides);

    /// [1/s], of the flux from values weighted by volumes.
    double divergence(const CellIndex& at) const;

    /// [1/s], from linear interpolation.
    Vec3 curl(const CellIndex& at) const;

 private:
    enum class Weight { volume, distance };

    double in_cell(int component, const CellIndex& at) const;
    double on_face(int component, int axis, int end, const CellIndex& at, Weight weight) const;
    double derivative(int component, int axis, const CellIndex& at, Weight weight) const;
    std::size_t on_side(int axis, const CellIndex& at) const;

    const CellGrid& grid_;
    const VelocityOnSides& sides_;
    int first_, count_;  // layers of this rank
    VelocityPointers u_;
    std::array<std::vector<double>, 3> outside_;  // by component: the layer below, that above
};

/// The largest divergence on this rank [1/s]; every rank calls it.
double largest_divergence_of(FluidField& field, BoxRows& rows, const VelocityOnSides& sides);

}  // namespace turbidite
