// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/solvers/plane/central_path.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite::nscd {
namespace {

constexpr double predicted = 0.9;    ///< deviation allowed after a prediction
constexpr double corrected = 0.3;    ///< deviation allowed at the end of a step
constexpr double least_left = 0.02;  ///< fraction of a factor that a prediction must leave
constexpr double least_z = 1e-3;     ///< the same for z
constexpr int most_corrections = 4;
constexpr double stalling = 0.9;  ///< reduction of the deviation that counts as none
constexpr int shortenings = 40, trials = 14;
// End of the convex stage. With a smaller value, the changes with s are no longer smooth, and
// curves in s have turning points; with a larger one, more is left to the last stage
// (docs/decisions/contact-solvers.md).
constexpr double convex_z = 1e-2;
// |s| that one correction can reduce to zero.
constexpr double nearly_coulomb = 0.02;
constexpr double first_length = 0.1;
// Below this product, in the units of PathSystem::product, velocities are rounding.
constexpr double least_product = 5e-15;

}  // namespace

/// About the base point; lengths are relative changes.
struct CentralPath::Prediction {
    PathChange tangent;     ///< per change of ln z or s
    PathChange correction;  ///< towards the curve, across the tangent
    PathChange first, second;
};

CentralPath::CentralPath(const ScaledContacts& contacts, double size)
    : system_(contacts, size), point_(system_.start()), length_(first_length) {}

bool CentralPath::linearise() {
    ++factorisations_;
    return system_.linearise(point_);
}

CentralPath::Prediction CentralPath::prediction() {
    Prediction p;
    p.tangent = system_.tangent();
    const double square = system_.dot(point_, p.tangent, p.tangent);
    // Without its part along the tangent, so that `length` alone says how far a step goes.
    const auto across = [&](PathChange change) {
        add(change, -system_.dot(point_, p.tangent, change) / square, p.tangent);
        return change;
    };
    p.correction = across(system_.correction());
    p.first = p.tangent;
    // first = -sign(det J) t/|t|, of unit length: towards smaller z or s, and on through a turning
    // point, where the determinant and the direction of the parameter change together.
    add(p.first, -1.0 - system_.sign() / std::sqrt(square), p.tangent);
    p.second = across(system_.curvature(p.first));
    return p;
}

/// Shortens the step until its end is near the curve.
bool CentralPath::predict(const PathPoint& base, const Prediction& p) {
    for (int k = 0; k < shortenings; ++k, length_ *= 0.7) {
        // x(l) = x_0 + correction + l first + l^2/2 second
        PathChange change = p.correction;
        add(change, length_, p.first);
        add(change, 0.5 * length_ * length_, p.second);
        // The series says nothing about the curve where a factor or z would nearly vanish, or s
        // would pass below zero.
        if (!(base.z + change.z > least_z * base.z) ||
            base.association + change.association < -nearly_coulomb ||
            !(system_.decrease(base, change) < 1.0 - least_left))
            continue;
        point_ = base;
        add(point_, 1.0, change);
        if (system_.deviation(point_) < predicted) return true;
    }
    return false;
}

bool CentralPath::correct(const PathPoint& base, const PathChange& tangent, std::int64_t budget) {
    double before = 1.0;
    for (corrections_ = 0;; ++corrections_) {
        const double deviation = system_.deviation(point_);
        if (deviation < corrected) return true;
        if (corrections_ == most_corrections || factorisations_ >= budget ||
            (corrections_ > 1 && !(deviation < stalling * before)) || !linearise())
            return false;
        before = deviation;
        PathChange change = system_.correction();
        const PathChange along = system_.tangent();
        // A Newton step at constant z and s, moved along the curve until it is normal to the
        // tangent at the base: at a turning point there may be no solution at this z.
        add(change, -system_.dot(base, tangent, change) / system_.dot(base, tangent, along), along);
        const double most =
            std::max(system_.decrease(point_, change), std::abs(change.z / point_.z));
        // No factor, nor z, loses more than nine tenths.
        add(point_, std::min(1.0, 0.9 / most), change);
    }
}

void CentralPath::enter_next_stage(std::int64_t budget) {
    if (associated_ && point_.z <= convex_z) {
        associated_ = false;
        system_.follow(PathParameter::association);
        length_ = first_length;
    } else if (system_.parameter() == PathParameter::association &&
               point_.association <= nearly_coulomb && reach_coulomb(budget)) {
        length_ = first_length;
    }
}

/// Corrects onto the curve with s = 0 and continues in z. False if that does not converge; then
/// nothing has changed.
bool CentralPath::reach_coulomb(std::int64_t budget) {
    // The point of the last step with s = 0 and the same z is near the curve in z under Coulomb's
    // law.
    const PathPoint base = point_;
    point_.association = 0.0;
    system_.follow(PathParameter::products);
    if (linearise()) {
        const PathChange change = system_.correction(), tangent = system_.tangent();
        add(point_, std::min(1.0, 0.9 / system_.decrease(point_, change)), change);
        if (correct(base, tangent, budget)) return true;
    }
    system_.follow(PathParameter::association);
    point_ = base;
    return false;
}

bool CentralPath::advance(std::int64_t budget) {
    if (factorisations_ >= budget || system_.product(point_) < least_product || !linearise())
        return false;
    const PathPoint base = point_;
    Prediction p = prediction();
    for (int trial = 0; trial < trials && factorisations_ <= budget; ++trial) {
        const double length = length_;
        const bool ready = predict(base, p);
        if (ready && correct(base, p.tangent, budget)) {
            length_ *= corrections_ < 2 ? 2.5 : corrections_ == 2 ? 1.3 : 0.7;
            enter_next_stage(budget);
            return true;
        }
        if (!ready && trial > 0) break;
        // The base is near the curve; without the correction, so is the end of a short enough step.
        // All zero, of the size of a change.
        p.correction = p.first;
        add(p.correction, -1.0, p.first);
        length_ = ready ? 0.4 * length_ : length;
    }
    point_ = base;
    return false;
}

}  // namespace turbidite::nscd
