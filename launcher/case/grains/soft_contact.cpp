// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/soft_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace turbidite {

// x'' + 2 zeta x' + x = 0 from x = 0, x' = 1, time in 1/w, s = sqrt(1 - zeta^2). The force of
// spring and dashpot vanishes where x'' = 0, at s t = atan2(2 zeta s, 2 zeta^2 - 1); there
// x' = -exp(-zeta t), so e = exp(-zeta t).
double restitution_of(double damping) {
    if (damping >= 1.0) return std::exp(-2.0);
    const double s = std::sqrt(1.0 - damping * damping);
    return std::exp(-damping / s * std::atan2(2.0 * damping * s, 2.0 * damping * damping - 1.0));
}

double damping_of(double restitution) {
    if (restitution >= 1.0) return 0.0;
    if (restitution <= restitution_of(1.0)) return 1.0;
    double low = 0.0, high = 1.0;  // restitution falls from low to high
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        // Bisection: no closed form of zeta; 60 halvings are beyond the last digit.
        (restitution_of(middle) > restitution ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

// Largest x, where x' = 0: s t = atan2(s, zeta), x = exp(-zeta t).
double deepest_of(double damping) {
    if (damping >= 1.0) return std::exp(-1.0);
    const double s = std::sqrt(1.0 - damping * damping);
    return std::exp(-damping / s * std::atan2(s, damping));
}

namespace {

// Factors of u_c and of the speed of a fall from the top.
constexpr double wet_speed = 2.0, dry_speed = 2.0;

/// [m/s]
double speed_of_approach(const Settings& settings, double height) {
    const double scale = settings.real("run.velocity_scale");
    if (settings.has("contact.md_speed")) return settings.real("contact.md_speed") * scale;
    if (settings.flag("fluid.enabled")) return wet_speed * scale;
    const double drop = height * settings.real("run.diameter");
    return dry_speed * std::sqrt(2.0 * settings.real("run.gravity") * drop);
}

double stiffness(const Settings& settings, double damping, double height) {
    if (settings.has("contact.md_stiffness")) return settings.real("contact.md_stiffness");
    const double overlap = settings.real("contact.md_overlap");
    const double speed = deepest_of(damping) * speed_of_approach(settings, height);
    const double fall = settings.real("run.gravity") * settings.real("run.diameter");
    // [m g/D]: h/d at rest, (f v)^2/(2 g D d^2) in an impact
    return std::max(height / overlap, speed * speed / (2.0 * fall * overlap * overlap));
}

}  // namespace

SoftContact soft_contact(const Settings& settings, double height) {
    SoftContact contact;
    contact.damping = damping_of(settings.real("contact.restitution"));
    contact.stiffness = stiffness(settings, contact.damping, height);
    // w^2 = 2 stiffness g/D
    contact.frequency = std::sqrt(2.0 * contact.stiffness * settings.real("run.gravity") /
                                  settings.real("run.diameter"));
    contact.contact_time = std::numbers::pi / contact.frequency;
    // contact.md_substeps of them in pi/w, the time of a bounce.
    contact.substeps = std::max(
        std::int64_t{1},
        static_cast<std::int64_t>(std::ceil(settings.real("run.step") / contact.contact_time *
                                            settings.real("contact.md_substeps"))));
    return contact;
}

}  // namespace turbidite
