// SPDX-License-Identifier: GPL-3.0-or-later
//
// Fields that are written with U, p and lambda when output.fields names them:
//
//     vorticity   dv/dx - du/dy, in space the vector curl u [1/s]
//     solid       share of the cell covered by grains, where the multipliers found them
#pragma once

#include <memory>

#include "coupler/protocol/settings.hpp"
#include "fluid_adapter/foam_app/fields/foamField.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

class OutputFields {
 public:
    OutputFields(FluidFields& fields, const Settings& settings);

    /// From U and these grains, before OpenFOAM writes.
    void compute(const FoamField& field, const std::vector<ImmersedGrain>& grains);

 private:
    void cover(const FoamField& field, const std::vector<ImmersedGrain>& grains);

    FluidFields& fields_;
    std::unique_ptr<Foam::volScalarField> vorticity_, solid_;
    std::unique_ptr<Foam::volVectorField> curl_;  // the vorticity in space
};

}  // namespace turbidite
