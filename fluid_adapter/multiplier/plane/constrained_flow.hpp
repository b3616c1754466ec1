// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A velocity of fluid and grains that is being made to satisfy the constraint of step 5: right-hand
// side and solution of saddle_operator.hpp. With W the map from a velocity and momenta of the
// grains to the constrained velocity,
//
//     (u, U) = W(u3, P)
//
// begin takes u3 and P, push adds impulses to P, uzawa_cg finds L, and impose writes u. Since W is
// linear, all but begin may follow in any order and number: what is imposed is the starting point
// of what follows, and the constrained change of another flow can be added. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/constraint.hpp"
#include "fluid_adapter/multiplier/plane/saddle_operator.hpp"

namespace turbidite {

class ConstrainedFlow {
 public:
    /// Begins with u3, kept by reference, and the grains' own momenta (immersed_grain.hpp), without
    /// the fluid they cover. By every rank. `prescribed`: the motions of grains that have A^-1 = 0,
    /// zero for others.
    void begin(SaddleOperator& system, const VelocityPointers& velocity,
               const std::vector<Planar>& momenta, const std::vector<Planar>& prescribed);

    /// Begins with a change of velocity, and grains that have no momentum of their own and, where
    /// their motion is prescribed, no change of it.
    void begin(SaddleOperator& system, const VelocityPointers& change);

    /// Adds impulses to the grains: (x, y, moment) [N s/m, N s]. All ranks that hold a grain must
    /// pass the same values.
    void push(const std::vector<Planar>& impulses);

    /// Writes u for the present L into the velocity it began with.
    void impose();

    /// Momenta, motions, impulses and slip as numbers, for `add` of another flow.
    void copy_to(GrainChange& change) const;

    /// What `share` times a constrained change does to them. The caller adds the change of the
    /// velocity itself.
    void add(const GrainChange& change, double share);

    /// U, omega of every grain for the present L.
    const std::vector<Planar>& motions() const { return motions_; }

    /// Sum of dt lambda over all points of a grain, and its moment [N s/m, N s]; of all that was
    /// imposed.
    const std::vector<Planar>& impulses() const { return impulses_; }

    // For uzawa_cg:

    SaddleOperator& system() { return *system_; }

    /// The remaining slip, s - S L [m/s].
    std::vector<double>& slip() { return slip_; }

    /// L += w.
    void add(const Multipliers& w);

 private:
    void find_border();
    void sum_momenta();
    void move_grains();
    void spread_multipliers();
    void import_velocity();
    void expect_velocity(int slot) const;
    const CollocationPoints& points() const { return system_->points(); }
    FluidField& field() const { return system_->field(); }

    SaddleOperator* system_ = nullptr;
    VelocityPointers velocity_{};
    std::vector<Planar> momentum_;    // P + J, and what was imposed
    std::vector<Planar> prescribed_;  // motions that no impulse changes
    std::vector<Planar> motions_, impulses_;
    Multipliers multipliers_;  // since the last impose
    std::vector<double> slip_;
    std::vector<PlaneVector> cells_;  // u before the multipliers, later their change of it, by slot
    std::vector<BorderValue> border_;  // slots of cells that other ranks know too
    BorderSums border_sums_;
    std::vector<Planar> by_grain_;
};

}  // namespace turbidite
