// SPDX-License-Identifier: GPL-2.0-or-later
//
// Discs in LAMMPS, without an adapter: on the communicator of this process alone.
#pragma once

#include <mpi.h>

#include <cmath>
#include <numbers>

#include "granular_adapter/lammps/lammps_md_host.hpp"
#include "tests/unit/md/spring_box.hpp"

namespace turbidite::lammps {

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
          MPI_Comm communicator = MPI_COMM_SELF, const char* shape = "disc") {
        for (const nscd::Body& body : list) bodies.add(body);
        host.join(communicator);
        host.create(settings, {{shape, {}}}, bodies);
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
