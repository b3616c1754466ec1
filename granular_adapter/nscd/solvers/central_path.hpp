// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Follows the curves of a PathSystem to a solution, in three stages:
//
//     z: 1 -> 1e-2    associated, hence convex: a central path without turns
//     s: 1 -> 0       to Coulomb's law, still smooth enough that turns are rare
//     z: 1e-2 -> 0    to the exact law
//
// Where friction makes the problem non-monotone a curve turns back in its parameter and later
// forward again, so its length is the parameter: relative changes of all factors count. The sign of
// the determinant of the linear equations, which changes at every turn, says which direction leads
// on. A step is
//
//     second-order prediction, as long as products stay positive and near tau z;
//     Newton corrections across the curve until they are
//
// and is taken again with less than half the length where corrections do not converge.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/solvers/path_system.hpp"

namespace turbidite::nscd {

class CentralPath {
 public:
    /// `size` as in PathSystem. Keeps a reference: the contacts must live as long.
    CentralPath(const ScaledContacts& contacts, double size);

    /// One step, with not much more than `budget` factorisations in all. False at the end of the
    /// way: rounding, budget, or no step that converges.
    bool advance(std::int64_t budget);

    const PathPoint& point() const { return point_; }
    std::int64_t factorisations() const { return factorisations_; }

 private:
    struct Prediction;

    bool linearise();
    Prediction prediction();
    bool predict(const PathPoint& base, const Prediction& prediction);
    bool correct(const PathPoint& base, const PathChange& tangent, std::int64_t budget);
    void enter_next_stage(std::int64_t budget);
    bool reach_coulomb(std::int64_t budget);

    PathSystem system_;
    PathPoint point_;
    bool associated_ = true;  ///< first stage
    double length_;           ///< of the next step, in relative changes
    int corrections_ = 0;     ///< of the last step
    std::int64_t factorisations_ = 0;
};

}  // namespace turbidite::nscd
