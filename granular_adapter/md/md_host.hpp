// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A soft-sphere code as md_adapter drives it: it owns bodies and contacts, and steps them by
// itself. Its integrator is the leap-frog that such codes share:
//
//     v <- v + (F/m) delta,   x <- x + v delta         delta: one sub-step
//
// Bodies are given and taken in the order of nscd::Bodies, with the host's own positions x.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupler/participant/adapter.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"

namespace turbidite {

/// What acts on a body beside gravity and contacts, the same over a window.
struct Load {
    Vec3 force{};   ///< [N]
    Vec3 torque{};  ///< [N m]
};

struct Substeps {
    std::int64_t count = 1;
    double step = 0.0;      ///< delta [s]
    bool detailed = false;  ///< impulses body by body and contacts one by one are wanted
};

/// What the host saw over the sub-steps of one window.
struct SubstepReport {
    std::int64_t contacts = 0;     ///< with a force at the end
    double max_penetration = 0.0;  ///< deepest overlap at any probe, >= 0 [m]
    /// Sum over the sub-steps of delta times all forces but gravity, one per body, moments alike;
    /// only if wanted. [N s], [N m s]
    std::vector<Vec3> impulses, angular_impulses;
    /// After the last sub-step, impulses being its forces times the window; only if wanted.
    std::vector<ContactRecord> touching;
};

class MdHost {
 public:
    virtual ~MdHost() = default;

    /// "YADE 2023.02a".
    virtual std::string code() const = 0;

    /// Builds the bodies, with mass and inertia as they are given, and the walls of the domain.
    virtual void create(const Settings& settings, const nscd::Bodies& bodies) = 0;

    /// Positions, orientations and velocities.
    virtual void read(nscd::Bodies& bodies) const = 0;
    virtual void write(const nscd::Bodies& bodies) = 0;

    virtual SubstepReport run(const Substeps& substeps, const std::vector<Load>& loads) = 0;

    /// Takes away the bodies whose entry is zero.
    virtual void keep(const std::vector<std::uint8_t>& mask) = 0;

    /// Bodies and contacts, springs included; restore() follows create() with the same settings.
    virtual SavedState save() const = 0;
    virtual void restore(const SavedState& state) = 0;
};

}  // namespace turbidite
