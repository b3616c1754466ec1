// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Discs, triangles and squares on springs, without an adapter.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "coupler/rigid/vec3.hpp"
#include "coupler/shapes/shape.hpp"
#include "granular_adapter/soft/soft_md_host.hpp"
#include "tests/unit/md/spring_box.hpp"

namespace turbidite::soft {

constexpr double contact_time = std::numbers::pi / frequency;
constexpr double fine = contact_time / 1200.0;  ///< a sub-step [s]

enum Kind : std::int32_t { disc, triangle, square };
inline const ShapeTable all_shapes = {
    {"disc", {}},
    {"triangle", {}},
    {"polygon",
     {std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2,
      std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2,
      std::numbers::sqrt2 / 2, -std::numbers::sqrt2 / 2}}};

inline Settings damped(double zeta) {
    Settings settings = soft_settings();
    settings.set("run.md_damping", zeta);
    return settings;
}

inline Settings heavy(double zeta, double gravity = 1.0) {
    Settings settings = damped(zeta);
    settings.set("run.gravity", gravity);
    return settings;
}

/// Of density 1.5, turned by `angle`; a triangle at angle 0 has its base below, R/2 under its
/// centre.
inline nscd::Body grain(Kind kind, GrainId id, double x, double y, Vec3 velocity = {},
                        double angle = 0.0, double radius = 0.5) {
    const auto shape = make_shape(all_shapes[kind]);
    nscd::Body body;
    body.id = id;
    body.shape = kind;
    body.radius = radius;
    body.density = 1.5;
    body.mass = body.weight_mass = body.density * shape->volume(radius);
    body.inertia = body.density * shape->inertia_per_density(radius)(2, 2);
    body.position = {x, y, 0.0};
    body.orientation = {std::cos(0.5 * angle), 0.0, 0.0, std::sin(0.5 * angle)};
    body.twist.velocity = velocity;
    return body;
}

/// Some grains and their host.
struct Scene {
    Scene(const Settings& settings, const std::vector<nscd::Body>& list,
          const ShapeTable& shapes = all_shapes) {
        for (const nscd::Body& body : list) bodies.add(body);
        host.create(settings, shapes, bodies);
    }

    /// Sub-steps of `step` [s], with the results in `bodies`.
    SubstepReport play(std::int64_t count, double step) {
        return play(count, step, std::vector<Load>(bodies.size()));
    }
    SubstepReport play(std::int64_t count, double step, const std::vector<Load>& loads) {
        SubstepReport report = host.run({count, step, true}, loads);
        host.read(bodies);
        return report;
    }

    Vec3 velocity(std::size_t i) const { return bodies.twist[i].velocity; }
    double spin(std::size_t i) const { return bodies.twist[i].spin[2]; }

    double kinetic_energy() const {
        double energy = 0.0;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            energy += 0.5 * bodies.mass[i] * dot(velocity(i), velocity(i)) +
                      0.5 * bodies.inertia[i].zz * spin(i) * spin(i);
        return energy;
    }

    Vec3 momentum() const {
        Vec3 sum{};
        for (std::size_t i = 0; i < bodies.size(); ++i) sum = sum + bodies.mass[i] * velocity(i);
        return sum;
    }

    /// About a point.
    double angular_momentum(const Vec3& about = {}) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < bodies.size(); ++i)
            sum += bodies.inertia[i].zz * spin(i) +
                   bodies.mass[i] * cross_z(bodies.position[i] - about, velocity(i));
        return sum;
    }

    SoftMdHost host;
    nscd::Bodies bodies;
};

}  // namespace turbidite::soft
