// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A soft-sphere code as used by md_adapter: it owns bodies and contacts, and integrates them
// itself, with one of the schemes common to such codes:
//
//     leap-frog          v <- v + (F/m) delta,   x <- x + v delta         delta: one sub-step
//     velocity Verlet    the same with half of the first and of the last impulse, so that x and v
//                        belong to the same time
//
// Bodies are passed in the order of nscd::Bodies, with the host's own positions x.
//
// A host on several ranks may move bodies from one to another in create(), run() and restore():
// migrated() tells it, and migrate() brings along what others keep about each body. Functions
// that are not const, and save(), are then called on all ranks.
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
    /// for moments; may be empty unless requested. [N s], [N m s]
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

    /// Shapes that it can move, names of shapes/shape_list.
    virtual std::vector<std::string> shapes() const { return {"disc"}; }

    /// 2, 3, or both_dimensions (coupler/protocol/hello.hpp).
    virtual std::int32_t dimension() const { return 2; }

    /// Whether its grains meet across cyclic sides.
    virtual bool repeats() const { return false; }

    /// How far velocities are behind positions, in sub-steps: 1 for leap-frog, whose velocities
    /// belong to the middle of a sub-step and positions to its end; 0 for velocity Verlet.
    virtual double velocity_lag() const { return 1.0; }

    /// Creates the bodies, with the given mass and inertia, and the walls of the domain. `shapes`
    /// are those of the run, all of them among shapes().
    virtual void create(const Settings& settings, const ShapeTable& shapes,
                        const nscd::Bodies& bodies) = 0;

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

    /// Whether there are other ranks, with which bodies are exchanged.
    virtual bool shares_bodies() const { return false; }

    /// Whether bodies changed their rank in the last create(), run() or restore(); the same on all
    /// ranks. Reports of that call already have the new order.
    virtual bool migrated() const { return false; }

    /// `rows` has `row_size` bytes for each body that this rank had before; returns those of the
    /// bodies that it has now, in their order.
    virtual std::vector<char> migrate(const std::vector<char>& rows, std::size_t row_size) {
        (void)row_size;
        return rows;
    }

    /// Whether something is true on all ranks.
    virtual bool on_all_ranks(bool here) { return here; }

    /// `ids` of all ranks.
    virtual std::vector<GrainId> from_all_ranks(const std::vector<GrainId>& ids) { return ids; }
};

}  // namespace turbidite
