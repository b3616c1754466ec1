// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact engine acting on YADE's bodies in a user's own script: no coupling, no MPI. Motions
// and loads are read from YADE before each contact problem, and motions are written back after the
// move, so that whatever a script does to a body in between takes effect. YADE's body ids are the
// engine's grain ids and the keys of its walls. Where bodies move in the plane, that of the engine
// is z = 0, wherever YADE's bodies lie.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "granular_adapter/nscd/engine/engine.hpp"
#include "granular_adapter/yade/bodies/turn.hpp"
#include "granular_adapter/yade/bodies/yade_bodies.hpp"
#include "granular_adapter/yade/hosted_walls.hpp"
#include "granular_adapter/yade/overlap.hpp"
#include "granular_adapter/yade/scene_watch.hpp"

namespace turbidite::yade {

/// The contents of a scene, in the engine's terms.
struct Layout {
    int dimension = 2;
    ShapeTable shapes;
    std::vector<double> frictions;   ///< mu by material of bodies and walls
    std::vector<nscd::Body> bodies;  ///< their motions are read from `states`
    BodyStates states;               ///< of `bodies`, in the same order
    std::vector<Turn> turns;         ///< of `bodies`, in the same order
    HostedWalls walls;
    nscd::PeriodicBox box;
    SceneWatch watch;
};

/// Forces and torques applied by a script (O.forces), in the order of the layout's bodies; empty if
/// there are none [N, N m].
struct Loads {
    std::vector<Vec3> force;
    std::vector<Vec3> torque;
};

/// Force at one contact point, acting on `second`.
struct ContactForce {
    GrainId first = 0;  ///< body id, or the key of a wall
    GrainId second = 0;
    bool wall = false;            ///< whether `first` is a wall
    Vec3 point{};                 ///< [m]
    Vec3 normal{};                ///< unit, from first to second
    double gap = 0.0;             ///< gap, negative for an overlap [m]
    double normal_force = 0.0;    ///< J_n/dt [N]
    Vec3 shear_force{};           ///< J_t/dt [N]
    double rolling_moment = 0.0;  ///< [N m]
};

class ContactHost {
 public:
    /// `settings.surfaces` has one entry; materials of the scene have its values, with their own
    /// friction. Throws std::invalid_argument as nscd::Engine does.
    explicit ContactHost(const nscd::EngineSettings& settings);

    /// Replaces the scene; the contact memory of known pairs is kept.
    void lay_out(Layout layout);

    /// Whether the scene, which has `count` bodies, has changed since it was laid out.
    bool outdated(std::size_t count) const { return watch_.changed(count, states_); }

    /// Reads motions, solves the contacts, moves the bodies, writes motions. Throws
    /// std::runtime_error naming a body whose motion is not finite or whose centre is behind a
    /// wall.
    nscd::StepReport step(double dt, const Loads& loads);

    const nscd::Engine& engine() const { return *engine_; }
    double max_penetration() { return engine_->max_penetration(); }  ///< [m]

    /// Largest overlap in the scene as it was laid out.
    std::optional<Overlap> overlap() const;

    /// Impulses and states of the contacts, for a new process, without the walls, which YADE
    /// stores.
    std::vector<char> memory() const;
    void restore_memory(const std::vector<char>& bytes);

    /// Contact points of the last step with a force.
    std::vector<ContactForce> contacts() const;

 private:
    std::vector<nscd::Surface> surfaces(const std::vector<double>& frictions) const;
    std::unique_ptr<nscd::Engine> new_engine(Layout& layout) const;
    bool in_space() const { return engine_->settings().dimension == 3; }
    void read_bodies();
    void take_loads(const Loads& loads);
    void check_bodies(const char* when) const;
    void write_bodies() const;

    nscd::EngineSettings settings_;
    ShapeTable shapes_;
    std::unique_ptr<nscd::Engine> engine_;
    BodyStates states_;
    std::vector<Turn> turns_;
    HostedWalls walls_;
    std::vector<double> heights_;  ///< z of the bodies in YADE, where they move in the plane
    SceneWatch watch_;
    std::vector<Vec3> solved_positions_;  ///< at which the last contacts were solved
    double last_step_ = 0.0;
    std::vector<char> given_memory_;  ///< for the first scene
};

}  // namespace turbidite::yade
