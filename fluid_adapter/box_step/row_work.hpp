// SPDX-License-Identifier: GPL-2.0-or-later
//
// The inner loops of box_step.cpp: one row each, without sides or branches, so that the compiler
// can vectorise them. They are also compiled for AVX2, and the version is selected at program start
// by the features of the processor; selecting by processor name would leave unknown models with the
// plain code. Without fused operations both versions give the same bits. Face i of a row lies
// between cells i - 1 and i.
//
// Rows below and above may have other heights (row_heights.hpp), and count with shares of their
// own; where these are equal, so are the rows, and a difference takes fewer operations. Valid
// C++17.
#pragma once

#include <cstddef>

namespace turbidite {

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define TURBIDITE_ROW_WORK __attribute__((target_clones("avx2", "default")))
#else
#define TURBIDITE_ROW_WORK
#endif

/// What the values on either side of a face, or the differences below and above a row, count for.
struct RowShares {
    double low, high;
    bool equal;  ///< the rows around are of the same height, and so are the shares
};

/// Of cells of the same size.
inline constexpr RowShares halves{0.5, 0.5, true}, ones{1.0, 1.0, true};

/// face[i] = s.low low[i] + s.high high[i] + kept extra[i]; of equal rows s is 1/2
void mean_flux(int count, RowShares s, const double* low, const double* high, double kept,
               const double* extra, double* face);

/// out[i] = x (right[i] - left[i]) + y (above[i] - below[i])
void divergence_row(int count, double x, const double* left, const double* right, double y,
                    const double* below, const double* above, double* out);

/// out[i] += x (right[i] - left[i]) + y (above[i] - below[i])
void add_divergence_row(int count, double x, const double* left, const double* right, double y,
                        const double* below, const double* above, double* out);

/// out[i] = in[i] - step (high[i] - low[i]); out may alias in
void correct(int count, double step, const double* low, const double* high, const double* in,
             double* out);

/// out[i] = in[i] + x (right[i] - left[i]) + y (above[i] - below[i])
void advance_row(int count, const double* in, double x, const double* left, const double* right,
                 double y, const double* below, const double* above, double* out);

/// out[i] = in[i] - s.low (here[i] - below[i]) - s.high (above[i] - here[i]); out may alias in
void correct_across(int count, RowShares s, const double* below, const double* here,
                    const double* above, const double* in, double* out);

/// face[i] = s.low low[i] + s.high high[i] + kept extra[i] - step (p_high[i] - p_low[i])
void projected_flux(int count, RowShares s, const double* low, const double* high, double kept,
                    const double* extra, double step, const double* p_low, const double* p_high,
                    double* face);

/// extra[i] = face[i] - (s.low low[i] + s.high high[i])
void excess_of(int count, RowShares s, const double* face, const double* low, const double* high,
               double* extra);

/// largest[i] = max(largest[i], |value[i]|)
void keep_largest(int count, const double* value, double* largest);

/// The faces of a row of cells normal to one axis, and 1/h along it.
struct FacesOfRow {
    double per_size;
    const double *low, *high;
};

/// largest[i] = max(largest[i], sum over the axes of (|low| + |high|)/h); z.low is null in the
/// plane
void keep_largest_outflow(int count, FacesOfRow x, FacesOfRow y, FacesOfRow z, double* largest);

/// What three rows, one above the other, count for.
struct ThreeRows {
    double below, here, above;
    bool equal;  ///< they are of the same height: `here` is zero
};

/// out[i] = x (right[i] - left[i]) + y.below below[i] + y.here here[i] + y.above above[i], where
/// the sum of y is zero
void central_divergence_row(int count, double x, const double* left, const double* right,
                            const ThreeRows& y, const double* below, const double* here,
                            const double* above, double* out);

/// out[i] = x (u[i-1] - 2 u[i] + u[i+1]) + s.low (below[i] - u[i]) + s.high (above[i] - u[i])
void laplacian_row(int count, double x, RowShares s, const double* below, const double* u,
                   const double* above, double* out);

/// out[i] += share (low[i] - 2 here[i] + high[i])
void add_second_difference(int count, double share, const double* low, const double* here,
                           const double* high, double* out);

/// out[i] = w[i] (s.high (high[i] - here[i]) - s.low (here[i] - low[i])); of equal rows s is 1
void weighted_difference(int count, RowShares s, const double* w, const double* low,
                         const double* here, const double* high, double* out);

/// out[i] += x (left[i] - 2 here_x[i] + right[i])
///           + s.low (below[i] - here_y[i]) + s.high (above[i] - here_y[i])
void add_differences(int count, double x, const double* left, const double* here_x,
                     const double* right, RowShares s, const double* below, const double* here_y,
                     const double* above, double* out);

/// d[i] = z[i] + beta d[i]; d is not read if beta = 0
void next_direction(int count, const double* z, double beta, double* d);

/// out[i] = max(w_low[i], w_high[i]) e[i]; out may be e
void kept_row(int count, const double* w_low, const double* w_high, const double* e, double* out);

/// u[i] += share change[i]
void add_row(int count, double share, const double* change, double* u);

/// sum of a[i], in an order that does not depend on the processor
double sum_row(int count, const double* a);

/// sum of a[i] b[i], in the same order
double dot_row(int count, const double* a, const double* b);

/// u[i] = new_share u[i] + share v[i]
void combine(std::size_t count, double new_share, double* u, double share, const double* v);

/// u[i] = new_share u[i] + share_v v[i] + share_w w[i]
void combine(std::size_t count, double new_share, double* u, double share_v, const double* v,
             double share_w, const double* w);

/// What a row takes part in, of the shares of a stage (velocity_stage.hpp).
struct StageRows {
    double old, fresh, rate;
    const double *v, *now, *before;
};

/// out[i] = old v[i] + fresh (in[i] + x (right[i] - left[i]) + y (above[i] - below[i]))
///          + rate (now[i] - before[i])
void stage_row(int count, const StageRows& stage, const double* in, double x, const double* left,
               const double* right, double y, const double* below, const double* above,
               double* out);

/// held[i] = (1 + share) flux[i] - share last[i]; last[i] = flux[i]
void extrapolate(int count, double share, const double* flux, double* last, double* held);

/// carried[i] -= share (high[i] - low[i])
void subtract_difference(int count, double share, const double* low, const double* high,
                         double* carried);

}  // namespace turbidite
