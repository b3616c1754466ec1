// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Step 5 of the splitting (Topin 2011, Eqs. 9-10 restricted to mass terms and multipliers) as a
// system for the multiplier impulses L = dt lambda [N s/m], one per point and component:
//
//     m_c (u - u3)      = - B^T L                 every cell, m_c = rho_f V_c
//     cM  (U - U45)     =   T^T L - J_h           every grain; J_h: impulse already announced
//     cI  (omega - ...) =   R^T L - K_h
//     B u - T U - R omega = 0                     every point
//
// Velocities eliminated, with s the slip of the velocities that L = 0 leaves:
//
//     S L = s,    S = B B^T / m_c + T T^T / (cM) + R R^T / (cI)   symmetric, positive for c > 0
//
// Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/constraint_operator.hpp"

namespace turbidite {

class SaddlePoint {
 public:
    /// Takes a new window: grains, their points, the fluid after step 3. All are kept by reference.
    void assemble(FluidField& field, const std::vector<ImmersedGrain>& grains,
                  const CollocationPoints& points);

    int rows() const { return 2 * points_->size(); }
    FluidField& field() const { return *field_; }
    const std::vector<ImmersedGrain>& grains() const { return *grains_; }
    const CollocationPoints& points() const { return *points_; }

    /// s, the right-hand side [m/s].
    void initial_slip(double* slip);

    /// y = S w.
    void apply(const double* w, double* y);

    /// Velocities and impulses that belong to L; writes u of touched cells into the field.
    void impose(const double* impulses);

    /// Sum over all ranks of a_i b_i over points.
    double dot(const double* a, const double* b) const;

    /// Number of points on all ranks.
    double points_everywhere() const;

    const std::vector<Planar>& motions() const { return motions_; }  ///< U, omega after impose
    const std::vector<Planar>& impulses() const { return sums_; }    ///< T^T L, R^T L

    /// For solvers that know U already: the same as `impose`, without the products.
    std::vector<Planar>& motions() { return motions_; }
    std::vector<Planar>& impulses() { return sums_; }

    /// Adds up rows of grains held by several ranks, one row (a fixed-size vector) per grain. Called
    /// by every rank, also by one that holds no grain.
    template <class Row>
    void sum_over_holders(std::vector<Row>& rows) const {
        double* first = rows.empty() ? nullptr : rows.front().data();
        field_->sum_over_holders(ids_.data(), static_cast<int>(ids_.size()), first,
                                 static_cast<int>(Row::SizeAtCompileTime));
    }

 private:
    void clear_touched();
    void share(double* cells) const;

    FluidField* field_ = nullptr;
    const std::vector<ImmersedGrain>* grains_ = nullptr;
    const CollocationPoints* points_ = nullptr;
    std::vector<double> cells_x_, cells_y_;  // B^T of something, by local cell
    std::vector<Planar> motions_;
    std::vector<Planar> sums_;
    std::vector<GrainId> ids_;
};

}  // namespace turbidite
