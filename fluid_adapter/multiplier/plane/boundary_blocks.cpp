// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/boundary_blocks.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace turbidite {

void BoundaryBlocks::factorise(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                               const CollocationPoints& points, PointCoupling& coupling) {
    points_ = &points;
    factors_.clear();
    tied_.clear();
    images_.resize(points.boundary_points());
    on_slots_.assign(points.slots(), 0.0);
    on_private_.assign(points.slots(), 0.0);
    // 1/m_c = per_mass / (relative volume of the cell), which `mark` divides by
    const double per_mass = 1.0 / field.reference_mass();
    for (int g = 0; g < points.grains(); ++g) {
        factors_.begin_matrix();
        const int begin = points.boundary_begin[g];
        meets_image_ = meets_image(field.grid(), g);
        for (int p = begin; p < points.boundary_begin[g + 1]; ++p)
            add_row(begin, p, per_mass, coupling);
        if (!factors_.factorise())
            throw std::runtime_error(
                "the boundary points of grain " + std::to_string(grains[g].id) +
                " are linearly dependent; use fluid.point_spacing 1.5 or more");
        tied_.push_back(tie(g));
    }
}

/// Whether the stencils of a grain reach round a cyclic axis, so that points far apart share cells.
bool BoundaryBlocks::meets_image(const CellGrid& grid, int g) const {
    const auto begin = points_->box.begin() + points_->boundary_begin[g];
    const auto end = points_->box.begin() + points_->boundary_begin[g + 1];
    if (begin == end) return false;
    // Boxes are not wrapped, so the extent of all of them shows a turn.
    StencilBox all = *begin;
    for (auto box = begin; box != end; ++box)
        all = {std::min(all.low_x, box->low_x), std::max(all.high_x, box->high_x),
               std::min(all.low_y, box->low_y), std::max(all.high_y, box->high_y)};
    return (grid.cyclic(0) && all.high_x - all.low_x >= grid.counts[0]) ||
           (grid.cyclic(1) && all.high_y - all.low_y >= grid.counts[1]);
}

/// G_pq = sum over shared cells of w_p w_q / m_c.
void BoundaryBlocks::add_row(int begin, int p, double per_mass, PointCoupling& coupling) {
    const CollocationPoints& points = *points_;
    mark(p, coupling);
    coupling.begin_row();
    // From the diagonal to the left: `first` ends as the leftmost entry, where the profile begins.
    row_.assign(p - begin + 1, 0.0);
    int first = p;
    for (int q = p; q >= begin; --q) {
        if (!meets_image_ && !points.box[p].meets(points.box[q])) continue;
        const double all = per_mass * overlap(on_slots_, q);
        // The block has all cells of the pair; the coupling only the private ones, since the
        // product with the shared ones goes through cells (PointCoupling::apply).
        const double own = uses_shared_ ? per_mass * overlap(on_private_, q) : all;
        row_[q - begin] = all;
        if (all != 0.0) first = q;
        if (own != 0.0 || q == p) coupling.add(q, own);
    }
    // What `mark` has set, one by one: the vectors have the slots of all grains.
    for (int s = points.stencil[p]; s < points.stencil[p + 1]; ++s)
        on_slots_[points.slot[s]] = on_private_[points.slot[s]] = 0.0;
    std::copy(row_.begin() + (first - begin), row_.end(), factors_.add_row(first - begin));
}

void BoundaryBlocks::mark(int p, const PointCoupling& coupling) {
    uses_shared_ = false;
    for (int s = points_->stencil[p]; s < points_->stencil[p + 1]; ++s) {
        const int slot = points_->slot[s];
        const bool shared = coupling.shared(slot);
        on_slots_[slot] = points_->weight[s] / points_->stencilled[slot].volume;
        on_private_[slot] = shared ? 0.0 : on_slots_[slot];
        uses_shared_ = uses_shared_ || shared;
    }
}

double BoundaryBlocks::overlap(const std::vector<double>& on_slots, int p) const {
    double sum = 0.0;
    for (int s = points_->stencil[p]; s < points_->stencil[p + 1]; ++s)
        sum += points_->weight[s] * on_slots[points_->slot[s]];
    return sum;
}

/// T^T G^-1 T with T = [1 0 -r_y; 0 1 r_x] at each point: its entries are products of the columns
/// 1, r_x, r_y with G^-1 of these columns.
Eigen::Matrix3d BoundaryBlocks::tie(int g) {
    const CollocationPoints& points = *points_;
    const int begin = points.boundary_begin[g], rows = factors_.size(g);
    columns_.clear();
    for (int p = begin; p < begin + rows; ++p)
        columns_.insert(columns_.end(), {1.0, points.arm_x[p], points.arm_y[p]});
    factors_.solve<3>(g, columns_.data());
    Eigen::Matrix3d products = Eigen::Matrix3d::Zero();  // (1, r_x, r_y)^T G^-1 (1, r_x, r_y)
    for (int i = 0; i < rows; ++i) {
        const int p = begin + i;
        images_[p] = Eigen::Map<const Eigen::Vector3d>(&columns_[3 * i]);
        products += Eigen::Vector3d(1.0, points.arm_x[p], points.arm_y[p]) * images_[p].transpose();
    }
    const double mass = products(0, 0), x = products(0, 1), y = products(0, 2);
    Eigen::Matrix3d tied;
    // G acts on x and y separately, so that with <a, b> = a^T G^-1 b
    // T^T G^-1 T = [<1,1> 0 -<1,r_y>; 0 <1,1> <1,r_x>; -<1,r_y> <1,r_x> <r_x,r_x> + <r_y,r_y>]
    tied << mass, 0.0, -y,  //
        0.0, mass, x,       //
        -y, x, products(1, 1) + products(2, 2);
    return tied;
}

void BoundaryBlocks::solve(const double* r, double* z) {
    std::copy_n(r, 2 * points_->boundary_points(), z);
    // x and y are two right-hand sides of one matrix.
    for (int g = 0; g < points_->grains(); ++g)
        factors_.solve<2>(g, z + 2 * points_->boundary_begin[g]);
}

void BoundaryBlocks::subtract_images(const Planar* q, double* z) const {
    for (int g = 0; g < points_->grains(); ++g)
        for (int p = points_->boundary_begin[g]; p < points_->boundary_begin[g + 1]; ++p) {
            // T q = (q_x - q_s r_y, q_y + q_s r_x), with G^-1 of 1, r_x and r_y from `tie`
            z[2 * p] -= q[g].x() * images_[p][0] - q[g].z() * images_[p][2];
            z[2 * p + 1] -= q[g].y() * images_[p][0] + q[g].z() * images_[p][1];
        }
}

}  // namespace turbidite
