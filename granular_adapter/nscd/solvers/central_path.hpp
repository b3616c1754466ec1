// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Follows the curve of a PathSystem from z = 1 to z -> 0. Where friction makes the problem
// non-monotone the curve turns back in z and later forward again, so its length is the parameter,
// not z: relative changes of all factors count. Which way is on says the sign of the determinant of
// the linear equations, which changes at every turn. A step is
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

    PathSystem system_;
    PathPoint point_;
    double length_ = 0.1;  ///< of the next step, in relative changes
    int corrections_ = 0;  ///< of the last step
    std::int64_t factorisations_ = 0;
};

}  // namespace turbidite::nscd
