// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One step of non-smooth contact dynamics (Topin 2011, Eqs. 16-19):
//
//     detect     contact points at q that may close within the step
//     pose       the contact problem: free velocities, gaps, laws
//     solve      impulses and velocities that satisfy it
//     hand out   to the bodies, and to the initial guess of the next step
//     move       q <- q + dt U
//
// Moving is a separate call: in a coupled run the fluid corrects the velocities first, and the case
// selects the velocities that positions follow.
//
//     Engine engine(settings, shapes, walls);
//     engine.bodies().add(...);
//     engine.step(dt);                 // velocities of bodies() are now U_contact
//     engine.move(dt);                 // q <- q + dt U
//
// Hosts may overwrite bodies() freely between two calls. Results are bitwise reproducible and
// depend only on the bodies and their order.
//
// Several engines, one per rank, can share a configuration (share_with): each has its own bodies,
// which move to other ranks as they cross cells. The results have the same bits on any number of
// ranks; in space also those of one engine with all bodies, which orders contacts from the top down
// in the plane. All ranks make the same calls in the same order.
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
#include "granular_adapter/nscd/ranks/rank_domain.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::nscd {

struct EngineSettings {
    int dimension = 2;              ///< of the contacts: 2, or 3 for spheres in space
    Vec3 gravity{};                 ///< [m/s2]
    double theta = 0.5;             ///< of the theta-scheme, in [1/2, 1]
    double friction = 0.3;          ///< mu of the only material, if `surfaces` is empty
    std::vector<Surface> surfaces;  ///< by Bodies::material and Wall::material
    /// Pairs that do not follow the pair rule of surface.hpp.
    std::vector<SurfacePair> surface_pairs;
    LawChoice law;
    LawSettings law_settings;
    std::string solver = "nlgs";
    LawList laws = law_list();           ///< table in which names of laws are looked up
    SolverList solvers = solver_list();  ///< table in which names of solvers are looked up
    SolverSettings solver_settings;
    PeriodicBox box;
};

struct StepReport {
    std::int64_t candidates = 0;  ///< contact points within the alert distance
    std::int64_t contacts = 0;    ///< contacts with an impulse
    std::int64_t iterations = 0;  ///< sweeps of the solver
    double residual = 0.0;        ///< scaled natural map
    ChangeMeasures change;        ///< quad and max
    bool converged = true;
    double max_penetration = 0.0;  ///< largest overlap at the start of the step, >= 0 [m]
};

class Engine {
 public:
    /// Throws std::invalid_argument for unknown names, for parameters that are missing or out of
    /// range, for shapes without contact detection or without the chosen law, and for what is not
    /// of the dimension.
    Engine(const EngineSettings& settings, const ShapeTable& shapes, std::vector<Wall> walls);

    /// To be called before the first step; the exchange must outlive the engine. Throws
    /// std::invalid_argument for a solver of one rank.
    void share_with(RankExchange& ranks);

    /// An array of the host with one entry per body, which goes with the bodies to other ranks.
    void carry(std::vector<Twist>& array) { shared_.carried.push_back(&array); }

    Bodies& bodies() { return bodies_; }
    const Bodies& bodies() const { return bodies_; }
    const std::vector<Wall>& walls() const { return walls_; }
    /// Hosts may change a wall's motion between two steps.
    std::vector<Wall>& walls() { return walls_; }
    /// The walls of the last step's contact points: walls(), and behind them the images of plates
    /// across periodic sides.
    const std::vector<Wall>& walls_of_points() const { return placed_walls_; }
    /// The bodies of the last step's contact points: bodies(), and behind them copies of those of
    /// other ranks.
    const Bodies& bodies_of_points() const { return shared_.ranks ? shared_.present : bodies_; }
    const EngineSettings& settings() const { return settings_; }

    /// Replaces the surfaces, for a host that knows its materials late; laws and contact memory are
    /// kept. Throws as the constructor does, and then changes nothing.
    void set_surfaces(std::vector<Surface> surfaces, std::vector<SurfacePair> pairs = {});
    const SurfaceTable& surfaces() const { return laws_.surfaces(); }

    /// Solves the contacts at the present configuration, from the free motion under gravity and
    /// loads. Positions stay.
    StepReport step(double dt);

    /// The same from free velocities computed by the caller [m/s, rad/s], one per body.
    StepReport step_from(const std::vector<Twist>& free, double dt);

    /// The same with mobilities from the caller, used as given: masses, moments of inertia and
    /// flags of the bodies are ignored; they are of the engine's dimension. May be repeated before
    /// the move; each time the solver starts from the last impulses, and laws from their state at
    /// the last move.
    StepReport step_from(const std::vector<Twist>& free, Mobilities mobilities, double dt);

    /// Moves bodies with their present velocities and walls with their own, and accepts the step:
    /// the states that laws found in it become their memory.
    void move(double dt);

    /// Moves with the given velocities; those of the bodies stay.
    void move(double dt, const std::vector<Twist>& velocities);

    /// Throws std::invalid_argument naming an axis along which two bodies, of any rank, could touch
    /// or attract each other on both sides.
    void check_periods();

    /// Largest overlap at the present configuration, >= 0; of several ranks that of their own
    /// bodies, which they exchange first [m].
    double max_penetration();

    /// The same right after move(), from the pairs detected by the last step if these suffice.
    /// Bodies and walls must be where move() and keep() left them.
    double max_penetration_after_move();

    /// How far the bodies' present velocities are from the contact conditions of the last step
    /// (residual.hpp) [m/s].
    double contact_violation();

    /// Work of the films on the free bodies in the last step, with the mean of the velocities at
    /// its start and of their present ones; of several ranks that of their own contacts [J].
    double film_work();

    /// Contact points of the last step, and the impulses on the bodies there. With an attractive
    /// law a normal impulse may be negative.
    const std::vector<ContactPoint>& points() const { return contacts_.points; }
    const Impulses& impulses() const { return contacts_.impulses; }

    /// solution() without what films of liquid carry of it.
    const Impulses& carried() const {
        return contacts_.problem.films.empty() ? contacts_.solution : contacts_.pressing;
    }

    /// The problem of the last step and its solution r~ of law.hpp: the impulses without the
    /// attraction of a law, which is included in the problem's free velocities.
    const ContactProblem& problem() const { return contacts_.problem; }
    const Impulses& solution() const { return contacts_.solution; }

    /// The initial guess of the last solve.
    const Impulses& guess() const { return contacts_.guess; }

    /// Removes bodies whose entry is zero, and with them the last step's contact points.
    void keep(const std::vector<std::uint8_t>& mask);

    /// Bodies, walls and contact memory; restore() requires an engine with the same settings.
    std::vector<char> save() const;
    /// Throws std::invalid_argument for bytes of another format, and then changes nothing.
    void restore(const std::vector<char>& state);
    /// What several ranks saved, all bodies of all of them in the order of the ranks; those that
    /// this rank does not have can be left out with keep().
    void restore_from(const std::vector<std::vector<char>>& of_ranks);

    /// Walls and contact memory only, for hosts that store the bodies themselves.
    ContactMemory& memory() { return memory_; }
    const ContactMemory& memory() const { return memory_; }
    std::vector<char> save_memory(const KeyNames* names = nullptr) const;
    void restore_memory(const std::vector<char>& state);

 private:
    /// What several ranks share.
    struct Shared {
        std::unique_ptr<RankDomain> ranks;  ///< none: one rank has everything
        std::unique_ptr<ParityGrid> grid;   ///< of the last step
        Bodies present;                     ///< the own bodies, and copies of those of other ranks
        std::vector<std::vector<Twist>*> carried;
    };
    /// Of the last step.
    struct StepContacts {
        std::vector<ContactPoint> points;
        double deepest = 0.0;          ///< overlap of the points [m]
        std::vector<ContactKey> keys;  ///< of the points
        ContactProblem problem;
        Impulses guess, solution, impulses;
        // With films only, as long as the problem.
        Impulses pressing;
        std::vector<double> approach;  ///< n.(v_b - v_a) at the start of the step [m/s]
    };

    std::vector<Wall> placed_walls(double reach) const;
    bool may_meet_images() const;
    void look_ahead(const std::vector<Twist>& free, double dt);
    double bound(const std::vector<Twist>& twists, double dt) const;
    void gather_bodies(std::vector<Twist>& free, Mobilities& mobilities);
    RankShare share(std::vector<std::vector<Twist>*> twists, Mobilities* mobilities);
    StepReport solve_step(std::vector<Twist> free, Mobilities mobilities, double dt);
    bool looks_farther(const std::vector<Twist>& found, double dt);
    void detect();
    void pose(const std::vector<Twist>& free, Mobilities mobilities, double dt);
    SolverResult solve(double dt);
    SolverResult solve_from(const Impulses& guess, double dt);
    double settle(SolverResult& result, double dt);
    double sinking(const SolverResult& result, double dt);
    StepReport hand_out(SolverResult result, double dt);
    void sum_impulses();
    void look_at_films(const Impulses& found, const std::vector<Twist>& velocities);
    std::int64_t loaded_contacts() const;
    void follow_bodies();
    std::vector<double> wanted_shortfalls(const std::vector<Twist>& velocities, double dt);
    double largest_turn(const std::vector<Twist>& velocities, const std::vector<double>& wanted,
                        const std::vector<double>& shortfalls, double dt);
    ContactKey key(const ContactPoint& point) const;
    void forget_step();
    void release_step();
    Impulses initial_guess(double dt) const;
    void remember(const Impulses& found, double dt);
    SavedMemory saved_memory() const;
    bool in_space() const { return settings_.dimension == 3; }
    void take_memory(SavedMemory memory);

    EngineSettings settings_;
    Detection detection_;
    std::vector<Wall> walls_;
    std::vector<Wall> placed_walls_;  // with_images of the last detection
    ContactLaws laws_;
    std::unique_ptr<const ContactSolver> solver_;
    Bodies bodies_;
    Shared shared_;
    ContactMemory memory_;
    ContactMemory turning_memory_;  // moments of space; empty without resistance to rolling
    double reach_ = 0.0;            ///< largest gap the last step detected [m]
    double moved_ = 0.0;            ///< upper bound of the decrease of any gap since [m]
    StepContacts contacts_;
};

}  // namespace turbidite::nscd
