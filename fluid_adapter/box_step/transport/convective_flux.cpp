// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/transport/convective_flux.hpp"

#include <algorithm>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

/// Inlined, so that the numbers of equal cells are constants; without `space` there is no w.
template <bool space>
[[gnu::always_inline]] inline void carry(int count, double two_by_k, const FacePlace face,
                                         const double* __restrict flux, const AcrossFaces u,
                                         const AcrossFaces v, const AcrossFaces w,
                                         double* __restrict carried_u, double* __restrict carried_v,
                                         double* __restrict carried_w) {
    constexpr double tiny = 1e-300;  // avoids 0/0: no difference, no correction
#pragma GCC ivdep
    for (int i = 0; i < count; ++i) {
        // d across the face; d' across the next face upstream, times the ratio of the distances of
        // centres, here to there.
        const bool up = flux[i] > 0.0;
        const auto across = [i](const AcrossFaces& q) { return q.high[i] - q.low[i]; };
        const auto upstream = [&](const AcrossFaces& q) {
            const double behind = face.behind * (q.low[i] - q.far_low[i]);
            const double ahead = face.ahead * (q.far_high[i] - q.high[i]);
            return up ? behind : ahead;
        };
        const double du = across(u), dv = across(v), dw = space ? across(w) : 0.0;
        // r = d . d'/d . d over all components: one limiter, whatever the axes are
        double along = du * upstream(u) + dv * upstream(v), square = du * du + dv * dv;
        if (space) along += dw * upstream(w), square += dw * dw;
        const double r = along / (square + tiny);
        // clamp(2 r/k, 0, 1), by selections that the compiler can vectorise
        double l = two_by_k * r;
        l = l < 1.0 ? l : 1.0;
        l = l > 0.0 ? l : 0.0;
        // From the upwind centre towards the other one: u_f = u_upwind +- l s d
        const double share = up ? face.low * l : -face.high * l;
        carried_u[i] = flux[i] * ((up ? u.low[i] : u.high[i]) + share * du);
        carried_v[i] = flux[i] * ((up ? v.low[i] : v.high[i]) + share * dv);
        if (space) carried_w[i] = flux[i] * ((up ? w.low[i] : w.high[i]) + share * dw);
    }
}

TURBIDITE_ROW_WORK
void carry_in_plane(int count, double two_by_k, const FacePlace& face, const double* flux,
                    const AcrossFaces& u, const AcrossFaces& v, double* carried_u,
                    double* carried_v) {
    if (face.equal)
        carry<false>(count, two_by_k, {}, flux, u, v, v, carried_u, carried_v, nullptr);
    else
        carry<false>(count, two_by_k, face, flux, u, v, v, carried_u, carried_v, nullptr);
}

TURBIDITE_ROW_WORK
void carry_in_space(int count, double two_by_k, const FacePlace& face, const double* flux,
                    const AcrossFaces* u, double* const* carried) {
    if (face.equal)
        carry<true>(count, two_by_k, {}, flux, u[0], u[1], u[2], carried[0], carried[1],
                    carried[2]);
    else
        carry<true>(count, two_by_k, face, flux, u[0], u[1], u[2], carried[0], carried[1],
                    carried[2]);
}

TURBIDITE_ROW_WORK
void carry_blended(int count, double central, const FacePlace& face, const double* __restrict flux,
                   const double* __restrict u0, const double* __restrict u1,
                   const double* __restrict u2, const double* __restrict u3,
                   double* __restrict carried) {
    // Central: u_C + s (u_D - u_C), a mean on equal cells. Biased: u_C + s (d + d')/2, half of the
    // sum since the gradient at C is the mean of those on either side of it.
    const double mean = 0.5 * central, upwind = 1.0 - central;
    const auto [behind, ahead, low, high, equal] = face;  // equal: fewer operations
    for (int i = 0; i < count; ++i) {
        const double d = u2[i] - u1[i];
        const double from_low = equal ? u1[i] + 0.25 * (u2[i] - u0[i])
                                      : u1[i] + 0.5 * low * (d + behind * (u1[i] - u0[i]));
        const double from_high = equal ? u2[i] - 0.25 * (u3[i] - u1[i])
                                       : u2[i] - 0.5 * high * (d + ahead * (u3[i] - u2[i]));
        const double linear = equal ? mean * (u1[i] + u2[i]) : central * (u1[i] + low * d);
        carried[i] = flux[i] * (linear + upwind * (flux[i] > 0.0 ? from_low : from_high));
    }
}

}  // namespace

void convective_flux(int count, double two_by_k, const FacePlace& face, const double* flux,
                     const VelocityAcross& u, const CarriedRows& carried) {
    if (u.size() == 2)
        carry_in_plane(count, two_by_k, face, flux, u[0], u[1], carried[0], carried[1]);
    else
        carry_in_space(count, two_by_k, face, flux, u.begin(), carried.begin());
}

std::optional<double> central_share(const std::string& scheme) {
    if (scheme == "linear") return 1.0;
    if (scheme == "LUST") return 0.75;
    if (scheme == "linearUpwind") return 0.0;
    return std::nullopt;
}

std::optional<double> limiter_of_steps(double k) {
    if (!(k >= 0.0 && k <= 1.0)) return std::nullopt;
    return std::max(k, 1e-15);
}

void blended_flux(int count, double central, const FacePlace& face, const double* flux,
                  const VelocityAcross& u, const CarriedRows& carried) {
    for (int axis = 0; axis < u.size(); ++axis)
        carry_blended(count, central, face, flux, u[axis].far_low, u[axis].low, u[axis].high,
                      u[axis].far_high, carried[axis]);
}

}  // namespace turbidite
