// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The general code (measures, schedule, layout, pipeline, nlgs) takes another kind of contact than
// that of the plane: spheres, as plainly as possible and for this test alone.
#include <gtest/gtest.h>

#include <random>

#include "granular_adapter/nscd/problem/plane/one_contact.hpp"
#include "granular_adapter/nscd/solvers/nlgs_iteration.hpp"

namespace turbidite::nscd {
namespace spheres {

struct SphereMobility {
    double linear = 0.0, angular = 0.0;  ///< 1/m, 1/I
};

bool is_immovable(const SphereMobility& body) {
    return body.linear == 0.0 && body.angular == 0.0;
}

void push(Twist& twist, const SphereMobility& body, const Vec3& arm, const Vec3& p, double) {
    twist.velocity = twist.velocity + body.linear * p;
    twist.spin = twist.spin + body.angular * cross(arm, p);
}

/// Arms are along the normal: normal and tangents are uncoupled, and both tangents are alike.
struct SphereBlock {
    double nn = 0.0, tt = 0.0;
    const Film* film = nullptr;  // it has none
};

/// The tangential part of x, not longer than `most`.
ContactVector clipped(const ContactVector& x, double most) {
    const double size = tangential(x), factor = size > most ? most / size : 1.0;
    return {0.0, factor * x.t, factor * x.s, 0.0};
}

ContactVector solution(const Contact& contact, const SphereBlock& w, const ContactVector& b) {
    const double n = std::max(0.0, -b.n / w.nn);
    ContactVector r = clipped((-1.0 / w.tt) * b, contact.friction * n);
    r.n = n;
    return r;
}

MapTerms map_terms(const Contact& contact, const SphereBlock& w, const ContactVector& r,
                   const ContactVector& u) {
    const double mu = contact.friction;
    ContactVector target = r - (1.0 / w.nn) * u;
    target.n -= mu * tangential(u) / w.nn;
    const Plane nearest = project_on_cone({target.n, tangential(target)}, mu);
    ContactVector f = r - clipped(target, nearest[1]);
    f.n = r.n - nearest[0];
    return {dot(f, f), dot(r, r)};
}

ContactVector product(const SphereBlock& w, const ContactVector& r) {
    return {w.nn * r.n, w.tt * r.t, w.tt * r.s, 0.0};
}

double squared(const SphereBlock&, const ContactVector& u) {
    return u.n * u.n + u.t * u.t + u.s * u.s;
}

class SphereOperator {
 public:
    using Mobility = SphereMobility;
    using Block = SphereBlock;

    SphereOperator(const ContactProblem& problem, std::vector<SphereMobility> bodies)
        : bodies_(std::move(bodies)) {
        for (const Contact& contact : problem.contacts) {
            SphereBlock w;
            const auto add = [&](const SphereMobility& body, const Vec3& arm) {
                w.nn += body.linear;
                w.tt += body.linear + body.angular * dot(arm, arm);
            };
            add(bodies_[contact.b], contact.arm_b);
            if (contact.a >= 0) add(bodies_[contact.a], contact.arm_a);
            blocks_.push_back(w);
        }
    }

    const std::vector<SphereMobility>& bodies() const { return bodies_; }
    const SphereBlock& block(std::size_t contact) const { return blocks_[contact]; }

 private:
    std::vector<SphereMobility> bodies_;
    std::vector<SphereBlock> blocks_;
};

struct SphereBody {
    Vec3 velocity{}, spin{};
    double linear = 0.0, angular = 0.0;
};

SphereBody packed_body(const Twist& v, const SphereMobility& body) {
    return {v.velocity, v.spin, body.linear, body.angular};
}

void copy_rates(const SphereBody& from, double* to) {
    std::copy_n(from.velocity.begin(), 3, to);
    std::copy_n(from.spin.begin(), 3, to + 3);
}
void set_rates(SphereBody& to, const double* from) {
    std::copy_n(from, 3, to.velocity.begin());
    std::copy_n(from + 3, 3, to.spin.begin());
}

struct SphereRows {
    static constexpr int width = 1;
    using Base = SphereRows;
    using Body = SphereBody;

    Lanes<1> rn;
    double rt = 0.0, rs = 0.0;
    double bias_n = 0.0, bias_t = 0.0, bias_s = 0.0, friction = 0.0;
    double nn = 1.0, tt = 1.0;
    Vec3 normal{}, tangent{}, arm_a{}, arm_b{};
    std::int32_t a[1] = {}, b[1] = {};

    Contact contact() const {
        Contact c;
        c.a = 0, c.b = 1, c.normal = normal, c.tangent = tangent, c.arm_a = arm_a, c.arm_b = arm_b;
        c.friction = friction, c.bias = {bias_n, bias_t, bias_s, 0.0};
        return c;
    }
};

ContactVector impulse(const SphereRows& row, int) {
    return {row.rn.v[0], row.rt, row.rs, 0.0};
}

std::array<Lanes<1>, 3> impulse_lanes(const SphereRows& row) {
    return {row.rn, Lanes<1>{{row.rt}}, Lanes<1>{{row.rs}}};
}
void set_impulse_lanes(SphereRows& row, const std::array<Lanes<1>, 3>& r) {
    row.rn = r[0], row.rt = r[1].v[0], row.rs = r[2].v[0];
}

void fill(SphereRows& row, int, const ContactToPack<SphereMobility, SphereBlock>& packed) {
    const Contact& c = packed.contact;
    row.rn.v[0] = packed.r.n, row.rt = packed.r.t, row.rs = packed.r.s;
    row.bias_n = c.bias.n, row.bias_t = c.bias.t, row.bias_s = c.bias.s;
    row.friction = c.friction, row.nn = packed.w.nn, row.tt = packed.w.tt;
    row.normal = c.normal, row.tangent = c.tangent, row.arm_a = c.arm_a, row.arm_b = c.arm_b;
    row.a[0] = packed.slot_a, row.b[0] = packed.slot_b;
}

void fill_empty(SphereRows& row, int, std::int32_t slot) {
    row.a[0] = row.b[0] = slot, row.bias_n = 1.0;
}

namespace portable {
#include "granular_adapter/nscd/sweeps/lane_kernel.hpp"

ContactVector velocity(const SphereRows& row, const SphereBody* bodies) {
    const SphereBody &a = bodies[row.a[0]], &b = bodies[row.b[0]];
    return biased_velocity(row.contact(), {{a.velocity, a.spin}, {b.velocity, b.spin}});
}

bool needs_update(const SphereRows& row, const SphereBody* bodies) {
    return row.rn.v[0] > 0.0 || velocity(row, bodies).n < 0.0;
}

void push_slot(SphereBody& body, const Vec3& arm, const Vec3& p) {
    Twist twist{body.velocity, body.spin};
    push(twist, SphereMobility{body.linear, body.angular}, arm, p, 0.0);
    body.velocity = twist.velocity, body.spin = twist.spin;
}

template <bool measure>
void update(SphereRows& row, SphereBody* bodies, PassSums<1>& sums) {
    const Contact contact = row.contact();
    const SphereBlock w{row.nn, row.tt};
    const ContactVector r = impulse(row, 0), u = velocity(row, bodies);
    const ContactVector next = solution(contact, w, u - product(w, r));
    if constexpr (measure) {
        const MapTerms term = map_terms(contact, w, r, u);
        sums.error.v[0] += term.error, sums.size.v[0] += term.size;
        count_loaded(sums, next.n);
    }
    const Vec3 p = world_impulse(contact, next - r);
    push_slot(bodies[row.a[0]], row.arm_a, -p);
    push_slot(bodies[row.b[0]], row.arm_b, p);
    row.rn.v[0] = next.n, row.rt = next.t, row.rs = next.s;
}

#include "granular_adapter/nscd/sweeps/sweep_loops.hpp"
}  // namespace portable
}  // namespace spheres

template <>
Sweeps<spheres::SphereRows> portable_sweeps() {
    return spheres::portable::sweeps<spheres::SphereRows>();
}

template <>
Sweeps<spheres::SphereRows> avx2_sweeps() {
    return portable_sweeps<spheres::SphereRows>();
}

namespace {

using namespace spheres;

// R = 1/2, m = 1, I = 2/5 m R^2.
constexpr double radius = 0.5;
constexpr SphereMobility ball{1.0, 10.0};

Contact touch(std::int32_t a, std::int32_t b, const Vec3& normal, double friction) {
    Contact contact;
    contact.a = a, contact.b = b, contact.normal = normal, contact.tangent = tangent_of(normal);
    if (a >= 0) contact.arm_a = radius * normal;
    contact.arm_b = -radius * normal;
    contact.friction = friction;
    return contact;
}

SolverResult solve(const ContactProblem& problem, const SphereOperator& w, double tolerance) {
    SolverSettings settings;
    settings.tolerance = tolerance;
    settings.max_iterations = 100000;
    const Impulses guess(problem.contacts.size());
    const NlgsCall<SphereOperator> call{problem, w, guess, settings, Instructions::portable};
    return NlgsIteration<SphereRows, SphereOperator>(call).run();
}

// Speed 5 along (0.6, 0, 0.8) and 1 downwards: r_n = 1. To roll takes 2/7 of the speed from it, to
// slide mu r_n.
TEST(SecondKind, ABallOnAFloorRollsOrSlides) {
    for (const double mu : {2.0, 0.25}) {
        ContactProblem problem;
        problem.free = {{{3.0, -1.0, 4.0}, {}}};
        problem.contacts = {touch(-1, 0, {0.0, 1.0, 0.0}, mu)};
        const SphereOperator w(problem, {ball});
        const SolverResult result = solve(problem, w, 1e-13);
        const double speed = mu == 2.0 ? 5.0 * 5.0 / 7.0 : 5.0 - mu;
        const Vec3& v = result.velocities[0].velocity;
        EXPECT_NEAR(v[0], 0.6 * speed, 1e-14);
        EXPECT_NEAR(v[1], 0.0, 1e-14);
        EXPECT_NEAR(v[2], 0.8 * speed, 1e-14);
        EXPECT_NEAR(norm(result.velocities[0].spin), 10.0 * radius * (5.0 - speed), 1e-13);
    }
}

// A cubic array that falls apart sideways onto a floor: the reported residual is that of one
// consistent state.
TEST(SecondKind, AHeapOfBallsIsSolved) {
    constexpr int n = 5;
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> any(-0.5, 0.5);
    ContactProblem problem;
    const auto at = [](int x, int y, int z) { return (y * n + z) * n + x; };
    for (int y = 0; y < n; ++y)
        for (int z = 0; z < n; ++z)
            for (int x = 0; x < n; ++x) {
                const int own = at(x, y, z);
                problem.free.push_back({{any(random), any(random) - 1.0, any(random)},
                                        {any(random), any(random), any(random)}});
                problem.contacts.push_back(
                    touch(y > 0 ? at(x, y - 1, z) : -1, own, {0, 1, 0}, 0.3));
                if (x > 0) problem.contacts.push_back(touch(at(x - 1, y, z), own, {1, 0, 0}, 0.3));
                if (z > 0) problem.contacts.push_back(touch(at(x, y, z - 1), own, {0, 0, 1}, 0.3));
            }
    const SphereOperator w(problem, std::vector<SphereMobility>(problem.free.size(), ball));
    const SolverResult result = solve(problem, w, 1e-10);
    ASSERT_TRUE(result.converged) << result.residual;
    const std::vector<Twist> v = body_velocities(problem, w.bodies(), result.impulses);
    EXPECT_EQ(result.residual,
              natural_map_residual(problem, w, v, result.impulses, rounding_floor(problem, w)));
    int sliding = 0, sticking = 0;
    for (const ContactVector& r : result.impulses) {
        EXPECT_LE(tangential(r), 0.3 * r.n * (1.0 + 1e-12));
        if (r.n > 0.0) ++(tangential(r) > 0.3 * r.n * (1.0 - 1e-9) ? sliding : sticking);
    }
    EXPECT_GT(sliding, 20);
    EXPECT_GT(sticking, 20);
}

// Orthogonal and of length 1 whatever the normal; in the plane exactly e_z x n.
TEST(Frames, AreOrthonormal) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> any;
    for (int i = 0; i < 1000; ++i) {
        Vec3 n{any(random), any(random), any(random)};
        n = (1.0 / norm(n)) * n;
        const Contact contact = touch(-1, 0, n, 0.0);
        EXPECT_NEAR(norm(contact.tangent), 1.0, 1e-14);
        EXPECT_NEAR(dot(contact.tangent, n), 0.0, 1e-14);
        EXPECT_NEAR(norm(binormal_of(contact)), 1.0, 1e-14);
    }
    EXPECT_EQ(tangent_of({0.6, 0.8, 0.0}), (Vec3{-0.8, 0.6, 0.0}));
    EXPECT_EQ(tangent_of({0.0, 0.0, -1.0}), (Vec3{1.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace turbidite::nscd
