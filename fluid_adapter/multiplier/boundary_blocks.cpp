// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/boundary_blocks.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace turbidite {

void BoundaryBlocks::factorise(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                               const CollocationPoints& points) {
    points_ = &points;
    factors_.clear();
    tied_.clear();
    images_.resize(points.boundary_points());
    on_slots_.assign(points.slots(), 0.0);
    const double per_mass = 1.0 / field.reference_mass();
    order_points();
    for (int g = 0; g < points.grains(); ++g) {
        factors_.begin_matrix();
        const int rows = points.boundary_begin[g + 1] - points.boundary_begin[g];
        for (int i = 0; i < rows; ++i) add_row(order_of(g), i, per_mass);
        if (!factors_.factorise())
            throw std::runtime_error("the boundary points of grain " +
                                     std::to_string(grains[g].id) +
                                     " depend on each other; use fluid.point_spacing 1.5 or more");
        tied_.push_back(tie(g));
    }
}

/// The order 0, n-1, 1, n-2, ... of every grain's ring, which keeps the profile narrow.
void BoundaryBlocks::order_points() {
    order_.clear();
    for (int g = 0; g < points_->grains(); ++g) {
        int low = points_->boundary_begin[g], high = points_->boundary_begin[g + 1] - 1;
        while (low < high) {
            order_.push_back(low++);
            order_.push_back(high--);
        }
        if (low == high) order_.push_back(low);
    }
}

/// Row i of G: G_pq = sum over shared cells of w_p w_q / m_c.
void BoundaryBlocks::add_row(const int* order, int i, double per_mass) {
    const CollocationPoints& points = *points_;
    const int p = order[i];
    for (int s = points.stencil[p]; s < points.stencil[p + 1]; ++s) {
        const int slot = points.slot[s];
        on_slots_[slot] = points.weight[s] / points.stencilled[slot].volume;
    }
    row_.assign(i + 1, 0.0);
    int first = i;
    for (int j = i; j >= 0; --j) {
        const int q = order[j];
        if (!points.box[p].meets(points.box[q])) continue;
        double sum = 0.0;
        for (int s = points.stencil[q]; s < points.stencil[q + 1]; ++s)
            sum += points.weight[s] * on_slots_[points.slot[s]];
        row_[j] = per_mass * sum;
        if (sum != 0.0) first = j;
    }
    for (int s = points.stencil[p]; s < points.stencil[p + 1]; ++s) on_slots_[points.slot[s]] = 0.0;
    std::copy(row_.begin() + first, row_.end(), factors_.add_row(first));
}

/// T^T G^-1 T with T = [1 0 -r_y; 0 1 r_x] at each point: its entries are products of the columns
/// 1, r_x, r_y with G^-1 of these columns.
Eigen::Matrix3d BoundaryBlocks::tie(int g) {
    const CollocationPoints& points = *points_;
    const int* order = order_of(g);
    const int rows = factors_.size(g);
    columns_.clear();
    for (int i = 0; i < rows; ++i)
        columns_.insert(columns_.end(), {1.0, points.arm_x[order[i]], points.arm_y[order[i]]});
    factors_.solve<3>(g, columns_.data());
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  // (1, r_x, r_y)^T G^-1 (1, r_x, r_y)
    for (int i = 0; i < rows; ++i) {
        const int p = order[i];
        images_[p] = Eigen::Map<const Eigen::Vector3d>(&columns_[3 * i]);
        products += Eigen::Vector3d(1.0, points.arm_x[p], points.arm_y[p]) * images_[p].transpose();
    }
    const double mass = products(0, 0), x = products(0, 1), y = products(0, 2);
    Eigen::Matrix3d tied;
    tied << mass, 0.0, -y,  //
        0.0, mass, x,       //
        -y, x, products(1, 1) + products(2, 2);
    return tied;
}

void BoundaryBlocks::solve(const double* r, double* z) {
    const int n = points_->boundary_points();
    columns_.resize(2 * n);
    for (int g = 0; g < points_->grains(); ++g) {
        const int* order = order_of(g);
        const int rows = factors_.size(g);
        for (int i = 0; i < rows; ++i) {
            columns_[2 * i] = r[order[i]];
            columns_[2 * i + 1] = r[n + order[i]];
        }
        factors_.solve<2>(g, columns_.data());
        for (int i = 0; i < rows; ++i) {
            z[order[i]] = columns_[2 * i];
            z[n + order[i]] = columns_[2 * i + 1];
        }
    }
}

void BoundaryBlocks::subtract_images(const Planar* q, double* z) const {
    double* z_y = z + points_->boundary_points();
    for (int g = 0; g < points_->grains(); ++g)
        for (int p = points_->boundary_begin[g]; p < points_->boundary_begin[g + 1]; ++p) {
            z[p] -= q[g].x() * images_[p][0] - q[g].z() * images_[p][2];
            z_y[p] -= q[g].y() * images_[p][0] + q[g].z() * images_[p][1];
        }
}

}  // namespace turbidite
