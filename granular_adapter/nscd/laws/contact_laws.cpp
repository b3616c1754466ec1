// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/laws/contact_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

// In the plane a sliding contact has |r_t| = mu r_n to the last digit; in space r_t is a vector.
constexpr double clip_rounding = 1e-12;

Contact bare_contact(const ContactPoint& p) {
    Contact contact;
    contact.a = p.a;
    contact.b = p.b;
    contact.normal = p.normal;
    contact.tangent = tangent_of(p.normal);
    contact.arm_a = p.arm_a;
    contact.arm_b = p.arm_b;
    return contact;
}

/// Writes the terms of the law into a contact. `approach`: u^-; `drive`: the velocity of the wall,
/// which is not a body of the problem. Both are in the contact's frame.
void take_terms(Contact& contact, const LawTerms& terms, const ContactVector& approach,
                const ContactVector& drive) {
    ContactVector bias{terms.normal_bias, 0.0, 0.0, 0.0};
    if (terms.tangential_restitution != 0.0) {
        // b_t = e_t u_t^-, along the direction that u_t^- has
        bias.t = terms.tangential_restitution * approach.t;
        bias.s = terms.tangential_restitution * approach.s;
    }
    contact.friction = terms.friction;
    // u is relative to the wall, whose velocity is no unknown: u = H^T v - v_wall + b.
    contact.bias = bias - drive;
    contact.rebound_lead = terms.rebound_lead;
    contact.rolling = terms.rolling;
    contact.torsion = terms.torsion;
}

bool resists_turning(const Contact& contact) {
    return contact.rolling != 0.0 || contact.torsion != 0.0;
}

/// `approach`: the relative spin of the start of the step, and `drive` that of the wall.
void take_spins(Contact& contact, const LawTerms& terms, const Vec3& approach, const Vec3& drive,
                bool plane) {
    // w = spin_b - spin_a - spin_wall + e w^-
    const Vec3 bias = terms.rolling_restitution * (approach - drive) - drive;
    if (plane)
        contact.bias.roll = bias[2];
    else
        contact.spin_bias = bias;
}

/// The film of a contact whose bias is set, as the problem has it.
Film film_in(const FilmTerms& terms, double normal_bias, double step) {
    if (terms.coefficient == 0.0) return {};
    // Gaps over dt, in speeds (film.hpp): gamma, gamma_c, and the offset sigma - u_n. With the film
    // at sigma = v + gamma and u_n = v + b_n the offset is gamma - b_n.
    const double gap = terms.gap / step;
    // dt s^{-3/2} = dt^{-1/2} sigma^{-3/2}, where dt/s = 1/sigma
    const double coefficient = terms.between == FilmBetween::spheres
                                   ? terms.coefficient
                                   : terms.coefficient / std::sqrt(step);
    return {coefficient, gap, terms.cutoff / step, gap - normal_bias, terms.between};
}

/// The surface with another sliding friction, that of a wall without a material: static friction is
/// as many times larger as it was, so that a wall with mu = 0 is smooth.
Surface with_friction(Surface surface, double friction) {
    if (friction == surface.friction) return surface;
    // mu_s' = mu' mu_s/mu; the ratio, which is at least 1, comes first, so that rounding never
    // makes mu_s' < mu'.
    surface.static_friction = surface.friction > 0.0
                                  ? friction * (surface.static_friction / surface.friction)
                                  : std::max(surface.static_friction, friction);
    surface.friction = friction;
    return surface;
}

/// Two polygons may touch in two points, and only those that the law reaches share its force.
void share_pairs(const std::vector<ContactPoint>& points, double range,
                 std::vector<double>& shares) {
    const auto pair_of = [](const ContactPoint& p) { return std::array{p.a, p.wall, p.b}; };
    std::map<std::array<std::int32_t, 3>, double> counts;
    for (const ContactPoint& p : points)
        if (p.gap < range) counts[pair_of(p)] += 1.0;
    for (std::size_t k = 0; k < points.size(); ++k)
        if (points[k].gap < range) shares[k] = 1.0 / counts.at(pair_of(points[k]));
}

const Wall& wall_of(const DetectedContacts& contacts, const ContactPoint& point) {
    return contacts.walls[static_cast<std::size_t>(point.wall)];
}

ContactVector wall_velocity(const DetectedContacts& contacts, const ContactPoint& point,
                            const Contact& contact) {
    if (point.wall < 0 || !is_moving(wall_of(contacts, point))) return {};
    const Vec3 v =
        velocity_at(wall_of(contacts, point), contacts.bodies.position[point.b] + point.arm_b);
    return in_frame(contact, v);
}

Vec3 wall_spin(const DetectedContacts& contacts, const ContactPoint& point) {
    return point.wall < 0 ? Vec3{} : wall_of(contacts, point).twist.spin;
}

}  // namespace

ContactLaws::ContactLaws(const LawChoice& choice, const LawSettings& settings,
                         SurfaceTable surfaces, const ShapeTable& shapes, LawList laws)
    : choice_(choice),
      list_(laws),
      settings_(settings),
      surfaces_(std::move(surfaces)),
      law_(choice_, settings_, surfaces_, list_) {
    for (const ShapeRecord& shape : shapes)
        round_.push_back(shape.kind == "disc" || shape.kind == "sphere");
    check_shapes();
}

ContactLaws ContactLaws::with(SurfaceTable surfaces) const {
    ContactLaws result = *this;
    result.law_ = ContactLaw(choice_, settings_, surfaces, list_);
    result.surfaces_ = std::move(surfaces);
    result.check_shapes();
    return result;
}

bool ContactLaws::all_round() const {
    return std::all_of(round_.begin(), round_.end(), [](std::uint8_t round) { return round != 0; });
}

void ContactLaws::check_shapes() const {
    if (law_.has(LawSlot::rolling) && !all_round())
        throw std::invalid_argument(
            "rolling resistance is for round grains only; polygons need none, since their faces "
            "resist "
            "rolling");
}

bool ContactLaws::is_round(const Bodies& bodies, std::int32_t body) const {
    return body >= 0 && round_[static_cast<std::size_t>(bodies.shape[body])] != 0;
}

/// Where walls meet; none for a law that acts on touch only.
std::vector<CommonEdge> ContactLaws::edges_of(const DetectedContacts& contacts) const {
    const auto& walls = contacts.walls;
    if (law_.range() == 0.0 || std::count_if(walls.begin(), walls.end(), has_ends) < 2) return {};
    return common_edges({contacts.points, contacts.bodies, walls, round_}, law_.range());
}

/// One over the number of a pair's points within the range of the law, and 0 where another wall is
/// nearer; empty if all are 1.
std::vector<double> ContactLaws::shares(const std::vector<ContactPoint>& points,
                                        const std::vector<CommonEdge>& edges) const {
    if (law_.range() == 0.0 || (all_round() && edges.empty())) return {};
    std::vector<double> result(points.size(), 1.0);
    if (!all_round()) share_pairs(points, law_.range(), result);
    for (const CommonEdge& edge : edges) result[edge.point] = 0.0;
    return result;
}

/// Bridges and bonds go along with a body from wall to wall: what adhered to one, with its face or
/// its edge, adheres to the one that is nearer now.
void ContactLaws::take_states(const DetectedContacts& contacts,
                              const std::vector<CommonEdge>& edges) {
    past_.clear();
    if (!law_.remembers()) return;
    for (const ContactKey& key : contacts.keys) past_.push_back(states_.of(key));
    for (const CommonEdge& edge : edges) {
        double& state = past_[edge.nearer][static_cast<std::size_t>(LawSlot::adhesion)];
        state = std::max(state, states_.largest(contacts.keys[edge.point], LawSlot::adhesion));
    }
}

void ContactLaws::check_materials(const DetectedContacts& contacts) const {
    const auto refuse = [this](const std::string& who, std::int32_t material) {
        throw std::invalid_argument(who + " has material " + std::to_string(material) +
                                    ", but there are " + std::to_string(surfaces_.size()));
    };
    const Bodies& bodies = contacts.bodies;
    for (std::size_t i = 0; i < bodies.size(); ++i)
        if (bodies.material[i] < 0 || bodies.material[i] >= surfaces_.size())
            refuse("body " + std::to_string(bodies.id[i]), bodies.material[i]);
    for (const Wall& wall : contacts.walls)
        if (wall.material < -1 || wall.material >= surfaces_.size())
            refuse("wall " + std::to_string(wall.key), wall.material);
}

Surface ContactLaws::surface(const DetectedContacts& contacts, const ContactPoint& point) const {
    const std::int32_t own = contacts.bodies.material[point.b];
    if (point.wall < 0) return surfaces_.pair(own, contacts.bodies.material[point.a]);
    const Wall& wall = wall_of(contacts, point);
    if (wall.material >= 0) return surfaces_.pair(own, wall.material);
    return with_friction(surfaces_.pair(own, own), wall.friction);
}

ContactSituation ContactLaws::situation(const DetectedContacts& contacts,
                                        const ContactPoint& point) const {
    ContactSituation s;
    s.gap = point.gap;
    s.surface = surface(contacts, point);
    if (point.a >= 0) s.radius_a = contacts.bodies.radius[point.a];
    s.radius_b = contacts.bodies.radius[point.b];
    s.round = is_round(contacts.bodies, point.a) || is_round(contacts.bodies, point.b);
    s.length = point.length;
    s.initial = states_.initial();
    return s;
}

ContactProblem ContactLaws::pose(const DetectedContacts& contacts, const std::vector<Twist>& free,
                                 Mobilities mobilities, ContactPlaces places, double step) {
    check_materials(contacts);
    ContactProblem problem{std::move(mobilities),   free,        {}, 0.0,
                           std::move(places.cells), places.ranks};
    problem.contacts.reserve(contacts.points.size());
    situations_.clear();
    terms_.clear();
    attraction_.clear();
    const std::vector<CommonEdge> edges = edges_of(contacts);
    const std::vector<double> share = shares(contacts.points, edges);
    take_states(contacts, edges);
    const bool filmed = law_.has(LawSlot::film);
    for (std::size_t k = 0; k < contacts.points.size(); ++k) {
        const ContactPoint& point = contacts.points[k];
        Contact& contact = problem.contacts.emplace_back(bare_contact(point));
        const ContactVector drive = wall_velocity(contacts, point, contact);
        ContactVector approach;
        ContactSituation now = situation(contacts, point);
        now.step = step;
        if (!share.empty()) now.share = share[k];
        const bool gives_way = now.share == 0.0;
        // A round wall pulls a sphere that just fits into it once, where it is nearest.
        if (point.wall >= 0 && is_further_point(wall_of(contacts, point), point)) now.share = 0.0;
        if (law_.reads_velocities()) {
            // u^- = H^T U - v_wall of the start of the step; the same of the free velocities below.
            approach = contact_velocity(contact, contacts.bodies.twist) - drive;
            now.approach = magnitudes(approach);
            now.free = magnitudes(contact_velocity(contact, free) - drive);
            if (filmed) now.mobility = normal_mobility(problem.bodies, contact);
        }
        const ContactState past = law_.remembers() ? past_[k] : ContactState{};
        const LawTerms terms = law_.terms(now, past);
        take_terms(contact, terms, approach, drive);
        if (resists_turning(contact))
            take_spins(contact, terms, relative_spin(contact, contacts.bodies.twist),
                       wall_spin(contacts, point), settings_.dimension == 2);
        // At an edge where another wall is nearer an impact sees the film, which acts there.
        if (filmed)
            problem.films.push_back(gives_way ? Film{}
                                              : film_in(terms.film, terms.normal_bias, step));
        if (law_.remembers()) situations_.push_back(now), terms_.push_back(terms);
        if (terms.attraction != 0.0) {
            attraction_.resize(contacts.points.size(), 0.0);
            // dt c [N s]
            attraction_[k] = step * terms.attraction;
        }
    }
    // A rank without attraction of its own takes part: its bodies may be pulled by contacts of
    // others.
    if (on_any_rank(problem, !attraction_.empty())) pull(problem);
    return problem;
}

// What holds a pair at rest may cancel the attraction to the last digit.
void ContactLaws::pull(ContactProblem& problem) const {
    // With r~ = 0 the bodies feel -dt c n: v_free - dt M^-1 H c n.
    std::vector<Twist> pulled = body_velocities(problem, felt(Impulses(problem.contacts.size())));
    for (std::size_t i = 0; i < pulled.size(); ++i)
        // The largest |dt M^-1 H c|: speeds that may cancel, for the rounding floor of the
        // residual.
        problem.cancelled =
            std::max(problem.cancelled, norm(pulled[i].velocity - problem.free[i].velocity));
    if (problem.ranks) problem.cancelled = problem.ranks->largest(problem.cancelled);
    problem.free = std::move(pulled);
}

Impulses ContactLaws::felt(const Impulses& solution) const {
    Impulses result = solution;
    // r = r~ - dt c n
    for (std::size_t k = 0; k < attraction_.size(); ++k) result[k].n -= attraction_[k];
    return result;
}

void ContactLaws::find_states(const DetectedContacts& contacts, const Impulses& solution) {
    const double rounding = settings_.dimension == 3 ? clip_rounding : 0.0;
    std::vector<RememberedState> next;
    for (std::size_t k = 0; k < situations_.size(); ++k) {
        const ContactKey& key = contacts.keys[k];
        const ContactOutcome outcome{terms_[k], magnitudes(solution[k]), rounding};
        next.push_back({key, law_.remember(situations_[k], past_[k], outcome)});
    }
    states_.find(std::move(next));
}

}  // namespace turbidite::nscd
