// SPDX-License-Identifier: GPL-3.0-or-later
//
// The OpenFOAM case as objects: time, mesh, fields, constants.
//
//     U       velocity u at cell centres [m/s]
//     phi     its flux through the faces [m3/s]
//     excess  phi minus the flux of the interpolated u, after the last projection [m3/s]
//     p       reduced pressure over rho_f [m2/s2]
//     lambda  force density of the fluid on the grains in the last window [N/m3], output only
#pragma once

#include <IOdictionary.H>
#include <fvMesh.H>
#include <surfaceFields.H>
#include <volFields.H>

#include <filesystem>

#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/foam_app/caseTime.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

struct FluidFields {
    /// Reads the case, on several ranks this rank's processor folder. Throws Foam::error.
    FluidFields(const std::filesystem::path& directory, const RankGroup& ranks);

    RankGroup ranks;
    CaseTime time;
    Foam::fvMesh mesh;
    const bool in_space;           ///< or one layer of cells, between empty patches
    Foam::IOdictionary transport;  ///< constant/transportProperties, where `forces` looks for nu
    Foam::volScalarField p;
    Foam::volVectorField U;
    Foam::volVectorField lambda;
    Foam::surfaceScalarField phi;
    Foam::surfaceScalarField excess;
    Foam::scalar nu;   ///< [m2/s]
    Foam::scalar rho;  ///< rho_f [kg/m3]
    /// Of the single layer of cells in the plane [m]: integrals over it are per unit length; 1 in
    /// space.
    Foam::scalar thickness;

    /// Whether the case's endTime is reached.
    bool finished() const;

    /// phi by interpolation of U: the starting point of a projection.
    void interpolate_flux();

    /// div phi, the mean over every cell [1/s].
    void divergence(Foam::scalarField& result) const;

    /// max |div phi| over all cells [1/s].
    Foam::scalar largest_divergence() const;

    /// Largest Courant number of phi.
    Foam::scalar courant() const;

    /// Momentum of all fluid [N s/m], of U or of these components by cell, in the
    /// plane.
    FluidMomentum momentum() const;
    FluidMomentum momentum(const double* x, const double* y) const;
};

}  // namespace turbidite
