// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Path following for the interior-point method: follows the curves of a PathSystem to a solution,
// in three stages:
//
//     z: 1 -> 1e-2    associated, hence convex: a central path without turning points
//     s: 1 -> 0       to Coulomb's law, still smooth enough that turning points are rare
//     z: 1e-2 -> 0    to the exact law
//
// Where friction makes the problem non-monotone, a curve can turn back in its parameter and later
// turn forward again. The curve is therefore parametrised by its length, in which the relative
// changes of all factors count. The determinant of the linear equations changes its sign at every
// turning point; its sign tells the direction in which to continue. A step consists of
//
//     a second-order predictor, as long as the products stay positive and near tau z;
//     Newton corrections across the curve until they are near tau z again,
//
// and is repeated with less than half the length if the corrections do not converge.
#pragma once

#include <cstdint>

#include "granular_adapter/nscd/solvers/plane/path_system.hpp"

namespace turbidite::nscd {

class CentralPath {
 public:
    /// `size` as in PathSystem. Keeps a reference to the contacts, which must outlive it.
    CentralPath(const ScaledContacts& contacts, double size);

    /// One step, with about `budget` factorisations at most. False if the path ends: by rounding,
    /// by the budget, or because no step length converges.
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
    double length_;           ///< of the next step, as a relative change of the factors
    int corrections_ = 0;     ///< of the last step
    std::int64_t factorisations_ = 0;
};

}  // namespace turbidite::nscd
