// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The diagonal blocks of the saddle-point operator, one per grain. With G = B m^-1 B^T restricted
// to the boundary points of one grain on this rank (the same for x and y) and factorised exactly,
//
//     tied inertia        T^T G^-1 T       inertia of the fluid that moves with the boundary points
//
// and A plus the tied inertia is what an impulse on the grain moves: its effective inertia, exact
// for a grain that shares no fluid cell with the points of another grain or rank. Two points share
// cells only if they are near, and the order of the points (collocation_points.hpp) makes them near
// in the matrix too, whose profile is then narrow.
// Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/plane/collocation_points.hpp"
#include "fluid_adapter/multiplier/plane/planar.hpp"
#include "fluid_adapter/multiplier/plane/point_coupling.hpp"
#include "fluid_adapter/multiplier/plane/profile_cholesky.hpp"

namespace turbidite {

class BoundaryBlocks {
 public:
    /// Fills in the coupling's rows on the way, whose products are the same but for shared cells.
    /// Throws std::runtime_error naming the grain whose points are linearly dependent.
    void factorise(const FluidField& field, const std::vector<ImmersedGrain>& grains,
                   const CollocationPoints& points, PointCoupling& coupling);

    /// z = G^-1 r, grain by grain; r and z are point vectors as in boundary_operator.hpp.
    void solve(const double* r, double* z);

    /// z -= G^-1 T q, with one q = (x, y, spin) per grain.
    void subtract_images(const Planar* q, double* z) const;

    /// T^T G^-1 T of this rank's points, one 3 x 3 matrix per grain [kg, kg m, kg m2 per unit
    /// length].
    const std::vector<Eigen::Matrix3d>& tied_inertia() const { return tied_; }

 private:
    void add_row(int begin, int p, double per_mass, PointCoupling& coupling);
    bool meets_image(const CellGrid& grid, int g) const;
    void mark(int p, const PointCoupling& coupling);
    double overlap(const std::vector<double>& on_slots, int p) const;
    Eigen::Matrix3d tie(int g);

    const CollocationPoints* points_ = nullptr;
    ProfileCholesky factors_;
    // Weights of one point over the cells' volumes, by slot; zero between uses.
    std::vector<double> on_slots_;
    std::vector<double> on_private_;       // the same without shared cells
    bool uses_shared_ = false;             // the point does
    bool meets_image_ = false;             // the grain does, across a cyclic side
    std::vector<double> row_;              // of the matrix that is being assembled
    std::vector<double> columns_;          // right-hand sides of one grain
    std::vector<Eigen::Vector3d> images_;  // G^-1 of the columns 1, r_x, r_y; by point
    std::vector<Eigen::Matrix3d> tied_;
};

}  // namespace turbidite
