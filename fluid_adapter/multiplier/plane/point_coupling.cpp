// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/point_coupling.hpp"

#include <algorithm>

namespace turbidite {
namespace {

constexpr int nobody = -1, several = -2, is_private = -1;

}  // namespace

void PointCoupling::begin(const FluidField& field, const CollocationPoints& points) {
    links_.clear();
    per_mass_.clear();
    border_.clear();
    row_.clear();
    entries_.clear();
    find_shared(field, points);
    for (int p = 0; p < points.boundary_points(); ++p)
        for (int s = points.stencil[p]; s < points.stencil[p + 1]; ++s)
            if (const int cell = shared_[points.slot[s]]; cell != is_private)
                links_.push_back({p, cell, points.weight[s]});
    cells_.resize(per_mass_.size());
}

void PointCoupling::find_shared(const FluidField& field, const CollocationPoints& points) {
    user_.assign(points.slots(), nobody);
    for (int g = 0; g < points.grains(); ++g)
        for (int s = points.stencil[points.boundary_begin[g]];
             s < points.stencil[points.boundary_begin[g + 1]]; ++s) {
            int& user = user_[points.slot[s]];
            // Once `several`, always: g is never negative.
            user = user == nobody || user == g ? g : several;
        }
    shared_.assign(points.slots(), is_private);
    // On one rank only cells of several grains are shared.
    const bool border = field.has_halo();
    for (int slot = 0; slot < points.slots(); ++slot) {
        const StencilCell& at = points.stencilled[slot];
        // A cell that another rank knows may be used by points there.
        if (user_[slot] == several || (border && field.shares(at.cell)))
            shared_[slot] = number(field, at);
    }
}

/// The next number, for this cell.
int PointCoupling::number(const FluidField& field, const StencilCell& at) {
    const int next = static_cast<int>(per_mass_.size());
    if (field.has_halo() && field.shares(at.cell)) border_.push_back({next, at.cell});
    per_mass_.push_back(1.0 / (field.reference_mass() * at.volume));
    return next;
}

void PointCoupling::apply(const FluidField& field, const double* w, double* y) {
    // y = G_private w + B_s m_s^-1 (B_s^T w), the bracket summed over the ranks.
    std::fill(cells_.begin(), cells_.end(), PlaneVector{});
    for (const Link& link : links_) {
        cells_[link.cell].x += link.weight * w[2 * link.point];
        cells_[link.cell].y += link.weight * w[2 * link.point + 1];
    }
    // Collective: called without shared cells too.
    sums_.sum(field, border_, cells_.data());
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        cells_[c].x *= per_mass_[c];
        cells_[c].y *= per_mass_[c];
    }
    // Writes y; the shared part is added to it.
    apply_private(w, y);
    for (const Link& link : links_) {
        y[2 * link.point] += link.weight * cells_[link.cell].x;
        y[2 * link.point + 1] += link.weight * cells_[link.cell].y;
    }
}

/// Entries stand for both triangles.
void PointCoupling::apply_private(const double* w, double* y) const {
    const int points = static_cast<int>(row_.size());
    for (int p = 0; p < points; ++p) {
        const Entry* at = entries_.data() + row_[p];
        const Entry* end = entries_.data() + (p + 1 < points ? row_[p + 1] : entries_.size());
        const double wx = w[2 * p], wy = w[2 * p + 1];
        double x = at->value * wx, y_of_p = at->value * wy;  // of the point itself
        for (++at; at != end; ++at) {
            x += at->value * w[2 * at->point];
            y_of_p += at->value * w[2 * at->point + 1];
            y[2 * at->point] += at->value * wx;
            y[2 * at->point + 1] += at->value * wy;
        }
        // Rows have earlier points only, so y of p is set before a later row adds to it.
        y[2 * p] = x;
        y[2 * p + 1] = y_of_p;
    }
}

}  // namespace turbidite
