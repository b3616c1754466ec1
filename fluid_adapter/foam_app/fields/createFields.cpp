// SPDX-License-Identifier: GPL-3.0-or-later
#include "fluid_adapter/foam_app/fields/createFields.hpp"

#include <fvcFlux.H>
#include <fvcSurfaceIntegrate.H>

#include <array>
#include <cmath>

namespace turbidite {
namespace {

/// Of the components of u by cell.
template <class X, class Y>
FluidMomentum momentum_of(const FluidFields& fields, X x, Y y) {
    const Foam::scalarField& volume = fields.mesh.V().field();
    std::array<double, 3> sum{};
    forAll(volume, c) {
        sum[0] += volume[c] * x(c);
        sum[1] += volume[c] * y(c);
        sum[2] += volume[c] * (std::abs(x(c)) + std::abs(y(c)));
    }
    fields.ranks.sum(sum.data(), static_cast<int>(sum.size()));
    // rho_f V per unit length in the plane, where the mesh has a thickness
    const Foam::scalar density = fields.rho / fields.thickness;
    return {density * Vec3{sum[0], sum[1], 0.0}, density * sum[2]};
}

Foam::fileName parent_of(const std::filesystem::path& directory) {
    return Foam::fileName(
        std::filesystem::absolute(directory).lexically_normal().parent_path().string());
}

/// The case, or this rank's part of it, by the names OpenFOAM's own programs use.
Foam::fileName name_of(const std::filesystem::path& directory, const RankGroup& ranks) {
    const Foam::fileName name(
        std::filesystem::absolute(directory).lexically_normal().filename().string());
    return ranks.parallel() ? name / ("processor" + std::to_string(ranks.rank())) : name;
}

Foam::IOobject stored(const Foam::fvMesh& mesh, const char* name, Foam::IOobject::readOption read,
                      Foam::IOobject::writeOption write) {
    return Foam::IOobject(name, mesh.time().timeName(), mesh, read, write);
}

}  // namespace

FluidFields::FluidFields(const std::filesystem::path& directory, const RankGroup& group)
    : ranks(group),
      time(parent_of(directory), name_of(directory, group)),
      mesh(Foam::IOobject(Foam::fvMesh::defaultRegion, time.timeName(), time,
                          Foam::IOobject::MUST_READ)),
      in_space(mesh.nSolutionD() == 3),
      transport(Foam::IOobject("transportProperties", time.constant(), mesh,
                               Foam::IOobject::MUST_READ, Foam::IOobject::NO_WRITE)),
      p(stored(mesh, "p", Foam::IOobject::MUST_READ, Foam::IOobject::AUTO_WRITE), mesh),
      U(stored(mesh, "U", Foam::IOobject::MUST_READ, Foam::IOobject::AUTO_WRITE), mesh),
      lambda(stored(mesh, "lambda", Foam::IOobject::NO_READ, Foam::IOobject::AUTO_WRITE), mesh,
             Foam::dimensionedVector(Foam::dimForce / Foam::dimVolume, Foam::Zero)),
      phi(stored(mesh, "phi", Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE),
          Foam::fvc::flux(U)),
      excess(stored(mesh, "excess", Foam::IOobject::NO_READ, Foam::IOobject::NO_WRITE), 0.0 * phi),
      thickness(in_space ? 1.0 : mesh.bounds().span().z()) {
    nu = Foam::dimensionedScalar("nu", Foam::dimViscosity, transport).value();
    rho = Foam::dimensionedScalar("rho", Foam::dimDensity, transport).value();
}

bool FluidFields::finished() const {
    // Within half a step, since times are sums of steps
    return time.value() >= time.endTime().value() - 0.5 * time.deltaTValue();
}

void FluidFields::interpolate_flux() {
    phi = Foam::fvc::flux(U);
}

void FluidFields::divergence(Foam::scalarField& result) const {
    result.setSize(mesh.nCells());
    result = 0.0;
    Foam::fvc::surfaceIntegrate(result, phi);
}

Foam::scalar FluidFields::largest_divergence() const {
    Foam::scalarField each;
    divergence(each);
    return Foam::gMax(Foam::mag(each)());
}

Foam::scalar FluidFields::courant() const {
    const Foam::tmp<Foam::volScalarField> sum = Foam::fvc::surfaceSum(Foam::mag(phi));
    // dt sum |phi| / (2 V), as OpenFOAM's solvers print it: what enters a cell also leaves it.
    return 0.5 * time.deltaTValue() * Foam::gMax((sum().primitiveField() / mesh.V().field())());
}

FluidMomentum FluidFields::momentum() const {
    return momentum_of(
        *this, [this](Foam::label c) { return U[c].x(); },
        [this](Foam::label c) { return U[c].y(); });
}

FluidMomentum FluidFields::momentum(const double* x, const double* y) const {
    return momentum_of(
        *this, [x](Foam::label c) { return x[c]; }, [y](Foam::label c) { return y[c]; });
}

}  // namespace turbidite
