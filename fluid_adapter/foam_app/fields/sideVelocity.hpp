// SPDX-License-Identifier: GPL-3.0-or-later
//
// The velocity prescribed on sides of the fluid (domain/side_motion.hpp), as boundary values of
// U: the one place from which both kinds of steps take it.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/box_step/side_values.hpp"
#include "fluid_adapter/domain/side_motion.hpp"
#include "fluid_adapter/foam_app/fields/createFields.hpp"
#include "fluid_adapter/foam_solver/boxCells.hpp"
#include "fluid_adapter/multiplier/cell_grid.hpp"

namespace turbidite {

class SideVelocity {
 public:
    /// Throws Failure (bad_input), naming the patch, if U does not hold a value on a side that
    /// moves.
    SideVelocity(const std::array<SideMotion, box_sides.size()>& motions, FluidFields& fields);

    /// Sets U on the sides for the window [time, time + step].
    MovedSides set(double time, double step);

 private:
    struct MovedPatch {
        Foam::label patch;
        std::size_t side;
        const SideMotion* motion;
        std::vector<double> shares;  ///< of the profile, by face
    };

    std::array<SideMotion, box_sides.size()> motions_;
    FluidFields& fields_;
    std::vector<MovedPatch> patches_;
};

/// The values that U holds on the sides of a box, by component, along whole sides: left and right
/// by row of the box, bottom and top by column. Every rank calls it and has the same result.
VelocityOnSides held_on_sides(const FluidFields& fields, const BoxCells& box);

/// The same in space: left and right by k + nz j, bottom and top by i + nx k, front and back by
/// i + nx j.
VelocityOnSides held_on_sides(const FluidFields& fields, const CellGrid& grid);

}  // namespace turbidite
