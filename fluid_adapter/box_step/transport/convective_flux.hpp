// SPDX-License-Identifier: GPL-2.0-or-later
//
// Momentum carried through a row of faces, as by two families of OpenFOAM's schemes.
//
// `Gauss limitedLinearV k`. With d the difference of u across the face and d' that across the next
// face upstream,
//
//     u_f = u_upwind +- l d/2,    l = clamp((2/k) r, 0, 1),    r = d . d'/d . d
//
// which is linear interpolation where u is smooth. All components share one limiter. OpenFOAM
// writes r with the gradient at the upwind cell, 2 d . (h grad u)/d . d - 1; on equal cells with
// mirror images beyond the sides the two are the same.
//
// `Gauss linear`, `Gauss LUST grad` and `Gauss linearUpwind grad` with Gauss' linear gradient: a
// mean of central and upwind-biased interpolation with the share a = 1, 3/4, 0 of the central one.
// With U, C, D the cells far upwind, upwind and downwind of the face
//
//     u_f = a (u_C + u_D)/2 + (1 - a) (u_C + (u_D - u_U)/4)
//
// Linear in u and second order everywhere.
//
// Between rows of different heights (row_heights.hpp) OpenFOAM's weights are those of distances,
// and its gradient at a cell is the mean of the differences over distances on either side of it:
//
//     l = clamp((2/k) r, 0, 1),    r = (d . d'/d . d) (distance across the face)/(that of d')
//     u_f = u_upwind +- l s d,     s: distance from the upwind centre to the face, over that of d
//     u_f = a (u_C + s (u_D - u_C)) + (1 - a) (u_C + s (d + d' ratio)/2)
//
// Valid C++17.
#pragma once

#include <optional>
#include <string>

#include "fluid_adapter/multiplier/components.hpp"

namespace turbidite {

/// One component of u on both sides of a row of faces: the two nearest cells on either side.
struct AcrossFaces {
    const double *far_low, *low, *high, *far_high;
};

/// Where a row of faces lies between the centres on either side of it.
struct FacePlace {
    double behind = 1.0,
           ahead = 1.0;            ///< d/d_behind, d/d_ahead: distances of centres, here and next
    double low = 0.5, high = 0.5;  ///< from the centre of either cell to the face, over d
    bool equal = true;             ///< the cells around are of the same size
};

using VelocityAcross = Components<AcrossFaces>;
using CarriedRows = Components<double*>;

/// carried = flux u_f for all components; two_by_k: 2/k of the limiter.
void convective_flux(int count, double two_by_k, const FacePlace& face, const double* flux,
                     const VelocityAcross& u, const CarriedRows& carried);

/// Share of linear interpolation of OpenFOAM's schemes that are linear in u, by their name: linear,
/// LUST, linearUpwind; none for others.
std::optional<double> central_share(const std::string& scheme);

/// k of limitedLinearV as steps take it: 2/k is needed, and k may be 0, at least OpenFOAM's SMALL.
/// None outside 0 to 1, where OpenFOAM refuses it.
std::optional<double> limiter_of_steps(double k);

/// With the share `central` of linear interpolation.
void blended_flux(int count, double central, const FacePlace& face, const double* flux,
                  const VelocityAcross& u, const CarriedRows& carried);

}  // namespace turbidite
