// SPDX-License-Identifier: GPL-2.0-or-later
//
// Discs in LAMMPS, without an adapter: on the communicator of this process alone.
#pragma once

#include <mpi.h>

#include <cmath>
#include <numbers>

#include "granular_adapter/lammps/lammps_md_host.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite::lammps {

constexpr double frequency = 300.0;  ///< w [1/s]

/// Box of 20 x 10 with walls and an open top, without gravity; undamped.
inline Settings soft_settings() {
    Settings settings = box_settings();
    settings.set("domain.top", std::string("free"));
    settings.set("run.size_x", 20.0), settings.set("run.size_y", 10.0);
    settings.set("run.gravity", 0.0);
    settings.set("run.md_frequency", frequency), settings.set("run.md_damping", 0.0);
    settings.set("run.md_substeps", std::int64_t{60});
    settings.set("contact.md_substeps", 20.0);
    settings.set("coupling.md_hold", true);
    return settings;
}

/// Moves along x with `speed`.
inline nscd::Body disc(GrainId id, double x, double y, Vec3 velocity = {}, double radius = 0.5) {
    nscd::Body body;
    body.id = id;
    body.radius = radius;
    body.density = 1.5;
    body.mass = std::numbers::pi * radius * radius * body.density;
    body.inertia = 0.5 * body.mass * radius * radius;
    body.weight_mass = body.mass;
    body.position = {x, y, 0.0};
    body.twist.velocity = velocity;
    return body;
}

/// Some discs and their host.
struct Scene {
    Scene(const Settings& settings, const std::vector<nscd::Body>& list,
          MPI_Comm communicator = MPI_COMM_SELF) {
        for (const nscd::Body& body : list) bodies.add(body);
        host.join(communicator);
        host.create(settings, {{"disc", {}}}, bodies);
    }

    /// Sub-steps of `step` [s], with the results in `bodies`.
    SubstepReport play(std::int64_t count, double step) {
        SubstepReport report = host.run({count, step, true}, std::vector<Load>(bodies.size()));
        host.read(bodies);
        return report;
    }

    LammpsMdHost host;
    nscd::Bodies bodies;
};

}  // namespace turbidite::lammps
