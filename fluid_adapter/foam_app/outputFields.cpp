// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/outputFields.hpp"

#include <fvcCurl.H>

#include <sstream>

#include "fluid_adapter/multiplier/covered_share.hpp"

namespace turbidite {
namespace {

bool wanted(const Settings& settings, const std::string& field) {
    if (!settings.has("output.fields")) return false;
    std::istringstream names(settings.text("output.fields"));
    for (std::string name; names >> name;)
        if (name == field) return true;
    return false;
}

std::unique_ptr<Foam::volScalarField> written(FluidFields& fields, const char* name,
                                              const Foam::dimensionSet& unit) {
    return std::make_unique<Foam::volScalarField>(
        Foam::IOobject(name, fields.time.timeName(), fields.mesh, Foam::IOobject::NO_READ,
                       Foam::IOobject::AUTO_WRITE),
        fields.mesh, Foam::dimensionedScalar(unit, Foam::Zero));
}

}  // namespace

OutputFields::OutputFields(FluidFields& fields, const Settings& settings) : fields_(fields) {
    if (fields.mesh.nSolutionD() == 3) return;
    if (wanted(settings, "vorticity"))
        vorticity_ = written(fields, "vorticity", Foam::dimless / Foam::dimTime);
    if (wanted(settings, "solid")) solid_ = written(fields, "solid", Foam::dimless);
}

void OutputFields::compute(const FoamFluidField& field, const std::vector<ImmersedGrain>& grains) {
    if (vorticity_) *vorticity_ = Foam::fvc::curl(fields_.U)().component(Foam::vector::Z);
    if (!solid_) return;
    const std::vector<double> shares = covered_share(field, grains);
    std::copy(shares.begin(), shares.end(), solid_->primitiveFieldRef().begin());
    solid_->correctBoundaryConditions();
}

}  // namespace turbidite
