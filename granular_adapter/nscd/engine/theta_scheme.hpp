// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The theta-scheme of rigid bodies (Topin 2011, Eqs. 16-18), theta in [1/2, 1].
//
//     M (U^{k+1} - U^k) = dt (theta F^{k+1} + (1 - theta) F^k) + J      Eq. 16, J: contact impulse
//     x^{k+1} = x^k + dt (theta U^{k+1} + (1 - theta) U^k)              Eq. 17
//     U_free = U^k + dt M^-1 (theta F^{k+1} + (1 - theta) F^k)          Eq. 18, free velocity
//     q^k = x^k + dt (1 - theta) U^k                                    detection
//
// Eliminating x gives q^{k+1} = q^k + dt U^{k+1} exactly. The position variable everywhere is q,
// the detection configuration; x is computed only on request. Contacts are written at q for the
// full step: u_n + g(q)/dt >= 0. Loads are constant over a step, so F^k = F^{k+1}, and theta drops
// out of U_free.
//
// theta = 1/2 neither dissipates nor adds energy by itself. With restitution e an impact can add
// energy unless theta <= 1/(1 + e) (Acary 2014).
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::nscd {

/// Throws std::invalid_argument unless 1/2 <= theta <= 1/(1 + restitution).
void check_theta(double theta, double restitution);

/// U_free = U + dt M^-1 (weight + loads), spin alike. Fixed bodies keep their velocity.
std::vector<Twist> free_velocities(const Bodies& bodies, const Vec3& gravity, double step);

/// q <- q + dt U, orientation <- rotation by dt omega; wrapped on periodic axes.
void move(Bodies& bodies, const std::vector<Twist>& velocities, double step,
          const PeriodicBox& box);

/// x of Eq. 17 from the detection configuration q.
Vec3 end_configuration(const Vec3& q, const Vec3& velocity, double step, double theta);

}  // namespace turbidite::nscd
