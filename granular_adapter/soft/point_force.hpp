// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The force at one contact point with overlap g > 0 and slip s, for the mass m of its spring:
//
//     N = max(0, k g - c v_n)               k = m w^2, c = 2 zeta m w
//     T = -a (k s + c v_t), |T| <= mu N     s' = v_t, a: SoftLaw::tangential_share
//
// v_n and v_t are the relative velocity of b at the point, along the normal and along the contact:
// in the plane along the tangent (-n_y, n_x), in space a vector, with which s is turned into the
// present tangent plane. Where Coulomb's law limits T, the spring is set back so that spring and
// dashpot together give the limit.
//
// At the point of a body of mass M and moment I an impulse along the normal n changes the velocity
// of the point as if it had the mass M/(1 + (r x n)^2 M/I), r the arm. A disc has r x n = 0, and
// along the tangent a third of its mass, so that both directions take the same time. A polygon has
// neither: the corner of an equilateral triangle that stands on its tip has M across and M/5 along
// the contact, at the end of a side that lies flat M/4 and M/2. With half a spring at each point
// (overlaps.hpp) its bounces last between 0.7 and 1.4 pi/w across and between 1.1 and 1.7 pi/w
// along the contact; a side that lands flat on both points takes pi/w and 1.2 pi/w.
#pragma once

#include "granular_adapter/md/soft_law.hpp"
#include "granular_adapter/soft/overlaps.hpp"

namespace turbidite::soft {

struct PointForce {
    Vec3 on_b{};          ///< -on_b on a [N]
    bool pushes = false;  ///< N > 0
    bool slides = false;  ///< |T| = mu N
};

/// At the end of a sub-step of length `step` [s] with the bodies' velocities, by which the slip
/// [m] is advanced: in the plane its first component, along the tangent, in space the vector.
PointForce point_force(const SoftLaw& law, const Overlap& overlap, const nscd::Bodies& bodies,
                       double step, Vec3& slip);

}  // namespace turbidite::soft
