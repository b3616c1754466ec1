// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One step of non-smooth contact dynamics (Topin 2011, Eqs. 16-19):
//
//     free velocity -> detection at q -> contact problem -> solver -> velocities
//
// Moving is a call of its own: in a coupled run the fluid corrects the velocities first, and the
// case says which velocities the positions follow.
//
//     Engine engine(settings, shapes, walls);
//     engine.bodies().add(...);
//     engine.step(dt);                 // velocities of bodies() are now U_contact
//     engine.move(dt);                 // q <- q + dt U
//
// Hosts may overwrite bodies() freely between two calls. Results depend on the bodies and their
// order only, bit for bit.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "granular_adapter/nscd/bodies.hpp"
#include "granular_adapter/nscd/contact_problem.hpp"
#include "granular_adapter/nscd/law.hpp"
#include "granular_adapter/nscd/narrow_phase.hpp"
#include "granular_adapter/nscd/periodic_box.hpp"
#include "granular_adapter/nscd/solver.hpp"
#include "granular_adapter/nscd/walls.hpp"
#include "granular_adapter/nscd/warm_start.hpp"

namespace turbidite::nscd {

struct EngineSettings {
    Vec3 gravity{};         ///< [m/s2]
    double theta = 0.5;     ///< of the theta-scheme, [1/2, 1]
    double friction = 0.3;  ///< mu between bodies
    std::string law = "coulomb";
    LawSettings law_settings;
    std::string solver = "nlgs";
    SolverSettings solver_settings;
    PeriodicBox box;
};

struct StepReport {
    std::int64_t candidates = 0;  ///< contacts within the alert distance
    std::int64_t contacts = 0;    ///< those with an impulse
    std::int64_t iterations = 0;  ///< sweeps
    double residual = 0.0;        ///< scaled natural map
    ChangeMeasures change;        ///< quad and max
    bool converged = true;
};

class Engine {
 public:
    /// Throws std::invalid_argument on unknown names, bad parameters or shapes without contacts.
    Engine(const EngineSettings& settings, const ShapeTable& shapes, std::vector<Wall> walls);

    Bodies& bodies() { return bodies_; }
    const Bodies& bodies() const { return bodies_; }
    const std::vector<Wall>& walls() const { return walls_; }
    /// Hosts may change a wall's motion between two steps.
    std::vector<Wall>& walls() { return walls_; }
    const EngineSettings& settings() const { return settings_; }

    /// Solves contacts at the present configuration; positions stay. Starts from free fall.
    StepReport step(double dt);

    /// The same from free velocities that somebody else computed.
    StepReport step_from(const std::vector<Twist>& free, double dt);

    /// The same with mobilities that somebody else knows, taken as they are: masses, moments and
    /// flags of the bodies do not enter. May be repeated before the move; each time the solver
    /// starts from the last impulses.
    StepReport step_from(const std::vector<Twist>& free, std::vector<BodyMobility> mobilities,
                         double dt);

    /// Moves with the bodies' present velocities; walls follow their own.
    void move(double dt);

    /// Moves with given ones; the bodies keep theirs.
    void move(double dt, const std::vector<Twist>& velocities);

    /// Deepest overlap at the present configuration, >= 0 [m].
    double max_penetration() const;

    /// Contact points of the last step, their problem and its solution.
    const std::vector<ContactPoint>& points() const { return points_; }
    const ContactProblem& problem() const { return problem_; }
    const Impulses& impulses() const { return impulses_; }

    /// What the last step's solver started from.
    const Impulses& guess() const { return guess_; }

    /// Drops bodies whose entry is zero, and with them the last step's contact points.
    void keep(const std::vector<std::uint8_t>& mask);

    /// Bodies, walls and contact memory; restore() expects an engine with the same settings.
    std::vector<char> save() const;
    void restore(const std::vector<char>& state);

    /// Walls and contact memory alone, for hosts that store bodies themselves.
    ContactMemory& memory() { return memory_; }
    const ContactMemory& memory() const { return memory_; }
    std::vector<char> save_memory() const;
    void restore_memory(const std::vector<char>& state);

 private:
    double reach(const std::vector<Twist>& free, double dt) const;
    std::vector<ContactPoint> detect(double reach, double share) const;
    void order_top_down(std::vector<ContactPoint>& points) const;
    ContactProblem build(const std::vector<Twist>& free, std::vector<BodyMobility> mobilities,
                         double dt) const;
    void add_wall_motion(Contact& contact, const ContactPoint& point) const;
    ContactKey key(const ContactPoint& point) const;
    std::vector<ContactKey> keys() const;
    void hand_out(const SolverResult& result);

    EngineSettings settings_;
    NarrowPhase narrow_phase_;
    std::vector<Wall> walls_;
    std::unique_ptr<const ContactLaw> law_;
    std::unique_ptr<const ContactSolver> solver_;
    Bodies bodies_;
    ContactMemory memory_;
    std::vector<ContactPoint> points_;
    ContactProblem problem_;
    Impulses guess_;
    Impulses impulses_;
};

}  // namespace turbidite::nscd
