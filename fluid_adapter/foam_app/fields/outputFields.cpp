// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/outputFields.hpp"

#include <fvcCurl.H>

#include "fluid_adapter/fluid_window/wanted_fields.hpp"
#include "fluid_adapter/multiplier/covered_share.hpp"

namespace turbidite {
namespace {

/// Zero, on the mesh, of this unit; written with the others.
template <class Field>
std::unique_ptr<Field> written(FluidFields& fields, const char* name,
                               const Foam::dimensionSet& unit) {
    return std::make_unique<Field>(
        Foam::IOobject(name, fields.time.timeName(), fields.mesh, Foam::IOobject::NO_READ,
                       Foam::IOobject::AUTO_WRITE),
        fields.mesh, Foam::dimensioned<typename Field::value_type>(unit, Foam::Zero));
}

}  // namespace

OutputFields::OutputFields(FluidFields& fields, const Settings& settings) : fields_(fields) {
    const Foam::dimensionSet rate = Foam::dimless / Foam::dimTime;
    if (is_wanted(settings, "vorticity") && fields.in_space)
        curl_ = written<Foam::volVectorField>(fields, "vorticity", rate);
    if (is_wanted(settings, "vorticity") && !fields.in_space)
        vorticity_ = written<Foam::volScalarField>(fields, "vorticity", rate);
    if (is_wanted(settings, "solid"))
        solid_ = written<Foam::volScalarField>(fields, "solid", Foam::dimless);
}

void OutputFields::compute(const FoamField& field, const std::vector<ImmersedGrain>& grains) {
    if (vorticity_) *vorticity_ = Foam::fvc::curl(fields_.U)().component(Foam::vector::Z);
    if (curl_) *curl_ = Foam::fvc::curl(fields_.U);
    if (solid_) cover(field, grains);
}

void OutputFields::cover(const FoamField& field, const std::vector<ImmersedGrain>& grains) {
    const std::vector<double> shares = covered_share(field, grains);
    for (std::size_t cell = 0; cell < shares.size(); ++cell)
        solid_->primitiveFieldRef()[field.mesh_cell(static_cast<int>(cell))] = shares[cell];
    solid_->correctBoundaryConditions();
}

}  // namespace turbidite
