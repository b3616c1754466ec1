// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/engine/theta_scheme.hpp"

#include <stdexcept>
#include <string>

namespace turbidite::nscd {
void check_theta(double theta, double restitution) {
    if (!(theta >= 0.5 && theta <= 1.0))
        throw std::invalid_argument("theta = " + std::to_string(theta) +
                                    " must be in [0.5, 1]; below 0.5 the scheme is unstable");
    // theta <= 1/(1 + e) keeps impacts from creating energy. With e = 1, theta = 1/2 must pass
    // however the division rounds.
    const double most = 1.0 / (1.0 + restitution);
    if (theta > most * (1.0 + 1e-12))
        throw std::invalid_argument(
            "theta = " + std::to_string(theta) + " creates energy with restitution " +
            std::to_string(restitution) + ": at most 1/(1 + e) = " + std::to_string(most));
}

std::vector<Twist> free_velocities(const Bodies& bodies, const Vec3& gravity, double step) {
    // Topin 2011, Eq. 18: U_free = U + dt M^-1 (theta F^{k+1} + (1 - theta) F^k), with F constant
    // over the step. Where a fluid is present the weight is that of `weight_mass`, less the
    // displaced fluid.
    std::vector<Twist> free = bodies.twist;
    for (std::size_t i = 0; i < free.size(); ++i) {
        const Vec3 load = bodies.weight_mass[i] * gravity + bodies.force[i];
        // U + dt M^-1 F
        free[i].velocity = free[i].velocity + step * bodies.inverse_mass(i) * load;
        free[i].spin = free[i].spin + step * bodies.inverse_inertia(i) * bodies.torque[i];
    }
    return free;
}

void move(Bodies& bodies, const std::vector<Twist>& velocities, double step,
          const PeriodicBox& box) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        // q + dt U
        bodies.position[i] = box.wrap(bodies.position[i] + step * velocities[i].velocity);
        bodies.orientation[i] = rotated(bodies.orientation[i], step * velocities[i].spin);
    }
}

Vec3 end_configuration(const Vec3& q, const Vec3& velocity, double step, double theta) {
    return q - step * (1.0 - theta) * velocity;  // x of Eq. 17
}

}  // namespace turbidite::nscd
