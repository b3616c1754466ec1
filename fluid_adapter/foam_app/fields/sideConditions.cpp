// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/sideConditions.hpp"

#include <string>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/scene/sides.hpp"

namespace turbidite {
namespace {

[[noreturn]] void refuse(const BoxSide& side, const char* file, const std::string& found,
                         const char* expected) {
    throw Failure(ExitCode::bad_input, std::string(file) +
                                           " of the fluid case: in space the condition of patch " +
                                           side.name + " must be " + expected + ", as " + side.key +
                                           " has it, and not " + found);
}

/// Neither of the two types that the steps know, which do not change with time.
template <class Condition>
bool is_neither(const Condition& condition, const char* one, const char* other) {
    return condition.type() != one && condition.type() != other;
}

/// u is held, p is not.
void demand_wall(const BoxSide& side, const Foam::fvPatchVectorField& u,
                 const Foam::fvPatchScalarField& p) {
    if (is_neither(u, "fixedValue", "noSlip"))
        refuse(side, "0/U", u.type(), "fixedValue or noSlip");
    if (p.type() != "zeroGradient") refuse(side, "0/p", p.type(), "zeroGradient");
}

/// p = 0 is held, u is not.
void demand_free(const BoxSide& side, const Foam::fvPatchVectorField& u,
                 const Foam::fvPatchScalarField& p) {
    if (u.type() != "zeroGradient") refuse(side, "0/U", u.type(), "zeroGradient");
    if (p.type() != "fixedValue") refuse(side, "0/p", p.type(), "fixedValue");
    if (Foam::gMax(Foam::mag(p)()) > 0.0)
        refuse(side, "0/p", "another value", "fixedValue with uniform 0");
}

}  // namespace

void demand_conditions_of_grid(const FluidFields& fields, const CellGrid& grid) {
    for (const BoxSide& side : box_sides) {
        const Side kind = grid.sides[side.axis][side.inward > 0.0 ? 0 : 1];
        const Foam::label patch = fields.mesh.boundary().findPatchID(side.name);
        if (kind == Side::cyclic || patch < 0) continue;
        const auto& demand = kind == Side::wall ? demand_wall : demand_free;
        demand(side, fields.U.boundaryField()[patch], fields.p.boundaryField()[patch]);
    }
}

}  // namespace turbidite
