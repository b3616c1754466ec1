// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A soft-sphere code as used by md_adapter: it owns bodies and contacts, and integrates them
// itself, with the leap-frog scheme common to such codes:
//
//     v <- v + (F/m) delta,   x <- x + v delta         delta: one sub-step
//
// Bodies are passed in the order of nscd::Bodies, with the host's own positions x.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/participant/adapter.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite {

/// Loads on a body other than gravity and contacts, constant over a window.
struct Load {
    Vec3 force{};   ///< [N]
    Vec3 torque{};  ///< [N m]
};

struct Substeps {
    std::int64_t count = 1;
    double step = 0.0;      ///< delta [s]
    bool detailed = false;  ///< whether impulses by body and individual contacts are requested
};

/// Results of the sub-steps of one window.
struct SubstepReport {
    std::int64_t contacts = 0;     ///< with a force in the last sub-step
    double max_penetration = 0.0;  ///< largest overlap found by the host's probes, >= 0 [m]
    /// Sum over the sub-steps of delta times all forces except gravity, one per body, and the same
    /// for moments; only if requested. [N s], [N m s]
    std::vector<Vec3> impulses, angular_impulses;
    /// Contacts after the last sub-step, their impulses being its forces times the window; only if
    /// requested.
    std::vector<ContactRecord> touching;
};

class MdHost {
 public:
    virtual ~MdHost() = default;

    /// Name and version of the code, e.g. "YADE 2023.02a".
    virtual std::string code() const = 0;

    /// Creates the bodies, with the given mass and inertia, and the walls of the domain.
    virtual void create(const Settings& settings, const nscd::Bodies& bodies) = 0;

    /// Reads positions, orientations and velocities.
    virtual void read(nscd::Bodies& bodies) const = 0;
    virtual void write(const nscd::Bodies& bodies) = 0;

    virtual SubstepReport run(const Substeps& substeps, const std::vector<Load>& loads) = 0;

    /// Removes the bodies whose entry is zero.
    virtual void keep(const std::vector<std::uint8_t>& mask) = 0;

    /// Bodies and contacts, springs included; restore() is called after create() with the same
    /// settings.
    virtual SavedState save() const = 0;
    virtual void restore(const SavedState& state) = 0;
};

}  // namespace turbidite
