// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/transport/flux_check.hpp"

#include <algorithm>

namespace turbidite {
namespace {

double largest(const std::vector<double>& values) {
    return *std::max_element(values.begin(), values.end());
}

}  // namespace

FluxCheck::FluxCheck(const BoxLayers& layers)
    : layers_(layers),
      divergence_(layers.nx),
      largest_divergence_(layers.nx),
      largest_outflow_(layers.nx) {}

void FluxCheck::begin() {
    std::fill(largest_divergence_.begin(), largest_divergence_.end(), 0.0);
    std::fill(largest_outflow_.begin(), largest_outflow_.end(), 0.0);
}

void FluxCheck::add(int j, const double* along, const double* below, const double* above,
                    const double* behind, const double* before) {
    const int nx = layers_.nx;
    const double x = 1.0 / layers_.hx, y = 1.0 / layers_.heights.size(j), z = 1.0 / layers_.hz;
    // (phi_right - phi_left)/hx + (phi_above - phi_below)/h_j, and the same along z
    divergence_row(nx, x, along, along + 1, y, below, above, divergence_.data());
    if (behind) subtract_difference(nx, -z, behind, before, divergence_.data());
    keep_largest(nx, divergence_.data(), largest_divergence_.data());
    // By place in the row, so that the loop has no sum or maximum across its cells.
    keep_largest_outflow(nx, {x, along, along + 1}, {y, below, above}, {z, behind, before},
                         largest_outflow_.data());
}

void FluxCheck::add_layer(int j, const double* along, const double* below, const double* above,
                          const double* behind) {
    const int nx = layers_.nx;
    for (int k = 0; k < layers_.nz; ++k) {
        add(j, along, below, above, behind, behind ? behind + nx : nullptr);
        along += nx + 1, below += nx, above += nx;
        if (behind) behind += nx;
    }
}

FluxReport FluxCheck::over(double dt) const {
    // Half of what passes all faces of a cell: what enters also leaves. That is OpenFOAM's CoNum.
    const double courant = 0.5 * dt * largest(largest_outflow_);
    return {largest(largest_divergence_), courant, courant};
}

}  // namespace turbidite
