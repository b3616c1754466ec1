// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/engine/engine.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/corner_turn.hpp"
#include "granular_adapter/nscd/detection/reach.hpp"
#include "granular_adapter/nscd/detection/wall_images.hpp"
#include "granular_adapter/nscd/engine/dimension.hpp"
#include "granular_adapter/nscd/engine/engine_state.hpp"
#include "granular_adapter/nscd/engine/theta_scheme.hpp"
#include "granular_adapter/nscd/problem/turned_frames.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::nscd {
namespace {

// Contacts with a gap below this fraction of both radii are always in the problem, so that a
// contact that opens by rounding does not appear and disappear. Larger values only cost time.
constexpr double alert_share = 0.02;

// A step is solved again while rotating corners would overlap by more than this fraction of a
// radius.
constexpr double turn_share = 1e-5;
constexpr int turn_rounds = 2;

SurfaceTable surface_table(const EngineSettings& settings) {
    if (!settings.surfaces.empty()) return SurfaceTable(settings.surfaces, settings.surface_pairs);
    Surface only;
    only.friction = settings.friction;
    return SurfaceTable({only});
}

/// In space always by cells, on any number of ranks: it costs a few sweeps at most there.
ContactOrder contact_order(int dimension) {
    return dimension == 3 ? ContactOrder::cells : ContactOrder::top_down;
}

LawSettings law_settings(const EngineSettings& settings) {
    LawSettings result = settings.law_settings;
    result.dimension = settings.dimension;
    return result;
}

void check_step(double dt) {
    if (!(dt > 0.0)) throw std::invalid_argument("the time step must be positive");
}

}  // namespace

Engine::Engine(const EngineSettings& settings, const ShapeTable& shapes, std::vector<Wall> walls)
    : settings_(settings),
      detection_(shapes, settings.box, contact_order(settings.dimension)),
      walls_(std::move(walls)),
      laws_(settings.law, law_settings(settings), surface_table(settings), shapes, settings.laws),
      solver_(make_solver(settings.solver, settings.solvers)) {
    check_dimension(settings_.dimension, shapes);
    check_solver(settings_.dimension, settings_.solver, *solver_);
    check_theta(settings_.theta, laws_.surfaces().largest_restitution());
    for (const Wall& wall : walls_) detection_.narrow_phase().check(wall);
}

void Engine::set_surfaces(std::vector<Surface> surfaces, std::vector<SurfacePair> pairs) {
    ContactLaws next = laws_.with(SurfaceTable(std::move(surfaces), std::move(pairs)));
    check_theta(settings_.theta, next.surfaces().largest_restitution());
    laws_ = std::move(next);
}

StepReport Engine::step(double dt) {
    check_step(dt);
    return step_from(free_velocities(bodies_, settings_.gravity, dt), dt);
}

StepReport Engine::step_from(const std::vector<Twist>& free, double dt) {
    return step_from(free, mobilities_of(bodies_, settings_.dimension), dt);
}

StepReport Engine::step_from(const std::vector<Twist>& free, Mobilities mobilities, double dt) {
    check_step(dt);
    if (free.size() != bodies_.size() || size(mobilities) != bodies_.size())
        throw std::invalid_argument(
            "a contact step needs one free velocity and one mobility per "
            "body");
    if (dimension(mobilities) != settings_.dimension)
        throw std::invalid_argument("the mobilities of a contact step are of dimension " +
                                    std::to_string(dimension(mobilities)) + ", the engine of " +
                                    std::to_string(settings_.dimension));
    check_periods(bodies_.radius, settings_.box);
    release_step();
    detect(free, dt);
    pose(free, std::move(mobilities), dt);
    SolverResult result = solve(dt);
    return hand_out(std::move(result), dt);
}

/// Frees what the last step left, so that this step gets the same memory again: cached where it
/// fits into the cache, and its pages mapped where it does not.
void Engine::release_step() {
    const auto release = [](auto& array) { array = std::remove_reference_t<decltype(array)>(); };
    release(points_), release(problem_.contacts);
    release(guess_), release(solution_), release(impulses_);
}

/// Finds every contact point that may close within the step.
void Engine::detect(const std::vector<Twist>& free, double dt) {
    const bool corners = detection_.has_corners();
    reach_ = std::max({approach_bound(bodies_, walls_, free, corners, dt),
                       approach_bound(bodies_, walls_, bodies_.twist, corners, dt),
                       laws_.law().range()});
    check_periods(bodies_.radius, settings_.box);
    placed_walls_ = placed_walls(reach_);
    points_ = detection_.points(bodies_, placed_walls_, settings_.gravity, reach_, alert_share);
    if (placed_walls_.size() > walls_.size()) name_images(placed_walls_, points_);
    keys_.clear();
    keys_.reserve(points_.size());
    deepest_ = 0.0;
    for (const ContactPoint& point : points_) {
        keys_.push_back(key(point));
        deepest_ = std::max(deepest_, -point.gap);
    }
}

/// Whether a body that crosses a side may touch another image of a wall than before.
bool Engine::may_meet_images() const {
    const PeriodicBox& box = settings_.box;
    return box.repeats() && std::any_of(walls_.begin(), walls_.end(), has_ends);
}

/// The walls, and what a body that looks `reach` beyond its surface may see of their images.
std::vector<Wall> Engine::placed_walls(double reach) const {
    double largest = 0.0;
    for (const double radius : bodies_.radius) largest = std::max(largest, radius);
    return with_images(walls_, bodies_, settings_.box, reach + (1.0 + 2.0 * alert_share) * largest);
}

/// Sets up the contact problem of these points under the laws, and the initial guess.
void Engine::pose(const std::vector<Twist>& free, Mobilities mobilities, double dt) {
    problem_ =
        laws_.pose({points_, keys_, bodies_, placed_walls_}, free, std::move(mobilities), dt);
    guess_ = initial_guess(dt);
}

Impulses Engine::initial_guess(double dt) const {
    if (!in_space()) return memory_.guesses(keys_, dt);
    Impulses guess = from_world_axes(problem_, memory_.guesses(keys_, dt));
    if (!turning_memory_.contacts().empty())
        guess.moments = moments_of(turning_memory_.guesses(keys_, dt));
    return guess;
}

/// The initial guess of the next step.
void Engine::remember(const Impulses& found, double dt) {
    if (!in_space()) return memory_.remember(keys_, found, dt);
    memory_.remember(keys_, in_world_axes(problem_, found), dt);
    if (found.moments.empty())
        turning_memory_.forget();
    else
        turning_memory_.remember(keys_, kept_moments(found), dt);
}

/// Solves the problem; if corners rotate fast, again with gaps reduced by the shortfall
/// (corner_turn.hpp). The iterations are summed over all solves.
SolverResult Engine::solve(double dt) {
    SolverResult result = solver_->solve(problem_, guess_, settings_.solver_settings);
    if (!detection_.has_corners()) return result;
    std::vector<double> shortfalls(points_.size(), 0.0);
    for (int round = 0; round < turn_rounds; ++round) {
        if (!(take_turns(result.velocities, shortfalls, dt) > turn_share)) break;
        SolverResult next = solver_->solve(problem_, result.impulses, settings_.solver_settings);
        next.iterations += result.iterations;
        result = std::move(next);
    }
    return result;
}

/// Updates the biases for the shortfalls at these velocities. Returns the largest change over the
/// body's radius, among contacts that would end with an overlap.
double Engine::take_turns(const std::vector<Twist>& velocities, std::vector<double>& shortfalls,
                          double dt) {
    const std::vector<double> found =
        gap_shortfalls({points_, problem_.contacts, bodies_, placed_walls_, velocities, dt},
                       detection_.narrow_phase());
    double largest = 0.0;
    for (std::size_t k = 0; k < found.size(); ++k) {
        Contact& contact = problem_.contacts[k];
        const double wanted = std::max(0.0, found[k]), change = wanted - shortfalls[k];
        const double u = contact_velocity(contact, velocities).n + contact.bias.n;
        if (dt * u < change)
            largest =
                std::max(largest, change / bodies_.radius[static_cast<std::size_t>(contact.b)]);
        contact.bias.n -= change / dt;
        shortfalls[k] = wanted;
    }
    return largest;
}

void Engine::move(double dt) {
    move(dt, bodies_.twist);
}

void Engine::move(double dt, const std::vector<Twist>& velocities) {
    check_step(dt);
    moved_ = approach_bound(bodies_, walls_, velocities, detection_.has_corners(), dt);
    nscd::move(bodies_, velocities, dt, settings_.box);
    for (Wall& wall : walls_) nscd::move(wall, dt);
    laws_.states().accept();
}

double Engine::max_penetration() const {
    return detection_.deepest_overlap(bodies_, placed_walls(0.0));
}

double Engine::max_penetration_after_move() const {
    // Bodies moved farther than the last step detected, some were removed, or one may have crossed
    // a side and touch another image of a plate: all pairs must be tested.
    if (!(moved_ <= reach_) || may_meet_images()) return max_penetration();
    return detection_.deepest_overlap(bodies_, walls_, points_);
}

double Engine::contact_violation() const {
    return nscd::contact_violation(problem_, solution_, bodies_.twist);
}

void Engine::keep(const std::vector<std::uint8_t>& mask) {
    bodies_.keep(mask);
    forget_step();
}

void Engine::forget_step() {
    points_.clear();
    moved_ = std::numeric_limits<double>::infinity();
    problem_ = {};
    solution_.clear();
    impulses_.clear();
}

std::vector<char> Engine::save() const {
    ByteWriter out;
    write_bodies(out, bodies_);
    write_memory(out, saved_memory());
    return out.take();
}

void Engine::restore(const std::vector<char>& state) {
    ByteReader in(state);
    Bodies bodies = read_bodies(in);
    SavedMemory memory = read_memory(in, walls_, in_space());
    demand_end(in);
    bodies_ = std::move(bodies);
    take_memory(std::move(memory));
    forget_step();
}

std::vector<char> Engine::save_memory() const {
    ByteWriter out;
    write_memory(out, saved_memory());
    return out.take();
}

void Engine::restore_memory(const std::vector<char>& state) {
    ByteReader in(state);
    SavedMemory memory = read_memory(in, walls_, in_space());
    demand_end(in);
    take_memory(std::move(memory));
}

SavedMemory Engine::saved_memory() const {
    return {memory_.sorted_by_key(), laws_.states().saved(), walls_, in_space(),
            turning_memory_.sorted_by_key()};
}

void Engine::take_memory(SavedMemory memory) {
    turning_memory_.replace(std::move(memory.moments));
    memory_.replace(std::move(memory.contacts));
    laws_.states().replace(std::move(memory.states));
    walls_ = std::move(memory.walls);
}

ContactKey Engine::key(const ContactPoint& point) const {
    if (point.wall >= 0)
        return {placed_walls_[static_cast<std::size_t>(point.wall)].key, bodies_.id[point.b], 1,
                point.feature};
    return {bodies_.id[point.a], bodies_.id[point.b], 0, point.feature};
}

/// Gives velocities and impulses to the bodies, the initial guess of the next step to the memory,
/// and the next states to the laws.
StepReport Engine::hand_out(SolverResult result, double dt) {
    remember(result.impulses, dt);
    laws_.find_states({points_, keys_, bodies_, placed_walls_}, result.impulses);
    impulses_ = laws_.felt(result.impulses);
    solution_ = std::move(result.impulses);
    bodies_.twist = std::move(result.velocities);
    sum_impulses();
    return {static_cast<std::int64_t>(points_.size()),
            static_cast<std::int64_t>(memory_.contacts().size()),
            result.iterations,
            result.residual,
            result.change,
            result.converged,
            deepest_};
}

/// Sums contact impulses and their moments by body.
void Engine::sum_impulses() {
    std::fill(bodies_.contact_impulse.begin(), bodies_.contact_impulse.end(), Vec3{});
    std::fill(bodies_.contact_angular_impulse.begin(), bodies_.contact_angular_impulse.end(),
              Vec3{});
    const auto add = [this](std::int32_t body, const Vec3& arm, const Vec3& p, const Vec3& moment) {
        bodies_.contact_impulse[body] = bodies_.contact_impulse[body] + p;
        Vec3& sum = bodies_.contact_angular_impulse[body];
        sum = sum + cross(arm, p) + moment;
    };
    for (std::size_t k = 0; k < points_.size(); ++k) {
        const Vec3 moment = world_moment(impulses_, k);
        if (impulses_[k] == ContactVector{} && moment == Vec3{}) continue;
        const Contact& contact = problem_.contacts[k];
        const Vec3 p = world_impulse(contact, impulses_[k]);
        add(contact.b, contact.arm_b, p, moment);
        if (contact.a >= 0) add(contact.a, contact.arm_a, -1.0 * p, -moment);
    }
}

}  // namespace turbidite::nscd
