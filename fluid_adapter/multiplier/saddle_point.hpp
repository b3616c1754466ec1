// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 of the splitting (Topin 2011, Eqs. 9-10 restricted to mass terms and multipliers) as a
// system for the multiplier impulses L = dt lambda [N s/m] of the boundary points:
//
//     m_c (u - u3)        = - B^T L            cells that no grain covers, m_c = rho_f V_c
//     A U                 =   P + J + T^T L    every grain with the fluid it covers
//     B u - T U           =   0                every boundary point; U = (U, omega)
//
// Interior points are eliminated (covered_fluid.hpp), so A and P hold the covered fluid. J are
// impulses that come in addition: under `joint` those of the contacts. Velocities eliminated,
//
//     S L = s,    S = B m^-1 B^T + T A^-1 T^T,   s the slip that L = 0 leaves
//
// symmetric and positive whenever every A is, also for grains as light as the fluid. Preconditioned
// by its blocks of one grain (boundary_blocks.hpp), exact unless grains or ranks share cells.
//
// The sequence is assemble, then push and uzawa_cg as often as needed, then impose. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/boundary_blocks.hpp"
#include "fluid_adapter/multiplier/boundary_operator.hpp"
#include "fluid_adapter/multiplier/covered_fluid.hpp"

namespace turbidite {

class SaddlePoint {
 public:
    /// Takes a new window: grains, their points, the fluid after step 3. All are kept by reference.
    void assemble(FluidField& field, const std::vector<ImmersedGrain>& grains,
                  const CollocationPoints& points);

    /// Adds impulses to the grains: (x, y, moment) [N s/m, N s]. Every rank that holds a grain
    /// gives the same.
    void push(const std::vector<Planar>& impulses);

    /// Velocities and impulses of the present L. Writes u into the field; to be called once, last.
    void impose();

    /// U, omega of every grain for the present L.
    const std::vector<Planar>& motions() const { return motions_; }

    /// dt lambda over every grain and its moment, all its points together; after impose.
    const std::vector<Planar>& impulses() const { return impulses_; }

    /// A + T^T G^-1 T: what an impulse on one grain has to move.
    const std::vector<Eigen::Matrix3d>& effective_inertia() const { return effective_; }

    // For uzawa_cg:

    int rows() const { return 2 * points_->boundary_points(); }

    /// The slip that is left, s - S L [m/s].
    std::vector<double>& slip() { return slip_; }

    /// y = S w.
    void apply(const double* w, double* y);

    /// z = the inverse of S's blocks times r.
    void precondition(const double* r, double* z);

    /// L += w.
    void add(const std::vector<double>& w);

    /// Sum over all ranks of a_i b_i over points.
    double dot(const double* a, const double* b) const;

    /// Number of boundary points on all ranks.
    double points_everywhere() const;

 private:
    void number_cells();
    void sum_interiors();
    void factorise();
    void move_grains();
    void spread(const double* values);
    void share_sums();
    void import_velocity();

    /// Adds up rows of grains held by several ranks, one row (a fixed-size vector) per grain.
    /// Called by every rank, also by one that holds no grain.
    template <class Row>
    void sum_over_holders(std::vector<Row>& rows) const {
        double* first = rows.empty() ? nullptr : rows.front().data();
        field_->sum_over_holders(first, static_cast<int>(Row::SizeAtCompileTime));
    }

    FluidField* field_ = nullptr;
    const std::vector<ImmersedGrain>* grains_ = nullptr;
    const CollocationPoints* points_ = nullptr;
    std::vector<GrainId> ids_;
    std::vector<CellSums> sums_;
    std::vector<Eigen::Matrix3d> inverse_;    // A^-1
    std::vector<Eigen::Matrix3d> effective_;  // A + T^T G^-1 T
    std::vector<Eigen::Matrix3d> inverse_effective_;
    std::vector<Planar> momentum_;  // P + J
    std::vector<Planar> motions_, impulses_;
    BoundaryBlocks blocks_;
    std::vector<double> multipliers_, slip_;
    std::vector<PlaneVector> cells_;         // m^-1 B^T of something, by slot
    std::vector<double> per_mass_;           // 1/m_c, by slot
    std::vector<int> border_;                // slots of cells that other ranks know too
    std::vector<double> share_x_, share_y_;  // by local cell, for these; zero between windows
    std::vector<Planar> by_grain_;
};

}  // namespace turbidite
