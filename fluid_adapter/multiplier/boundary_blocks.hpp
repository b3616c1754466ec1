// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The boundary points of one grain by themselves: with G = B m^-1 B^T over a grain's points on this
// rank (the same for x and y), factorised exactly,
//
//     tied inertia        T^T G^-1 T       the fluid that the points drag along with the grain
//
// and A plus the tied inertia is what an impulse on the grain moves: its effective inertia, exact
// for a grain that shares no fluid cell with the points of another grain or rank. Two points share
// cells only if they are near, and points go round the grain: taken alternately from both ends of
// the ring, neighbours are near each other in the matrix, whose profile is then narrow.
// Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/collocation_points.hpp"
#include "fluid_adapter/multiplier/profile_cholesky.hpp"

namespace turbidite {

class BoundaryBlocks {
 public:
    /// Throws std::runtime_error naming the grain whose points are linearly dependent.
    void factorise(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                   const CollocationPoints& points);

    /// z = G^-1 r, grain by grain; point vectors as in boundary_operator.hpp.
    void solve(const double* r, double* z);

    /// z -= G^-1 T q, one q per grain.
    void subtract_images(const Planar* q, double* z) const;

    /// T^T G^-1 T of this rank's points.
    const std::vector<Eigen::Matrix3d>& tied_inertia() const { return tied_; }

 private:
    void order_points();
    const int* order_of(int g) const { return order_.data() + points_->boundary_begin[g]; }
    void add_row(const int* order, int i, double per_mass);
    Eigen::Matrix3d tie(int g);

    const CollocationPoints* points_ = nullptr;
    ProfileCholesky factors_;
    std::vector<int> order_;               // rows of the grains' matrices -> points
    std::vector<double> on_slots_;         // weights of one point by slot; zero between uses
    std::vector<double> row_;              // of the matrix that is being assembled
    std::vector<double> columns_;          // right-hand sides of one grain
    std::vector<Eigen::Vector3d> images_;  // G^-1 of (1, r_x, r_y), by point
    std::vector<Eigen::Matrix3d> tied_;
};

}  // namespace turbidite
