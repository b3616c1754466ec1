// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checks/motion_rule.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace turbidite {
namespace {

const std::string from_the_case =
    "\"initialise\" returns the grains that it was given: positions, orientations and velocities "
    "are the case's.";
const std::string start_of_window =
    "\"advance\" returns positions and orientations of the start of the window: grains move in "
    "\"apply_kick\".";
const std::string how_grains_move =
    "Grains move in \"apply_kick\" by dt U and turn by dt omega, discs as well "
    "(docs/write-an-adapter.md, What apply_kick does).";
const std::string case_gives_motion =
    "The case gives the motion of this grain (motion in grains.file): no contact and no weight "
    "changes it. A program that cannot do this must refuse the case in \"initialise\".";
const std::string how_grains_leave =
    "Only grains that have crossed a side with domain.SIDE = free may be left out and counted in "
    "report.removed.";

// By Eigen and not by coupler/rigid, which those that are checked here may use.
Eigen::Quaterniond unit(const Quaternion& q) {
    return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized();
}
Eigen::Quaterniond turned(const Quaternion& q, const Vec3& angle) {
    const Eigen::Vector3d axis(angle[0], angle[1], angle[2]);
    const double size = axis.norm();
    if (size == 0.0) return unit(q);
    // World axes: the turn of a window is applied after the orientation at its start.
    return Eigen::AngleAxisd(size, axis / size) * unit(q);
}

double change(const Vec3& from, const Vec3& to) {
    return norm(to - from);
}

std::string words(const Vec3& v) {
    return fmt::format("({:.10g})", fmt::join(v, ", "));
}
std::string words(const Quaternion& q) {
    return fmt::format("({:.10g})", fmt::join(q, ", "));
}

/// Of the centre, or of the fastest point of the surface.
// |U| + R |omega|, an upper bound of both [m/s].
double speed(const GrainState& grain) {
    return norm(grain.velocity) + grain.radius * norm(grain.angular_velocity);
}
double change_of_speed(const GrainState& from, const GrainState& to) {
    return change(from.velocity, to.velocity) +
           to.radius * change(from.angular_velocity, to.angular_velocity);
}

double fastest(const Motion& motion) {
    double largest = 0.0;
    for (const GrainState& grain : motion.grains) largest = std::max(largest, speed(grain));
    return largest;
}

}  // namespace

struct MotionRule::Grain {
    const GrainState& then;     ///< at t^n
    const GrainState* contact;  ///< after the contacts; null without a fluid
    const GrainState& now;      ///< at t^{n+1}
};

/// What the grains of a window may do at most.
struct MotionRule::Limits {
    double step;
    double speed;    ///< largest one in the run, with what gravity adds in a window [m/s]
    double overlap;  ///< deepest one reported [m]

    /// How far a grain with contacts may go in sub-steps, and where one is not searched for.
    /// 11/3 + 1 < 5: the surface of a grain struck by much heavier ones, and dt U^{n+1} itself
    /// (head of the header).
    double struck() const { return 5.0 * (step * speed + overlap); }
};

MotionRule::MotionRule(const Settings& settings, const ShapeTable& shapes,
                       const std::vector<GrainState>& population)
    : run_(run_values(settings)),
      bodies_(run_, shapes),
      population_(population),
      side_types_(side_types(settings)) {
    for (const Moved& moved : motions_of(settings, "run.grain_motions"))
        driven_.emplace(moved.what, moved.motion);
    for (const GrainState& grain : population)
        // Driven grains are prescribed too: they are in both tables, and check_given takes their
        // motion.
        if (grain.prescribed) held_.emplace(grain.id, twist_of(grain));
    const auto given = [&](const char* key) {
        return settings.has(key) && !settings.text(key).empty();
    };
    walls_anywhere_ = given("run.walls") || given("run.wall_motions");
    with_contact_velocity_ =
        settings.has("coupling.positions") && settings.text("coupling.positions") == "contact";
    population_index_.follow(population_);
}

/// The nearest image where the domain is cyclic.
Vec3 MotionRule::from_to(const Vec3& from, const Vec3& to) const {
    Vec3 way = to - from;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double period = run_.period[axis];
        // A program may keep positions inside the box or let them run on: both are the same place.
        if (period > 0.0) way[axis] -= period * std::round(way[axis] / period);
    }
    return way;
}

bool MotionRule::is_same_rate(const Vec3& expected, const Vec3& found, double scale) const {
    // `scale` is the run's own (u_c, or u_c/R for spins): a rate of zero would else allow no
    // rounding.
    return change(expected, found) <= round_off * (norm(expected) + scale);
}

/// Position and orientation.
void MotionRule::compare(const Gathered& sent, std::size_t at, const GrainState& expected,
                         const std::string& remedy) const {
    const GrainState& found = sent.motion.grains[at];
    // Equal numbers, the usual case, need no arithmetic. Below, !(a <= b) is true for NaN too.
    if (expected.position == found.position && expected.orientation == found.orientation) return;
    if (!(norm(from_to(expected.position, found.position)) <= same_place()))
        sent.arrival.refuse(sent.owners[at],
                            fmt::format("grain {} is at {} instead of {}", found.id,
                                        words(found.position), words(expected.position)),
                            remedy);
    // The angle between both [rad]; q and -q are the same orientation.
    if (!(unit(expected.orientation).angularDistance(unit(found.orientation)) <= round_off))
        sent.arrival.refuse(
            sent.owners[at],
            fmt::format("grain {} has the orientation (w, x, y, z) {} instead of {}", found.id,
                        words(found.orientation), words(expected.orientation)),
            remedy);
}

void MotionRule::check_start(const std::vector<Leaver>& leavers, const Gathered& initial) {
    // In a resumed run as well: `restore` comes after `initialise`, whose grains are the case's.
    for (const Leaver& leaver : leavers)
        initial.arrival.refuse(
            leaver.rank, fmt::format("grain {} was removed before the first window", leaver.id),
            from_the_case);
    const double u = run_.velocity;
    for (std::size_t at = 0; at < initial.motion.grains.size(); ++at) {
        const GrainState& found = initial.motion.grains[at];
        const GrainState& given = population_[population_index_.place(found.id)];
        compare(initial, at, given, from_the_case);
        const auto demand = [&](const char* quantity, const Vec3& expected, const Vec3& sent,
                                double scale) {
            if (!is_same_rate(expected, sent, scale))
                initial.arrival.refuse(initial.owners[at],
                                       fmt::format("grain {} has the {} {} instead of {}", found.id,
                                                   quantity, words(sent), words(expected)),
                                       from_the_case);
        };
        demand("velocity", given.velocity, found.velocity, u);
        demand("angular velocity", given.angular_velocity, found.angular_velocity,
               u / found.radius);
        // A case gives none, and zero must come back as zero: there is nothing to round.
        demand("contact impulse", given.contact_impulse, found.contact_impulse, 0.0);
        demand("contact angular impulse", given.contact_angular_impulse,
               found.contact_angular_impulse, 0.0);
    }
}

/// Held grains and those that follow a motion.
void MotionRule::check_given(const Window& window, const Gathered& sent) const {
    if (held_.empty()) return;
    for (std::size_t at = 0; at < sent.motion.grains.size(); ++at) {
        const GrainState& grain = sent.motion.grains[at];
        const auto held = held_.find(grain.id);
        if (held == held_.end()) continue;
        // A held grain keeps its velocity of t = 0; a driven one has the mean rate of this window,
        // (d(t + dt) - d(t))/dt, so that it is where its motion says at the end of every window.
        Twist rates = held->second;
        if (const auto driven = driven_.find(grain.id); driven != driven_.end())
            rates = driven->second->rate(window.time, window.step);
        if (is_same_rate(rates.velocity, grain.velocity, run_.velocity) &&
            is_same_rate(rates.spin, grain.angular_velocity, run_.velocity / grain.radius))
            continue;
        sent.arrival.refuse(
            sent.owners[at],
            fmt::format("grain {} has the velocity {} and the angular velocity {} instead of the "
                        "prescribed {} and {}",
                        grain.id, words(grain.velocity), words(grain.angular_velocity),
                        words(rates.velocity), words(rates.spin)),
            case_gives_motion);
    }
}

void MotionRule::check_motion(const Window& window, const Motion& before, const Gathered& motion) {
    before_.follow(before.grains);
    std::size_t from = GrainIndex::nowhere;
    for (std::size_t at = 0; at < motion.motion.grains.size(); ++at) {
        // The guess is the place after that of the grain before; nowhere + 1 is 0, the first place.
        from = before_.place(motion.motion.grains[at].id, from + 1);
        // The roster has checked the ids: every grain of the motion is in the state before.
        compare(motion, at, before.grains[from], start_of_window);
    }
    check_given(window, motion);
}

MotionRule::Defect MotionRule::defect(const Grain& grain, const Twist& rates, double step) const {
    const Shift way = step * rates;
    // q^n + dt U, and the orientation of t^n turned by dt omega.
    const Vec3 goal = grain.then.position + way.displacement;
    const double turn =
        turned(grain.then.orientation, way.angle).angularDistance(unit(grain.now.orientation));
    return {norm(from_to(goal, grain.now.position)), grain.now.radius * turn};
}

double MotionRule::smallest_defect(const Grain& grain, double step) const {
    const Defect corrected = defect(grain, twist_of(grain.now), step);
    if (!with_contact_velocity_ || !grain.contact) return corrected.larger();
    // Both rules are allowed, for each grain, and for its place and its turn: the program has taken
    // one velocity or the other.
    const Defect contact = defect(grain, twist_of(*grain.contact), step);
    return Defect{std::min(corrected.apart, contact.apart), std::min(corrected.turn, contact.turn)}
        .larger();
}

/// Whether contact impulses act on a grain, apart from what is left of a sum that cancels out.
bool MotionRule::is_pushed(const Grain& grain, const Limits& limits) const {
    const double impulse = norm(grain.now.contact_impulse) +
                           norm(grain.now.contact_angular_impulse) / grain.now.radius;
    // |J_c| + |K_c|/R against the round-off of M V, V the largest speed of the window.
    return impulse > round_off * bodies_(grain.now).mass * limits.speed;
}

/// Whether a grain may meet another one, or a wall, on the way of this length.
bool MotionRule::may_touch(const GrainState& grain, const Motion& before, double reach) const {
    // Walls inside the box and moving sides are not measured here: they count as near to
    // everything.
    if (walls_anywhere_) return true;
    const double near = grain.radius + reach;
    for (std::size_t side = 0; side < side_count(run_.dimension); ++side)
        if (holds_grains(side_types_[side]) &&
            box_sides[side].distance(grain.position, run_.size) <= near)
            return true;
    // The other one may come as far to meet it. All grains are searched, but only for one that is
    // not where its rule takes it.
    return std::any_of(before.grains.begin(), before.grains.end(), [&](const GrainState& other) {
        return other.id != grain.id &&
               norm(from_to(grain.position, other.position)) <= near + other.radius + reach;
    });
}

/// The same without contacts [m].
double MotionRule::allowed_alone(const Grain& grain, double step) const {
    // Free fall in sub-steps, without a fluid: q is the sum of small steps, not dt U^{n+1}.
    const bool falls = substeps_ && !grain.contact && held_.count(grain.now.id) == 0;
    return (falls ? step * change_of_speed(grain.then, grain.now) : 0.0) + same_place();
}

/// What a state may differ from its rule by; see the head of the header [m].
double MotionRule::allowed(const Grain& grain, const Motion& before, const Limits& limits) {
    const GrainState &then = grain.then, &now = grain.now;
    // Contacts do not change a given motion: no allowance beside others either.
    if (held_.count(now.id) > 0) return same_place();
    if (is_pushed(grain, limits) || may_touch(then, before, limits.struck())) {
        if (substeps_) return limits.struck();
        // dt (|U^{n+1} - U^{n+4/5}| + |U^{n+4/5} - U^n|); without a fluid dt |U^{n+1} - U^n|.
        const double changes = grain.contact ? change_of_speed(then, *grain.contact) +
                                                   change_of_speed(*grain.contact, now)
                                             : change_of_speed(then, now);
        return limits.step * changes + limits.overlap + same_place();
    }
    return allowed_alone(grain, limits.step);
}

/// Negative beyond it; infinite if no side is free.
double MotionRule::distance_to_free_side(const Vec3& position) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < side_count(run_.dimension); ++side)
        if (side_types_[side] == "free")
            nearest = std::min(nearest, box_sides[side].distance(position, run_.size));
    return nearest;
}

/// A grain leaves when its surface has come to a free side, or later. Nothing is known of the end
/// of its window: it may have been struck.
void MotionRule::check_leavers(const std::vector<Leaver>& leavers, const Motion& before,
                               const Arrival& arrival, const Limits& limits) const {
    for (const Leaver& leaver : leavers) {
        const GrainState& grain = before.grains[before_.place(leaver.id)];
        // Of t^n, the last place that is known of it.
        const double distance = distance_to_free_side(grain.position);
        const double most = grain.radius + limits.struck();
        if (distance <= most) continue;
        const std::string why =
            std::isinf(distance)
                ? "but no side of the domain is free"
                : fmt::format(
                      "{:.6g} from the nearest free side; at most {:.6g}, its radius and "
                      "how far it may move in a window, is allowed",
                      distance, most);
        arrival.refuse(
            leaver.rank,
            fmt::format("grain {} was removed at {}, {}", leaver.id, words(grain.position), why),
            how_grains_leave);
    }
}

/// A state with other velocities than the kicks is told as such (KickRule::with_state).
bool MotionRule::has_moved_with_its_kick(const Grain& grain, const Kicks& kicks,
                                         double step) const {
    return std::any_of(kicks.kicks.begin(), kicks.kicks.end(), [&](const Kick& kick) {
        return kick.id == grain.now.id &&
               defect(grain, twist_of(kick), step).larger() <= same_place();
    });
}

MotionRule::Limits MotionRule::limits(const Window& window, const Motion& before,
                                      const Motion& contact, const Motion& state) const {
    Limits limits{window.step, run_.gravity * window.step, 0.0};
    double largest = 0.0;
    for (const Motion* motion : {&before, &contact, &state}) {
        largest = std::max(largest, fastest(*motion));
        limits.overlap = std::max(limits.overlap, motion->report.max_penetration);
    }
    // Contacts may have been fastest in between, hence all three motions, and g dt on top of them.
    limits.speed += largest;
    return limits;
}

MotionDefect MotionRule::check_state(const Window& window, const Motion& before,
                                     const WindowResult& result, const std::vector<Leaver>& leavers,
                                     const Gathered& state) {
    // Empty without a fluid: `solved` is then nowhere, and every grain is without velocities of
    // contacts.
    const Motion& contact = result.motion;
    const auto& grains = state.motion.grains;
    const Limits most = limits(window, before, contact, state.motion);
    before_.follow(before.grains);
    contact_.follow(contact.grains);
    check_given(window, state);
    MotionDefect largest;
    std::size_t from = GrainIndex::nowhere, solved = from;
    for (std::size_t at = 0; at < grains.size(); ++at) {
        from = before_.place(grains[at].id, from + 1);
        solved = contact_.place(grains[at].id, solved + 1);
        const Grain grain{before.grains[from],
                          solved == GrainIndex::nowhere ? nullptr : &contact.grains[solved],
                          grains[at]};
        const double found = smallest_defect(grain, window.step);
        if (found > largest.defect) largest = {found, grains[at].id};
        // Contacts allow more, and are looked for among all grains: only where that is needed.
        if (found <= allowed_alone(grain, window.step)) continue;
        const double can = allowed(grain, before, most);
        // One that moved with its kick but reports another velocity is left to
        // KickRule::with_state, whose message says so.
        if (found <= can || has_moved_with_its_kick(grain, result.kicks, window.step)) continue;
        state.arrival.refuse(state.owners[at], text(grain, found, can, window.step),
                             how_grains_move);
    }
    check_leavers(leavers, before, state.arrival, most);
    return largest;
}

std::string MotionRule::text(const Grain& grain, double found, double can, double step) const {
    const auto& [then, contact, now] = grain;
    const bool either = with_contact_velocity_ && contact;
    return fmt::format(
        "grain {} went from {} and (w, x, y, z) {} to {} and {}, which is {:.3g} from where its "
        "velocity {} and angular velocity {}{} take it in dt = {:.6g}, {:.3g} allowed",
        now.id, words(then.position), words(then.orientation), words(now.position),
        words(now.orientation), found, words(now.velocity), words(now.angular_velocity),
        either ? fmt::format(", or those of its contacts, {} and {},", words(contact->velocity),
                             words(contact->angular_velocity))
               : "",
        step, can);
}

}  // namespace turbidite
