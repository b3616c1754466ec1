// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The map W from changes of the fluid's velocity to what grains let through of them
// (multiplier/constraint.hpp). W is symmetric in the product of momenta, the kinetic energy of
// fluid and grains, and positive. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/box_step/box_operators.hpp"
#include "fluid_adapter/multiplier/constraint.hpp"

namespace turbidite {

/// A change of the fluid's velocity made rigid, and what it does to the grains.
struct RigidChange {
    VelocityRows u;  ///< over the rank's cells [m/s]
    GrainChange grains;
};

/// Arrays over the rank's cells that pressure and viscosity use one after the other: neither needs
/// anything of them from one of its corrections to the next.
struct CorrectionWork {
    RigidChange change;
    VelocityRows images;
};

class RigidGrains {
 public:
    /// `constraint`: of this window, imposed on its velocity; kept by reference.
    RigidGrains(Constraint& constraint, const VelocityPointers& velocity, std::size_t cells)
        : constraint_(constraint), velocity_(velocity), cells_(cells) {}

    /// change <- W change. The slip is reduced by the factor `reduction`.
    void make_rigid(RigidChange& change, double reduction);

    /// The same with the change of the fluid's velocity left pending, to be made by whoever reads
    /// the velocity next; `change` must stay as it is until then.
    void add_later(const RigidChange& change, double share);

    /// The change that is pending, for a caller that makes it.
    PendingChange take_pending();

    /// change <- keep change + other.
    void combine(RigidChange& change, double keep, const RigidChange& other) const;

    /// The window's velocity, of fluid and grains, += share change.
    void add(const RigidChange& change, double share);

    /// Removes the slip that changes have left in the window's velocity; returns what remains.
    MultiplierResult settle();

    void sum_over_ranks(double* values, int count) const {
        constraint_.sum_over_ranks(values, count);
    }

    /// Of the window, with what is pending made unless it was taken.
    VelocityPointers velocity();

    /// Iterations of all solves so far, and whether all of them converged.
    std::int64_t iterations() const { return iterations_; }
    bool converged() const { return converged_; }

 private:
    void note(const MultiplierResult& result);

    Constraint& constraint_;
    VelocityPointers velocity_;
    PendingChange pending_;
    std::size_t cells_;
    std::int64_t iterations_ = 0;
    bool converged_ = true;
};

}  // namespace turbidite
