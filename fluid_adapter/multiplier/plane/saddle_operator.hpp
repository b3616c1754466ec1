// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 of the splitting (Topin 2011, Eqs. 9-10 restricted to mass terms and multipliers) as a
// saddle-point system for the multiplier impulses L = dt lambda [N s/m] at the boundary points:
//
//     m_c (u - u3)        = - B^T L            cells that no grain covers, m_c = rho_f V_c
//     A U                 =   P + J + T^T L    every grain with the fluid it covers
//     B u - T U           =   0                every boundary point; U = (U, omega)
//
// The interior multipliers are already eliminated (covered_fluid.hpp), so A and P include the
// covered fluid. J are additional impulses; under `joint` those of the contacts. Eliminating the
// velocities gives
//
//     S L = s,    S = B m^-1 B^T + T A^-1 T^T,    s: the slip B u3 - T A^-1 (P + J) at L = 0
//
// A grain of prescribed motion has A^-1 = 0: its U is given, and what holds it takes T^T L + J.
//
// S is symmetric, and positive whenever every A is, also for grains as light as the fluid. The
// preconditioner is S restricted to one grain at a time (boundary_blocks.hpp), which is exact
// unless grains or ranks share cells.
//
// Here is S, which depends on where grains and points are; right-hand sides and solutions are in
// constrained_flow.hpp. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/plane/boundary_blocks.hpp"
#include "fluid_adapter/multiplier/plane/boundary_operator.hpp"
#include "fluid_adapter/multiplier/plane/covered_fluid.hpp"
#include "fluid_adapter/multiplier/plane/point_coupling.hpp"

namespace turbidite {

/// Multipliers and what they do to the grains: kept together, so that sums of them need no sum over
/// points and ranks.
struct Multipliers {
    std::vector<double> values;     ///< point vector [N s/m]
    std::vector<Planar> on_grains;  ///< T^T values, of all ranks

    void assign_zero(int rows, std::size_t grains) {
        values.assign(rows, 0.0);
        on_grains.assign(grains, Planar::Zero());
    }
};

class SaddleOperator {
 public:
    /// Begins a window with the grains and their points, all kept by reference. By every rank.
    /// Throws std::runtime_error naming a grain that ties too little fluid.
    void assemble(FluidField& field, const std::vector<ImmersedGrain>& grains,
                  const CollocationPoints& points);

    int rows() const { return 2 * points_->boundary_points(); }
    std::size_t grains() const { return grains_->size(); }
    FluidField& field() const { return *field_; }
    const CollocationPoints& points() const { return *points_; }

    /// A^-1, by grain.
    const std::vector<Eigen::Matrix3d>& inverse_inertia() const { return inverse_; }

    /// A + T^T G^-1 T: the effective inertia of each grain; zero where its motion is prescribed.
    const std::vector<Eigen::Matrix3d>& effective_inertia() const { return effective_; }

    /// y = S w.
    void apply(const Multipliers& w, double* y);

    /// z = the inverse of S's blocks times r.
    void precondition(const double* r, Multipliers& z);

    /// sum_i a_i b_i over the points of all ranks.
    double dot(const double* a, const double* b) const;

    /// Number of boundary points on all ranks.
    double points_everywhere() const;

    /// Sums per-grain data over the ranks that hold the grain; one fixed-size vector per grain.
    /// Called by every rank, also by one that holds no grain.
    template <class Row>
    void sum_over_holders(std::vector<Row>& rows) const {
        double* first = rows.empty() ? nullptr : rows.front().data();
        field_->sum_over_holders(first, static_cast<int>(Row::SizeAtCompileTime));
    }

 private:
    void sum_bodies();
    void factorise();
    void hold(std::size_t g);

    FluidField* field_ = nullptr;
    const std::vector<ImmersedGrain>* grains_ = nullptr;
    const CollocationPoints* points_ = nullptr;
    std::vector<GrainId> ids_;
    std::vector<Eigen::Matrix3d> body_;       // A
    std::vector<Eigen::Matrix3d> inverse_;    // A^-1
    std::vector<Eigen::Matrix3d> tied_;       // T^T G^-1 T
    std::vector<Eigen::Matrix3d> effective_;  // A + it
    std::vector<Eigen::Matrix3d> inverse_effective_;
    BoundaryBlocks blocks_;
    PointCoupling coupling_;
    std::vector<CellSums> sums_;
    std::vector<Planar> by_grain_;
};

}  // namespace turbidite
