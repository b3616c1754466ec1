// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One step of non-smooth contact dynamics (Topin 2011, Eqs. 16-19):
//
//     detect     contact points at q that may close within the step
//     pose       the contact problem: free velocities, gaps, laws
//     solve      impulses and velocities that satisfy it
//     hand out   to the bodies, and to what the next step starts from
//     move       q <- q + dt U
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

#include "granular_adapter/nscd/detection/detection.hpp"
#include "granular_adapter/nscd/engine/engine_state.hpp"
#include "granular_adapter/nscd/laws/contact_laws.hpp"
#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/contact_problem.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"
#include "granular_adapter/nscd/problem/walls.hpp"
#include "granular_adapter/nscd/problem/warm_start.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::nscd {

struct EngineSettings {
    Vec3 gravity{};                          ///< [m/s2]
    double theta = 0.5;                      ///< of the theta-scheme, [1/2, 1]
    double friction = 0.3;                   ///< mu of the only material, where `surfaces` is empty
    std::vector<Surface> surfaces;           ///< by Bodies::material and Wall::material
    std::vector<SurfacePair> surface_pairs;  ///< where the pair rule of surface.hpp does not hold
    LawChoice law;
    LawSettings law_settings;
    std::string solver = "nlgs";
    LawList laws = law_list();           ///< what names of laws are looked up in
    SolverList solvers = solver_list();  ///< and those of solvers
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
    double max_penetration = 0.0;  ///< deepest overlap that the step began with, >= 0 [m]
};

class Engine {
 public:
    /// Throws std::invalid_argument on unknown names, on parameters that are missing or out of
    /// range, and on shapes without contacts or without the law.
    Engine(const EngineSettings& settings, const ShapeTable& shapes, std::vector<Wall> walls);

    Bodies& bodies() { return bodies_; }
    const Bodies& bodies() const { return bodies_; }
    const std::vector<Wall>& walls() const { return walls_; }
    /// Hosts may change a wall's motion between two steps.
    std::vector<Wall>& walls() { return walls_; }
    const EngineSettings& settings() const { return settings_; }

    /// Surfaces of a host that knows its materials late; same laws, what contacts remember is kept.
    /// Throws as the constructor does and then changes nothing.
    void set_surfaces(std::vector<Surface> surfaces, std::vector<SurfacePair> pairs = {});
    const SurfaceTable& surfaces() const { return laws_.surfaces(); }

    /// Solves contacts at the present configuration; positions stay. Starts from free fall.
    StepReport step(double dt);

    /// The same from free velocities that somebody else computed.
    StepReport step_from(const std::vector<Twist>& free, double dt);

    /// The same with mobilities that somebody else knows, taken as they are: masses, moments and
    /// flags of the bodies do not enter. May be repeated before the move; each time the solver
    /// starts from the last impulses, and laws from what they remembered at the last move.
    StepReport step_from(const std::vector<Twist>& free, std::vector<BodyMobility> mobilities,
                         double dt);

    /// Moves with the bodies' present velocities, walls with their own, and accepts the step: what
    /// laws found in it is what they remember in the next.
    void move(double dt);

    /// Moves with given ones; the bodies keep theirs.
    void move(double dt, const std::vector<Twist>& velocities);

    /// Deepest overlap at the present configuration, >= 0 [m].
    double max_penetration() const;

    /// The same right after move(), from the pairs that the last step looked at where that is
    /// enough. Bodies and walls must be where move() and keep() left them.
    double max_penetration_after_move() const;

    /// Contact points of the last step and the impulses that bodies felt there. With a law that
    /// pulls, a normal impulse may be negative.
    const std::vector<ContactPoint>& points() const { return points_; }
    const Impulses& impulses() const { return impulses_; }

    /// The problem of the last step and its solution, r~ of law.hpp: the impulses, but for what a
    /// law pulls, which is in the problem's free velocities.
    const ContactProblem& problem() const { return problem_; }
    const Impulses& solution() const { return solution_; }

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
    void detect(const std::vector<Twist>& free, double dt);
    void pose(const std::vector<Twist>& free, std::vector<BodyMobility> mobilities, double dt);
    SolverResult solve(double dt);
    StepReport hand_out(SolverResult result, double dt);
    void sum_impulses();
    double take_turns(const std::vector<Twist>& velocities, std::vector<double>& shortfalls,
                      double dt);
    ContactKey key(const ContactPoint& point) const;
    void forget_step();
    void take_memory(SavedMemory memory);

    EngineSettings settings_;
    Detection detection_;
    std::vector<Wall> walls_;
    ContactLaws laws_;
    std::unique_ptr<const ContactSolver> solver_;
    Bodies bodies_;
    ContactMemory memory_;
    double reach_ = 0.0;  ///< gaps up to which the last step looked [m]
    double moved_ = 0.0;  ///< upper bound of what gaps lost since [m]
    std::vector<ContactPoint> points_;
    std::vector<ContactKey> keys_;  ///< of the points
    ContactProblem problem_;
    Impulses guess_;
    Impulses solution_;
    Impulses impulses_;
};

}  // namespace turbidite::nscd
