// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/row_work.hpp"

#include <cmath>

namespace turbidite {

TURBIDITE_ROW_WORK
void mean_flux(int count, RowShares s, const double* __restrict low, const double* __restrict high,
               double kept, const double* __restrict extra, double* __restrict face) {
    // Between equal cells the mean; one half is exact, so that both forms give the same bits.
    const bool equal = s.equal;
    for (int i = 0; i < count; ++i) {
        const double mean = equal ? s.low * (low[i] + high[i]) : s.low * low[i] + s.high * high[i];
        face[i] = mean + kept * extra[i];
    }
}

TURBIDITE_ROW_WORK
void divergence_row(int count, double x, const double* __restrict left,
                    const double* __restrict right, double y, const double* __restrict below,
                    const double* __restrict above, double* __restrict out) {
    for (int i = 0; i < count; ++i) out[i] = x * (right[i] - left[i]) + y * (above[i] - below[i]);
}

TURBIDITE_ROW_WORK
void add_divergence_row(int count, double x, const double* __restrict left,
                        const double* __restrict right, double y, const double* __restrict below,
                        const double* __restrict above, double* __restrict out) {
    for (int i = 0; i < count; ++i) out[i] += x * (right[i] - left[i]) + y * (above[i] - below[i]);
}

TURBIDITE_ROW_WORK
void advance_row(int count, const double* __restrict in, double x, const double* __restrict left,
                 const double* __restrict right, double y, const double* __restrict below,
                 const double* __restrict above, double* __restrict out) {
    for (int i = 0; i < count; ++i)
        out[i] = in[i] + (x * (right[i] - left[i]) + y * (above[i] - below[i]));
}

TURBIDITE_ROW_WORK
void correct(int count, double step, const double* __restrict low, const double* __restrict high,
             const double* in, double* out) {
    for (int i = 0; i < count; ++i) out[i] = in[i] - step * (high[i] - low[i]);
}

TURBIDITE_ROW_WORK
void correct_across(int count, RowShares s, const double* __restrict below,
                    const double* __restrict here, const double* __restrict above, const double* in,
                    double* out) {
    const bool equal = s.equal;
    for (int i = 0; i < count; ++i)
        out[i] = equal ? in[i] - s.low * (above[i] - below[i])
                       : in[i] - s.low * (here[i] - below[i]) - s.high * (above[i] - here[i]);
}

TURBIDITE_ROW_WORK
void projected_flux(int count, RowShares s, const double* __restrict low,
                    const double* __restrict high, double kept, const double* __restrict extra,
                    double step, const double* __restrict p_low, const double* __restrict p_high,
                    double* __restrict face) {
    for (int i = 0; i < count; ++i)
        face[i] =
            s.low * low[i] + s.high * high[i] + kept * extra[i] - step * (p_high[i] - p_low[i]);
}

TURBIDITE_ROW_WORK
void excess_of(int count, RowShares s, const double* __restrict face, const double* __restrict low,
               const double* __restrict high, double* __restrict extra) {
    for (int i = 0; i < count; ++i) extra[i] = face[i] - (s.low * low[i] + s.high * high[i]);
}

TURBIDITE_ROW_WORK
void keep_largest(int count, const double* __restrict value, double* __restrict largest) {
    for (int i = 0; i < count; ++i) {
        const double size = std::abs(value[i]);
        largest[i] = largest[i] < size ? size : largest[i];
    }
}

TURBIDITE_ROW_WORK
void keep_largest_outflow(int count, FacesOfRow x, FacesOfRow y, FacesOfRow z,
                          double* __restrict largest) {
    const auto through = [](const FacesOfRow& faces, int i) {
        return faces.per_size * (std::abs(faces.low[i]) + std::abs(faces.high[i]));
    };
    const bool space = z.low != nullptr;
    for (int i = 0; i < count; ++i) {
        double sum = through(x, i) + through(y, i);
        if (space) sum += through(z, i);
        largest[i] = largest[i] < sum ? sum : largest[i];
    }
}

TURBIDITE_ROW_WORK
void add_second_difference(int count, double share, const double* __restrict low,
                           const double* __restrict here, const double* __restrict high,
                           double* __restrict out) {
    for (int i = 0; i < count; ++i) out[i] += share * (low[i] - 2.0 * here[i] + high[i]);
}

TURBIDITE_ROW_WORK
void central_divergence_row(int count, double x, const double* __restrict left,
                            const double* __restrict right, const ThreeRows& y,
                            const double* __restrict below, const double* __restrict here,
                            const double* __restrict above, double* __restrict out) {
    // Of equal rows `middle` is zero and low = -high.
    const auto [low, middle, high, equal] = y;
    for (int i = 0; i < count; ++i)
        out[i] = x * (right[i] - left[i]) +
                 (equal ? high * (above[i] - below[i])
                        : low * below[i] + middle * here[i] + high * above[i]);
}

TURBIDITE_ROW_WORK
void laplacian_row(int count, double x, RowShares s, const double* __restrict below,
                   const double* __restrict u, const double* __restrict above,
                   double* __restrict out) {
    const bool equal = s.equal;
    for (int i = 0; i < count; ++i)
        out[i] = x * (u[i - 1] - 2.0 * u[i] + u[i + 1]) +
                 (equal ? s.low * (below[i] - 2.0 * u[i] + above[i])
                        : s.low * (below[i] - u[i]) + s.high * (above[i] - u[i]));
}

TURBIDITE_ROW_WORK
void weighted_difference(int count, RowShares s, const double* __restrict w,
                         const double* __restrict low, const double* __restrict here,
                         const double* __restrict high, double* __restrict out) {
    const bool equal = s.equal;
    for (int i = 0; i < count; ++i)
        out[i] = w[i] * (equal ? low[i] - 2.0 * here[i] + high[i]
                               : s.high * (high[i] - here[i]) - s.low * (here[i] - low[i]));
}

TURBIDITE_ROW_WORK
void add_differences(int count, double x, const double* __restrict left,
                     const double* __restrict here_x, const double* __restrict right, RowShares s,
                     const double* __restrict below, const double* __restrict here_y,
                     const double* __restrict above, double* __restrict out) {
    const bool equal = s.equal;
    // What s.low (below - here) + s.high (above - here) takes of `here`
    const double here = -s.low - s.high;
    for (int i = 0; i < count; ++i) {
        const double along = x * (left[i] - 2.0 * here_x[i] + right[i]);
        out[i] = equal ? out[i] + (along + s.low * (below[i] - 2.0 * here_y[i] + above[i]))
                       : out[i] + along + (s.low * below[i] + here * here_y[i] + s.high * above[i]);
    }
}

TURBIDITE_ROW_WORK
void next_direction(int count, const double* __restrict z, double beta, double* __restrict d) {
    if (beta == 0.0)
        for (int i = 0; i < count; ++i) d[i] = z[i];
    else
        for (int i = 0; i < count; ++i) d[i] = z[i] + beta * d[i];
}

TURBIDITE_ROW_WORK
void kept_row(int count, const double* __restrict w_low, const double* __restrict w_high,
              const double* e, double* out) {
    for (int i = 0; i < count; ++i) {
        // A face keeps part of its excess if one of its cells is outside grains.
        const double w = w_low[i] > w_high[i] ? w_low[i] : w_high[i];
        out[i] = w * e[i];
    }
}

TURBIDITE_ROW_WORK
void add_row(int count, double share, const double* __restrict change, double* __restrict u) {
    for (int i = 0; i < count; ++i) u[i] += share * change[i];
}

TURBIDITE_ROW_WORK
double sum_row(int count, const double* __restrict a) {
    // Eight partial sums, so that the plain and the AVX2 version add in the same order.
    constexpr int lanes = 8;
    double sums[lanes] = {};
    int i = 0;
    for (; i + lanes <= count; i += lanes)
        for (int k = 0; k < lanes; ++k) sums[k] += a[i + k];
    for (; i < count; ++i) sums[0] += a[i];
    double sum = 0.0;
    for (const double part : sums) sum += part;
    return sum;
}

TURBIDITE_ROW_WORK
double dot_row(int count, const double* __restrict a, const double* __restrict b) {
    constexpr int lanes = 8;
    double sums[lanes] = {};
    int i = 0;
    for (; i + lanes <= count; i += lanes)
        for (int k = 0; k < lanes; ++k) sums[k] += a[i + k] * b[i + k];
    for (; i < count; ++i) sums[0] += a[i] * b[i];
    double sum = 0.0;
    for (const double part : sums) sum += part;
    return sum;
}

TURBIDITE_ROW_WORK
void combine(std::size_t count, double new_share, double* __restrict u, double share,
             const double* __restrict v) {
    for (std::size_t i = 0; i < count; ++i) u[i] = new_share * u[i] + share * v[i];
}

TURBIDITE_ROW_WORK
void combine(std::size_t count, double new_share, double* __restrict u, double share_v,
             const double* __restrict v, double share_w, const double* __restrict w) {
    for (std::size_t i = 0; i < count; ++i)
        u[i] = new_share * u[i] + share_v * v[i] + share_w * w[i];
}

TURBIDITE_ROW_WORK
void stage_row(int count, const StageRows& stage, const double* __restrict in, double x,
               const double* __restrict left, const double* __restrict right, double y,
               const double* __restrict below, const double* __restrict above,
               double* __restrict out) {
    const auto [old, fresh, rate, v, now, before] = stage;
    for (int i = 0; i < count; ++i)
        out[i] = old * v[i] +
                 fresh * (in[i] + (x * (right[i] - left[i]) + y * (above[i] - below[i]))) +
                 rate * (now[i] - before[i]);
}

TURBIDITE_ROW_WORK
void extrapolate(int count, double share, const double* __restrict flux, double* __restrict last,
                 double* __restrict held) {
    for (int i = 0; i < count; ++i) {
        held[i] = (1.0 + share) * flux[i] - share * last[i];
        last[i] = flux[i];
    }
}

TURBIDITE_ROW_WORK
void subtract_difference(int count, double share, const double* __restrict low,
                         const double* __restrict high, double* __restrict carried) {
    for (int i = 0; i < count; ++i) carried[i] -= share * (high[i] - low[i]);
}

}  // namespace turbidite
