// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/convective_flux.hpp"

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

TURBIDITE_ROW_WORK
void carry(int count, double two_by_k, const double* __restrict flux, const double* __restrict u0,
           const double* __restrict u1, const double* __restrict u2, const double* __restrict u3,
           const double* __restrict v0, const double* __restrict v1, const double* __restrict v2,
           const double* __restrict v3, double* __restrict carried_u,
           double* __restrict carried_v) {
    constexpr double tiny = 1e-300;  // avoids 0/0: no difference, no correction
    for (int i = 0; i < count; ++i) {
        const bool up = flux[i] > 0.0;
        const double du = u2[i] - u1[i], dv = v2[i] - v1[i];
        const double u_behind = u1[i] - u0[i], u_ahead = u3[i] - u2[i];
        const double v_behind = v1[i] - v0[i], v_ahead = v3[i] - v2[i];
        const double eu = up ? u_behind : u_ahead, ev = up ? v_behind : v_ahead;
        const double r = (du * eu + dv * ev) / (du * du + dv * dv + tiny);
        double l = two_by_k * r;
        l = l < 1.0 ? l : 1.0;
        l = l > 0.0 ? l : 0.0;
        const double half = up ? 0.5 * l : -0.5 * l;
        carried_u[i] = flux[i] * ((up ? u1[i] : u2[i]) + half * du);
        carried_v[i] = flux[i] * ((up ? v1[i] : v2[i]) + half * dv);
    }
}

TURBIDITE_ROW_WORK
void carry_blended(int count, double central, const double* __restrict flux,
                   const double* __restrict u0, const double* __restrict u1,
                   const double* __restrict u2, const double* __restrict u3,
                   double* __restrict carried) {
    const double mean = 0.5 * central, upwind = 1.0 - central;
    for (int i = 0; i < count; ++i) {
        const double low = u1[i] + 0.25 * (u2[i] - u0[i]), high = u2[i] - 0.25 * (u3[i] - u1[i]);
        carried[i] = flux[i] * (mean * (u1[i] + u2[i]) + upwind * (flux[i] > 0.0 ? low : high));
    }
}

/// carry between rows of different heights.
TURBIDITE_ROW_WORK
void carry_across(int count, double two_by_k, const FaceBetweenRows& face,
                  const double* __restrict flux, const double* __restrict u0,
                  const double* __restrict u1, const double* __restrict u2,
                  const double* __restrict u3, const double* __restrict v0,
                  const double* __restrict v1, const double* __restrict v2,
                  const double* __restrict v3, double* __restrict carried_u,
                  double* __restrict carried_v) {
    constexpr double tiny = 1e-300;  // avoids 0/0: no difference, no correction
    const auto [behind, ahead, low, high] = face;
    for (int i = 0; i < count; ++i) {
        const bool up = flux[i] > 0.0;
        const double du = u2[i] - u1[i], dv = v2[i] - v1[i];
        const double u_behind = behind * (u1[i] - u0[i]), u_ahead = ahead * (u3[i] - u2[i]);
        const double v_behind = behind * (v1[i] - v0[i]), v_ahead = ahead * (v3[i] - v2[i]);
        const double eu = up ? u_behind : u_ahead, ev = up ? v_behind : v_ahead;
        const double r = (du * eu + dv * ev) / (du * du + dv * dv + tiny);
        double l = two_by_k * r;
        l = l < 1.0 ? l : 1.0;
        l = l > 0.0 ? l : 0.0;
        const double share = up ? low * l : -high * l;
        carried_u[i] = flux[i] * ((up ? u1[i] : u2[i]) + share * du);
        carried_v[i] = flux[i] * ((up ? v1[i] : v2[i]) + share * dv);
    }
}

/// carry_blended between rows of different heights.
TURBIDITE_ROW_WORK
void carry_blended_across(int count, double central, const FaceBetweenRows& face,
                          const double* __restrict flux, const double* __restrict u0,
                          const double* __restrict u1, const double* __restrict u2,
                          const double* __restrict u3, double* __restrict carried) {
    const double upwind = 1.0 - central;
    const auto [behind, ahead, low, high] = face;
    for (int i = 0; i < count; ++i) {
        const double d = u2[i] - u1[i];
        const double from_low = u1[i] + 0.5 * low * (d + behind * (u1[i] - u0[i]));
        const double from_high = u2[i] - 0.5 * high * (d + ahead * (u3[i] - u2[i]));
        const double linear = u1[i] + low * d;
        carried[i] = flux[i] * (central * linear + upwind * (flux[i] > 0.0 ? from_low : from_high));
    }
}

}  // namespace

void convective_flux(int count, double two_by_k, const double* flux, const AcrossFaces& u,
                     const AcrossFaces& v, double* carried_u, double* carried_v) {
    carry(count, two_by_k, flux, u.far_low, u.low, u.high, u.far_high, v.far_low, v.low, v.high,
          v.far_high, carried_u, carried_v);
}

void blended_flux(int count, double central, const double* flux, const AcrossFaces& u,
                  const AcrossFaces& v, double* carried_u, double* carried_v) {
    carry_blended(count, central, flux, u.far_low, u.low, u.high, u.far_high, carried_u);
    carry_blended(count, central, flux, v.far_low, v.low, v.high, v.far_high, carried_v);
}

void convective_flux(int count, double two_by_k, const FaceBetweenRows& face, const double* flux,
                     const AcrossFaces& u, const AcrossFaces& v, double* carried_u,
                     double* carried_v) {
    carry_across(count, two_by_k, face, flux, u.far_low, u.low, u.high, u.far_high, v.far_low,
                 v.low, v.high, v.far_high, carried_u, carried_v);
}

void blended_flux(int count, double central, const FaceBetweenRows& face, const double* flux,
                  const AcrossFaces& u, const AcrossFaces& v, double* carried_u,
                  double* carried_v) {
    carry_blended_across(count, central, face, flux, u.far_low, u.low, u.high, u.far_high,
                         carried_u);
    carry_blended_across(count, central, face, flux, v.far_low, v.low, v.high, v.far_high,
                         carried_v);
}

}  // namespace turbidite
