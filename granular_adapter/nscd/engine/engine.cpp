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

// A step is solved again, looking farther, while its velocities let surfaces approach each other by
// more than was looked for and this fraction of the smallest radius: what a squeezed body shoots
// at, nobody had asked about.
constexpr double most_overlooked = 0.01;
constexpr int search_rounds = 3;

// A step is solved more exactly while a body sinks into a smaller one by more than this fraction of
// its radius.
constexpr double most_sinking = 0.01;

// In space it gets more sweeps, from 16 to 256 at a time, while one sinks in by more than this.
constexpr double wanted_sinking = 1e-3;
constexpr std::int64_t first_settling = 16, last_settling = 256;

constexpr double least_tolerance = 1e-13;  // rounding

// Steps that change little are solved before. In space alone: docs/decisions/contact-solvers.md.
constexpr std::int64_t sweeps_before_momentum = 16;

SurfaceTable surface_table(const EngineSettings& settings) {
    if (!settings.surfaces.empty()) return SurfaceTable(settings.surfaces, settings.surface_pairs);
    Surface only;
    only.friction = settings.friction;
    return SurfaceTable({only});
}

/// In space always by cells, on any number of ranks: it costs a few sweeps at most there. Ranks
/// order by cells in the plane, too.
ContactOrder contact_order(int dimension) {
    return dimension == 3 ? ContactOrder::cells : ContactOrder::top_down;
}

LawSettings law_settings(const EngineSettings& settings) {
    LawSettings result = settings.law_settings;
    result.dimension = settings.dimension;
    return result;
}

/// Zero of bodies that contacts do no work on: fixed ones, moved by a prescribed motion or not.
std::vector<Twist> free_twists(const Bodies& bodies) {
    std::vector<Twist> twists = bodies.twist;
    for (std::size_t i = 0; i < twists.size(); ++i)
        if (bodies.fixed[i]) twists[i] = {};
    return twists;
}

void check_step(double dt) {
    if (!(dt > 0.0)) throw std::invalid_argument("the time step must be positive");
}

}  // namespace

Engine::Engine(const EngineSettings& settings, const ShapeTable& shapes, std::vector<Wall> walls)
    : settings_(settings),
      detection_(shapes, settings.box, contact_order(settings.dimension),
                 static_cast<int>(settings.solver_settings.threads)),
      walls_(std::move(walls)),
      laws_(settings.law, law_settings(settings), surface_table(settings), shapes, settings.laws),
      solver_(make_solver(settings.solver, settings.solvers)) {
    check_dimension(settings_.dimension, shapes);
    check_solver(settings_.dimension, settings_.solver, *solver_);
    if (laws_.law().has(LawSlot::film)) {
        check_films(settings_.solver, *solver_);
        if (detection_.has_corners())
            throw std::invalid_argument("films of liquid are between round bodies only");
    }
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

void Engine::share_with(RankExchange& ranks) {
    check_ranks(settings_.solver, *solver_);
    shared_.ranks = std::make_unique<RankDomain>(ranks);
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
    if (!shared_.ranks) check_periods();
    look_ahead(free, dt);
    return solve_step(free, std::move(mobilities), dt);
}

StepReport Engine::solve_step(std::vector<Twist> free, Mobilities mobilities, double dt) {
    std::int64_t iterations = 0;
    for (int round = 1;; ++round) {
        release_step();
        if (shared_.ranks) gather_bodies(free, mobilities);
        detect();
        pose(free, std::move(mobilities), dt);
        SolverResult result = solve(dt);
        result.iterations += iterations;
        if (round == search_rounds || !result.converged || !looks_farther(result.velocities, dt))
            return hand_out(std::move(result), dt);
        iterations = result.iterations;
        remember(result.impulses, dt);  // where the next solve begins
        // Without the copies of other ranks' bodies, which are those of another search then.
        mobilities = std::move(contacts_.problem.bodies);
        resize(mobilities, bodies_.size());
        free.resize(bodies_.size());
    }
}

void Engine::check_periods() {
    const double range = laws_.law().range();
    if (shared_.ranks)
        shared_.ranks->check_periods(bodies_, range, settings_.box);
    else
        nscd::check_periods(bodies_.radius, bodies_.fixed, range, settings_.box);
}

/// How far surfaces can approach each other (reach.hpp), over all ranks.
double Engine::bound(const std::vector<Twist>& twists, double dt) const {
    const double corners = detection_.has_corners() ? corner_speed(bodies_, twists) : 0.0;
    if (!shared_.ranks) return approach_bound(bodies_, walls_, twists, corners, dt);
    RankExchange& ranks = shared_.ranks->ranks();
    const std::vector<Twist> extremes = shared_.ranks->extremes(twists);
    const double fastest_corner = largest(ranks, corners);
    return largest(ranks, approach_bound(bodies_, walls_, extremes, fastest_corner, dt));
}

/// Sets how far to look for contacts that may close within the step.
void Engine::look_ahead(const std::vector<Twist>& free, double dt) {
    // A law may act at gaps that no motion closes, as adhesion and films do.
    reach_ = std::max({bound(free, dt), bound(bodies_.twist, dt), laws_.law().range()});
}

/// Whether a pair may have been overlooked that closes at these velocities, of the bodies of the
/// points; then how far to look is what they ask for, at most a diameter.
bool Engine::looks_farther(const std::vector<Twist>& found, double dt) {
    if (!in_space()) return false;  // in the plane all digits stay
    // The own ones: copies without contacts here have kept the velocities that they came with.
    const auto own = static_cast<std::ptrdiff_t>(bodies_.size());
    const double asked = bound({found.begin(), found.begin() + own}, dt);
    if (!(asked > reach_)) return false;
    double smallest = std::numeric_limits<double>::infinity(), largest_radius = 0.0;
    for (const double radius : bodies_.radius) {
        smallest = std::min(smallest, radius);
        largest_radius = std::max(largest_radius, radius);
    }
    if (shared_.ranks) {
        smallest = -largest(shared_.ranks->ranks(), -smallest);
        largest_radius = largest(shared_.ranks->ranks(), largest_radius);
    }
    const double wanted = std::min(asked, std::max(reach_, 2.0 * largest_radius));
    if (!(wanted > reach_ + most_overlooked * smallest)) return false;
    reach_ = wanted;
    return true;
}

/// Gives bodies that have crossed cells to other ranks, and gets copies of those near the own
/// cells.
void Engine::gather_bodies(std::vector<Twist>& free, Mobilities& mobilities) {
    shared_.grid = std::make_unique<ParityGrid>(shared_.ranks->sizes(bodies_, settings_.box),
                                                settings_.box, reach_, alert_share);
    // In this order: copies come from the ranks to which the bodies belong now, and detection takes
    // the own bodies to be the first ones.
    shared_.ranks->settle(*shared_.grid, share({&free}, &mobilities));
    shared_.present = bodies_;
    shared_.ranks->add_copies(*shared_.grid, shared_.present, {&free}, &mobilities);
}

/// Everything that goes with the bodies to another rank.
RankShare Engine::share(std::vector<std::vector<Twist>*> twists, Mobilities* mobilities) {
    twists.insert(twists.end(), shared_.carried.begin(), shared_.carried.end());
    return {bodies_, std::move(twists), mobilities, memory_, turning_memory_, laws_.states()};
}

/// Frees what the last step left, so that this step gets the same memory again: cached where it
/// fits into the cache, and its pages mapped where it does not.
void Engine::release_step() {
    const auto release = [](auto& array) { array = std::remove_reference_t<decltype(array)>(); };
    release(contacts_.points), release(contacts_.problem.contacts);
    release(contacts_.guess), release(contacts_.solution), release(contacts_.impulses);
}

/// Finds every contact point that may close within the step.
void Engine::detect() {
    placed_walls_ = placed_walls(reach_);
    const Detection::Search search{bodies_of_points(), placed_walls_,
                                   settings_.gravity,  reach_,
                                   alert_share,        laws_.law().range() == 0.0};
    OrderedPoints found = shared_.ranks
                              ? detection_.ordered_points(search, *shared_.grid, bodies_.size())
                              : detection_.ordered_points(search);
    contacts_.problem = {};
    if (shared_.ranks)
        contacts_.problem.ranks = &shared_.ranks->plan(*shared_.grid, shared_.present, found);
    contacts_.points = std::move(found.points);
    contacts_.problem.cells = std::move(found.cells);
    // Before the keys, which contain the features.
    if (placed_walls_.size() > walls_.size()) name_images(placed_walls_, contacts_.points);
    contacts_.keys.clear();
    contacts_.keys.reserve(contacts_.points.size());
    contacts_.deepest = 0.0;
    for (const ContactPoint& point : contacts_.points) {
        contacts_.keys.push_back(key(point));
        contacts_.deepest = std::max(contacts_.deepest, -point.gap);
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
    // A centre is at most r + (reach + share 2 r) from a wall that it may touch.
    return with_images(walls_, bodies_, settings_.box, reach + (1.0 + 2.0 * alert_share) * largest);
}

/// Sets up the contact problem of these points under the laws, and the initial guess.
void Engine::pose(const std::vector<Twist>& free, Mobilities mobilities, double dt) {
    ContactProblem posed = laws_.pose(
        {contacts_.points, contacts_.keys, bodies_of_points(), placed_walls_}, free,
        std::move(mobilities), {std::move(contacts_.problem.cells), contacts_.problem.ranks}, dt);
    contacts_.problem = std::move(posed);
    contacts_.guess = initial_guess(dt);
}

Impulses Engine::initial_guess(double dt) const {
    if (!in_space()) return memory_.guesses(contacts_.keys, dt);
    Impulses guess = from_world_axes(contacts_.problem, memory_.guesses(contacts_.keys, dt));
    // All ranks or none have moments: passes over them exchange bodies between ranks.
    if (on_any_rank(contacts_.problem, !turning_memory_.contacts().empty()))
        guess.moments = moments_of(turning_memory_.guesses(contacts_.keys, dt));
    return guess;
}

/// The initial guess of the next step.
void Engine::remember(const Impulses& found, double dt) {
    if (!in_space()) return memory_.remember(contacts_.keys, found, dt);
    memory_.remember(contacts_.keys, in_world_axes(contacts_.problem, found), dt);
    if (found.moments.empty())
        turning_memory_.forget();
    else
        turning_memory_.remember(contacts_.keys, kept_moments(found), dt);
}

/// Solves the problem; if corners rotate fast, again with gaps reduced by the shortfall
/// (corner_turn.hpp). The iterations are summed over all solves.
SolverResult Engine::solve(double dt) {
    SolverResult result = solve_from(contacts_.guess, dt);
    if (!detection_.has_corners()) return result;
    std::vector<double> shortfalls(contacts_.points.size(), 0.0);
    for (int round = 0; round < turn_rounds; ++round) {
        std::vector<double> wanted = wanted_shortfalls(result.velocities, dt);
        if (!(largest_turn(result.velocities, wanted, shortfalls, dt) > turn_share)) break;
        // b_n = (g - wanted)/dt: the side is kept as much farther away as its turn will bring it
        // nearer.
        for (std::size_t k = 0; k < wanted.size(); ++k)
            contacts_.problem.contacts[k].bias.n -= (wanted[k] - shortfalls[k]) / dt;
        shortfalls = std::move(wanted);
        SolverResult next = solve_from(result.impulses, dt);
        next.iterations += result.iterations;
        result = std::move(next);
    }
    return result;
}

/// The residual weighs contacts by their impulses, so that of a light body among heavy ones may be
/// open by as much as one likes. Such a solve goes on with a smaller tolerance until no body sinks
/// in by more than `most_sinking`; where its sweeps do not suffice, it has not converged.
SolverResult Engine::solve_from(const Impulses& guess, double dt) {
    SolverSettings settings = settings_.solver_settings;
    if (in_space()) settings.momentum_after = sweeps_before_momentum;
    SolverResult result = solver_->solve(contacts_.problem, guess, settings);
    double sunk = in_space() ? settle(result, dt) : sinking(result, dt);
    while (result.converged && sunk > most_sinking) {
        settings.tolerance *= 0.1;
        settings.max_iterations = settings_.solver_settings.max_iterations - result.iterations;
        if (settings.max_iterations < 1 || settings.tolerance < least_tolerance) {
            result.converged = false;
            break;
        }
        SolverResult next = solver_->solve(contacts_.problem, result.impulses, settings);
        next.iterations += result.iterations;
        result = std::move(next);
        sunk = sinking(result, dt);
    }
    return result;
}

/// Sweeps without momentum until no body sinks in by more than `wanted_sinking`, or they are used
/// up; returns by how much one does (sinking()). The error of single contacts, which others hide
/// from the residual, takes few of them; a smaller tolerance would ask for many more, of all
/// contacts. What they bring is kept where it is within the tolerance.
double Engine::settle(SolverResult& result, double dt) {
    const SolverSettings& asked = settings_.solver_settings;
    SolverSettings plain = asked;
    plain.tolerance = least_tolerance;
    double sunk = sinking(result, dt);
    Impulses swept = result.impulses;
    for (plain.max_iterations = first_settling;
         plain.max_iterations <= last_settling && result.converged && sunk > wanted_sinking &&
         result.iterations < asked.max_iterations;
         plain.max_iterations *= 2) {
        SolverResult next = solver_->solve(contacts_.problem, swept, plain);
        swept = next.impulses;
        next.iterations += result.iterations;
        next.converged = next.residual <= asked.tolerance;
        result.iterations = next.iterations;
        if (!next.converged) continue;
        result = std::move(next);
        sunk = sinking(result, dt);
    }
    return sunk;
}

/// Over the contacts of all ranks.
double Engine::sinking(const SolverResult& result, double dt) {
    const double here = largest_sinking(contacts_.problem, result.impulses, result.velocities,
                                        bodies_of_points().radius, dt);
    return shared_.ranks ? largest(shared_.ranks->ranks(), here) : here;
}

/// By how much gaps end smaller at these velocities than their speed foretells. A corner that ends
/// farther away does no harm: only positive shortfalls count. A rebound makes up for its part.
std::vector<double> Engine::wanted_shortfalls(const std::vector<Twist>& velocities, double dt) {
    std::vector<double> found = gap_shortfalls({contacts_.points, contacts_.problem.contacts,
                                                bodies_of_points(), placed_walls_, velocities, dt},
                                               detection_.narrow_phase());
    for (std::size_t k = 0; k < found.size(); ++k)
        found[k] = std::max(0.0, found[k] - dt * contacts_.problem.contacts[k].rebound_lead);
    return found;
}

/// The largest change of the shortfalls since the last round, which are in the biases already, over
/// the body's radius, among contacts of all ranks that would end with an overlap.
double Engine::largest_turn(const std::vector<Twist>& velocities, const std::vector<double>& wanted,
                            const std::vector<double>& shortfalls, double dt) {
    const std::vector<double>& radius = bodies_of_points().radius;
    double change_of_any = 0.0;
    for (std::size_t k = 0; k < wanted.size(); ++k) {
        const Contact& contact = contacts_.problem.contacts[k];
        const double change = wanted[k] - shortfalls[k];
        const double u = contact_velocity(contact, velocities).n + contact.bias.n;
        // With b_n = (g - shortfall)/dt the gap will be dt u - change at the end of the step, or
        // more by the rebound's lead.
        if (dt * u < change)
            change_of_any =
                std::max(change_of_any, change / radius[static_cast<std::size_t>(contact.b)]);
    }
    return shared_.ranks ? largest(shared_.ranks->ranks(), change_of_any) : change_of_any;
}

void Engine::move(double dt) {
    move(dt, bodies_.twist);
}

void Engine::move(double dt, const std::vector<Twist>& velocities) {
    check_step(dt);
    // An upper bound of what any gap loses; compared with the reach by
    // max_penetration_after_move().
    moved_ = bound(velocities, dt);
    nscd::move(bodies_, velocities, dt, settings_.box);
    for (Wall& wall : walls_) nscd::move(wall, dt);
    laws_.states().accept();
}

double Engine::max_penetration() {
    if (!shared_.ranks) return detection_.deepest_overlap(bodies_, placed_walls(0.0));
    forget_step();
    // Reach and share zero: only pairs that overlap count here.
    shared_.grid = std::make_unique<ParityGrid>(shared_.ranks->sizes(bodies_, settings_.box),
                                                settings_.box, 0.0, 0.0);
    shared_.ranks->settle(*shared_.grid, share({}, nullptr));
    shared_.present = bodies_;
    shared_.ranks->add_copies(*shared_.grid, shared_.present, {}, nullptr);
    return detection_.deepest_overlap(shared_.present, placed_walls(0.0));
}

double Engine::max_penetration_after_move() {
    // Bodies moved farther than the last step detected, some were removed, or one may have crossed
    // a side and touch another image of a plate: all pairs must be tested.
    if (!(moved_ <= reach_) || may_meet_images()) return max_penetration();
    follow_bodies();
    return detection_.deepest_overlap(bodies_of_points(), walls_, contacts_.points);
}

double Engine::contact_violation() {
    follow_bodies();
    return nscd::contact_violation(contacts_.problem, contacts_.solution, bodies_of_points().twist);
}

/// The bodies of the points as they are now.
void Engine::follow_bodies() {
    if (!shared_.ranks) return;
    // The host may have changed the own bodies; copies follow from their owners.
    std::copy(bodies_.position.begin(), bodies_.position.end(), shared_.present.position.begin());
    std::copy(bodies_.orientation.begin(), bodies_.orientation.end(),
              shared_.present.orientation.begin());
    std::copy(bodies_.twist.begin(), bodies_.twist.end(), shared_.present.twist.begin());
    shared_.ranks->follow(shared_.present);
}

void Engine::keep(const std::vector<std::uint8_t>& mask) {
    bodies_.keep(mask);
    forget_step();
}

void Engine::forget_step() {
    contacts_.points.clear();
    moved_ = std::numeric_limits<double>::infinity();
    contacts_.problem = {};
    contacts_.solution.clear();
    contacts_.impulses.clear();
    contacts_.approach.clear();
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

void Engine::restore_from(const std::vector<std::vector<char>>& of_ranks) {
    Bodies bodies;
    SavedMemory memory;
    for (const std::vector<char>& state : of_ranks) {
        ByteReader in(state);
        append(bodies, read_bodies(in));
        append(memory, read_memory(in, walls_, in_space()));
        demand_end(in);
    }
    bodies_ = std::move(bodies);
    sort_by_id(bodies_);
    take_memory(std::move(memory));
    forget_step();
}

std::vector<char> Engine::save_memory(const KeyNames* names) const {
    ByteWriter out;
    write_memory(out, names ? renamed(saved_memory(), *names) : saved_memory());
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
    const std::vector<GrainId>& id = bodies_of_points().id;
    if (point.wall >= 0)
        return {placed_walls_[static_cast<std::size_t>(point.wall)].key, id[point.b], 1,
                point.feature};
    return {id[point.a], id[point.b], 0, point.feature};
}

/// Gives velocities and impulses to the bodies, the initial guess of the next step to the memory,
/// and the next states to the laws.
StepReport Engine::hand_out(SolverResult result, double dt) {
    remember(result.impulses, dt);
    // Before the bodies get their new velocities: the approach is that at the start of the step.
    look_at_films(result.impulses, result.velocities);
    contacts_.impulses = laws_.felt(result.impulses);
    contacts_.solution = std::move(result.impulses);
    // r~, not r: a bond or a cone is judged without the attraction, and without what films carry.
    laws_.find_states({contacts_.points, contacts_.keys, bodies_of_points(), placed_walls_},
                      carried());
    if (shared_.ranks) {
        const auto own = static_cast<std::ptrdiff_t>(bodies_.size());
        bodies_.twist.assign(result.velocities.begin(), result.velocities.begin() + own);
        shared_.present.twist = std::move(result.velocities);
    } else {
        bodies_.twist = std::move(result.velocities);
    }
    sum_impulses();
    return {static_cast<std::int64_t>(contacts_.points.size()),
            loaded_contacts(),
            result.iterations,
            result.residual,
            result.change,
            result.converged,
            contacts_.deepest};
}

/// What films carry, and how fast their surfaces approached each other.
void Engine::look_at_films(const Impulses& found, const std::vector<Twist>& velocities) {
    contacts_.approach.clear();
    if (!laws_.law().has(LawSlot::film)) return;
    // By all ranks or none: the operator asks them all.
    if (!on_any_rank(contacts_.problem, !contacts_.problem.films.empty())) return;
    contacts_.pressing = carried_by_contacts(contacts_.problem, found, velocities);
    const std::vector<Twist> before = free_twists(bodies_of_points());
    for (const Contact& contact : contacts_.problem.contacts)
        contacts_.approach.push_back(contact_velocity(contact, before).n);
}

/// Contacts that press, those of films alone not among them.
std::int64_t Engine::loaded_contacts() const {
    if (contacts_.problem.films.empty())
        return static_cast<std::int64_t>(memory_.contacts().size());
    return std::count_if(contacts_.pressing.begin(), contacts_.pressing.end(),
                         [](const ContactVector& r) { return r.n > 0.0; });
}

double Engine::film_work() {
    follow_bodies();
    const std::vector<Twist> after = free_twists(bodies_of_points());
    double work = 0.0;
    for (std::size_t k = 0; k < contacts_.approach.size(); ++k) {
        const double now = contact_velocity(contacts_.problem.contacts[k], after).n;
        // Impulse of the film times the mean velocity of the step, (u_n^- + u_n^+)/2 [J].
        work += (contacts_.solution[k].n - contacts_.pressing[k].n) * 0.5 *
                (contacts_.approach[k] + now);
    }
    return work;
}

/// Sums contact impulses and their moments by body.
void Engine::sum_impulses() {
    std::vector<Twist> sums(bodies_of_points().size());  // impulses in the places of velocities
    const auto add = [&sums](std::int32_t body, const Vec3& arm, const Vec3& p,
                             const Vec3& moment) {
        Twist& sum = sums[static_cast<std::size_t>(body)];
        sum.velocity = sum.velocity + p;
        // J = sum p [N s],   K = sum (arm x p + m) [N m s]
        sum.spin = sum.spin + cross(arm, p) + moment;
    };
    each_contact(contacts_.problem, sums, [&](std::size_t k) {
        const Vec3 moment = world_moment(contacts_.impulses, k);
        if (contacts_.impulses[k] == ContactVector{} && moment == Vec3{}) return;
        const Contact& contact = contacts_.problem.contacts[k];
        const Vec3 p = world_impulse(contact, contacts_.impulses[k]);
        add(contact.b, contact.arm_b, p, moment);
        if (contact.a >= 0) add(contact.a, contact.arm_a, -1.0 * p, -moment);
    });
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
        bodies_.contact_impulse[i] = sums[i].velocity;
        bodies_.contact_angular_impulse[i] = sums[i].spin;
    }
}

}  // namespace turbidite::nscd
