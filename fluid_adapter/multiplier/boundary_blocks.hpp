// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The diagonal blocks of the saddle-point operator, one per grain. With G = B m^-1 B^T restricted
// to the boundary points of one grain on this rank (the same for x and y) and factorised exactly,
//
//     tied inertia        T^T G^-1 T       inertia of the fluid that moves with the boundary points
//
// The effective inertia of a grain, which relates an impulse to the change of velocity it causes,
// is A plus the tied inertia. It is exact for a grain that shares no fluid cell with the boundary
// points of another grain or rank.
//
// A row of G is one boundary point. Only points close to each other share cells, and the points go
// round the grain. They are therefore ordered alternately from both ends of the ring: neighbours on
// the ring stay close in the matrix, whose profile is narrow. Valid C++17.
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

    /// z = G^-1 r, grain by grain; r and z are point vectors as in boundary_operator.hpp.
    void solve(const double* r, double* z);

    /// z -= G^-1 T q, with one q = (x, y, spin) per grain.
    void subtract_images(const Planar* q, double* z) const;

    /// T^T G^-1 T of this rank's points, one 3 x 3 matrix per grain [kg, kg m, kg m2 per unit
    /// length].
    const std::vector<Eigen::Matrix3d>& tied_inertia() const { return tied_; }

 private:
    void order_points();
    const int* order_of(int g) const { return order_.data() + points_->boundary_begin[g]; }
    void add_row(const int* order, int i, double per_mass);
    Eigen::Matrix3d tie(int g);

    const CollocationPoints* points_ = nullptr;
    ProfileCholesky factors_;
    std::vector<int> order_;  // row of a grain's matrix -> boundary point
    // Of one point: weight over relative cell volume, by slot; zero between uses.
    std::vector<double> on_slots_;
    std::vector<double> row_;              // of the matrix being assembled
    std::vector<double> columns_;          // right-hand sides of one grain
    std::vector<Eigen::Vector3d> images_;  // G^-1 of the columns 1, r_x, r_y; by point
    std::vector<Eigen::Matrix3d> tied_;
};

}  // namespace turbidite
