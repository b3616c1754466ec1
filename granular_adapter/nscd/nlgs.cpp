// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/nlgs.hpp"

#include <algorithm>
#include <stdexcept>

#include "granular_adapter/nscd/delassus.hpp"
#include "granular_adapter/nscd/residual.hpp"
#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

// All that a sweep touches: four doubles per body, one flat row per contact, nothing indirect
// beside the two bodies. Static partners are the body after the last one, which nothing moves.
struct PlaneBody {
    double x = 0.0, y = 0.0, spin = 0.0;
    double inverse_mass = 0.0;  ///< read where mobilities are isotropic
};

/// What rows of both kinds share. Moment arms are (arm x d)_z for d = n, t [m].
struct RowBase {
    std::int32_t a, b;
    double nx, ny;
    double bias_n, bias_t;
    double friction;
    double rn, rt;
};

/// W_nt = 0 and isotropic bodies: discs, and whatever touches with arms along the normal.
struct DiagonalRow : RowBase {
    double arm_a, arm_b;    ///< tangential
    double turn_a, turn_b;  ///< the same over the moment of inertia
    double inverse_nn, inverse_tt;

    DiagonalRow(const RowBase& base, const Contact& contact, const Block& w, const BodyMobility& a,
                const BodyMobility& b)
        : RowBase(base),
          arm_a(cross(contact.arm_a, contact.tangent)[2]),
          arm_b(cross(contact.arm_b, contact.tangent)[2]),
          turn_a(a.ss * arm_a),
          turn_b(b.ss * arm_b),
          inverse_nn(1.0 / w.nn),
          inverse_tt(1.0 / w.tt) {}

    double rho() const { return inverse_nn; }

    Plane velocity(const PlaneBody& va, const PlaneBody& vb) const {
        const double dx = vb.x - va.x, dy = vb.y - va.y;
        return {nx * dx + ny * dy + bias_n,
                nx * dy - ny * dx + arm_b * vb.spin - arm_a * va.spin + bias_t};
    }

    /// Exact: with W_nt = 0 the normal does not feel the tangent, and friction is a clamp.
    Plane solve(const Plane& u) const {
        const double n = std::max(0.0, rn - u[0] * inverse_nn);
        const double limit = friction * n;
        return {n, std::min(limit, std::max(-limit, rt - u[1] * inverse_tt))};
    }

    /// v += M^-1 H d.
    void push(PlaneBody& va, PlaneBody& vb, const Plane& d) const {
        const double px = nx * d[0] - ny * d[1], py = ny * d[0] + nx * d[1];
        va.x -= va.inverse_mass * px;
        va.y -= va.inverse_mass * py;
        vb.x += vb.inverse_mass * px;
        vb.y += vb.inverse_mass * py;
        va.spin -= turn_a * d[1];
        vb.spin += turn_b * d[1];
    }
};

/// Any W, any mobility. What a unit impulse along n or t does to each body is known before the
/// sweeps, so that a push is one multiplication and addition per component and direction.
struct FullRow : RowBase {
    Plane arm_a, arm_b;
    PlanarVector a_n, a_t, b_n, b_t;  ///< M^-1 (d, arm x d), d = n, t
    Block w;

    FullRow(const RowBase& base, const Contact& contact, const Block& block, const BodyMobility& a,
            const BodyMobility& b)
        : RowBase(base),
          arm_a{cross(contact.arm_a, contact.normal)[2], cross(contact.arm_a, contact.tangent)[2]},
          arm_b{cross(contact.arm_b, contact.normal)[2], cross(contact.arm_b, contact.tangent)[2]},
          a_n(a * PlanarVector{nx, ny, arm_a[0]}),
          a_t(a * PlanarVector{-ny, nx, arm_a[1]}),
          b_n(b * PlanarVector{nx, ny, arm_b[0]}),
          b_t(b * PlanarVector{-ny, nx, arm_b[1]}),
          w(block) {}

    double rho() const { return 1.0 / w.nn; }

    Plane velocity(const PlaneBody& va, const PlaneBody& vb) const {
        const double dx = vb.x - va.x, dy = vb.y - va.y;
        return {nx * dx + ny * dy + arm_b[0] * vb.spin - arm_a[0] * va.spin + bias_n,
                nx * dy - ny * dx + arm_b[1] * vb.spin - arm_a[1] * va.spin + bias_t};
    }

    Plane solve(const Plane& u) const {
        return solve_contact(w, {u[0] - w.nn * rn - w.nt * rt, u[1] - w.nt * rn - w.tt * rt},
                             friction);
    }

    /// v += M^-1 H d.
    void push(PlaneBody& va, PlaneBody& vb, const Plane& d) const {
        va.x -= a_n.x * d[0] + a_t.x * d[1];
        va.y -= a_n.y * d[0] + a_t.y * d[1];
        va.spin -= a_n.spin * d[0] + a_t.spin * d[1];
        vb.x += b_n.x * d[0] + b_t.x * d[1];
        vb.y += b_n.y * d[0] + b_t.y * d[1];
        vb.spin += b_n.spin * d[0] + b_t.spin * d[1];
    }
};

/// sum |natural map|^2 and sum |r|^2 of a pass.
struct PassSums {
    double error = 0.0;
    double size = 0.0;

    template <class Row>
    void add(const Row& row, const Plane& u) {
        const Plane f = natural_map({row.rn, row.rt}, u, row.friction, row.rho());
        error += f[0] * f[0] + f[1] * f[1];
        size += row.rn * row.rn + row.rt * row.rt;
    }
};

template <bool measure, class Row>
PassSums sweep(std::vector<Row>& rows, std::vector<PlaneBody>& bodies) {
    PassSums sums;
    for (Row& row : rows) {
        PlaneBody& va = bodies[row.a];
        PlaneBody& vb = bodies[row.b];
        const Plane u = row.velocity(va, vb);
        if constexpr (measure) sums.add(row, u);
        const Plane r = row.solve(u);
        row.push(va, vb, {r[0] - row.rn, r[1] - row.rt});
        row.rn = r[0];
        row.rt = r[1];
    }
    return sums;
}

/// Bodies in the order in which contacts meet them, so that a sweep walks through memory: slot of
/// each body, -1 if nothing touches it. The slot after the last is the body at rest.
struct Slots {
    std::vector<std::int32_t> of_body;
    std::int32_t at_rest = 0;

    explicit Slots(const ContactProblem& problem) : of_body(problem.bodies.size(), -1) {
        const auto meet = [this](std::int32_t body) {
            if (body >= 0 && of_body[body] < 0) of_body[body] = at_rest++;
        };
        for (const Contact& contact : problem.contacts) meet(contact.a), meet(contact.b);
    }

    std::int32_t operator()(std::int32_t body) const { return body < 0 ? at_rest : of_body[body]; }
};

std::vector<PlaneBody> pack_bodies(const ContactProblem& problem, const Slots& slots,
                                   const Impulses& guess) {
    const std::vector<Twist> start = body_velocities(problem, guess);
    std::vector<PlaneBody> bodies(static_cast<std::size_t>(slots.at_rest) + 1);
    for (std::size_t i = 0; i < start.size(); ++i)
        if (slots.of_body[i] >= 0)
            bodies[slots.of_body[i]] = {start[i].velocity[0], start[i].velocity[1],
                                        start[i].spin[2], problem.bodies[i].xx};
    return bodies;
}

template <class Row>
std::vector<Row> pack_rows(const ContactProblem& problem, const Delassus& w, const Slots& slots,
                           const Impulses& guess) {
    std::vector<Row> rows;
    rows.reserve(guess.size());
    for (std::size_t k = 0; k < guess.size(); ++k) {
        const Contact& c = problem.contacts[k];
        const RowBase base{slots(c.a), slots(c.b), c.normal[0], c.normal[1], c.bias[0],
                           c.bias[1],  c.friction, guess[k][0], guess[k][1]};
        const BodyMobility a = c.a < 0 ? BodyMobility() : problem.bodies[c.a];
        rows.emplace_back(base, c, w.block(k), a, problem.bodies[c.b]);
    }
    return rows;
}

template <class Row>
void unpack(const std::vector<Row>& rows, Impulses& r) {
    for (std::size_t k = 0; k < rows.size(); ++k) r[k] = {rows[k].rn, rows[k].rt, 0.0};
}

/// Early sweeps are looked at often, since a warm start may be done at once.
bool check_due(std::int64_t sweep_number, const SolverSettings& settings) {
    const bool power_of_two = (sweep_number & (sweep_number - 1)) == 0;
    return sweep_number % settings.check_interval == 0 || sweep_number >= settings.max_iterations ||
           (sweep_number < settings.check_interval && power_of_two);
}

template <class Row>
SolverResult iterate(const ContactProblem& problem, const Delassus& w, const Impulses& guess,
                     const SolverSettings& settings) {
    const Slots slots(problem);
    std::vector<PlaneBody> bodies = pack_bodies(problem, slots, guess);
    std::vector<Row> rows = pack_rows<Row>(problem, w, slots, guess);
    const double floor = rounding_floor(problem);
    const double target = settings.tolerance * settings.tolerance;
    SolverResult result;
    result.impulses = guess;
    result.converged = false;
    while (!result.converged && result.iterations < settings.max_iterations) {
        if (!check_due(++result.iterations, settings)) {
            sweep<false>(rows, bodies);
            continue;
        }
        const PassSums sums = sweep<true>(rows, bodies);
        const bool last = result.iterations == settings.max_iterations;
        if (!last && !(sums.error <= target * (sums.size + floor))) continue;
        unpack(rows, result.impulses);
        result.residual = natural_map_residual(problem, result.impulses);
        result.change = change_measures(problem, result.impulses);
        result.converged = result.residual <= settings.tolerance;
    }
    result.velocities = body_velocities(problem, result.impulses);
    return result;
}

void check_settings(const SolverSettings& settings) {
    if (!(settings.tolerance > 0.0) || settings.max_iterations < 1 || settings.check_interval < 1)
        throw std::invalid_argument(
            "contact solver: tolerance, iterations and check interval must be positive");
}

}  // namespace

SolverResult Nlgs::solve(const ContactProblem& problem, const Impulses& guess,
                         const SolverSettings& settings) const {
    check_settings(settings);
    if (problem.contacts.empty()) return {{}, problem.free, 0, 0.0, {}, true};
    const Delassus w(problem);
    if (w.diagonal()) return iterate<DiagonalRow>(problem, w, guess, settings);
    return iterate<FullRow>(problem, w, guess, settings);
}

}  // namespace turbidite::nscd
