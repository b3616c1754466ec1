// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/augmented_system.hpp"

#include <algorithm>
#include <cmath>

#include "granular_adapter/nscd/vec3.hpp"

namespace turbidite::nscd {
namespace {

// Status of a contact: open, or closed with what friction and rolling do.
constexpr std::uint8_t closed = 1, slides_up = 2, slides_down = 4, rolls_up = 8, rolls_down = 16;

/// Lower triangular L, L L^T = M^-1; a direction that nothing moves has a column of zeros.
struct Root {
    double xx = 0.0, yx = 0.0, yy = 0.0, sx = 0.0, sy = 0.0, ss = 0.0;

    explicit Root(const BodyMobility& m) {
        const auto over = [](double value, double pivot) {
            return pivot > 0.0 ? value / pivot : 0.0;
        };
        xx = std::sqrt(m.xx);
        yx = over(m.xy, xx);
        sx = over(m.xs, xx);
        yy = std::sqrt(std::max(0.0, m.yy - yx * yx));
        sy = over(m.ys - sx * yx, yy);
        ss = std::sqrt(std::max(0.0, m.ss - sx * sx - sy * sy));
    }

    /// L^T d.
    std::array<double, 3> transposed(double x, double y, double spin) const {
        return {xx * x + yx * y + sx * spin, yy * y + sy * spin, ss * spin};
    }
};

double dot(const std::array<double, 3>& a, const double* y) {
    return a[0] * y[0] + a[1] * y[1] + a[2] * y[2];
}

}  // namespace

AugmentedSystem::AugmentedSystem(const ContactProblem& problem) {
    links_.reserve(problem.contacts.size());
    for (const Contact& contact : problem.contacts) {
        Link link;
        const Vec3 u = contact_velocity(contact, problem.free);
        for (int d = 0; d < 3; ++d) link.free[d] = u[d] + contact.bias[d];
        link.friction = contact.friction;
        link.rolling = contact.rolling;
        add_end(link, true, contact, problem.bodies[contact.b]);
        if (contact.a >= 0) add_end(link, false, contact, problem.bodies[contact.a]);
        links_.push_back(link);
    }
    lay_pattern(problem.bodies.size());
    impulses_.resize(links_.size());
    statuses_.resize(links_.size());
}

void AugmentedSystem::add_end(Link& link, bool at_b, const Contact& contact,
                              const BodyMobility& body) const {
    const Root root(body);
    const Vec3& arm = at_b ? contact.arm_b : contact.arm_a;
    const auto row = [&](const Vec3& e) { return root.transposed(e[0], e[1], cross(arm, e)[2]); };
    std::array<Row, 3>& rows = at_b ? link.at_b : link.at_a;
    rows = {row(contact.normal), row(contact.tangent), root.transposed(0.0, 0.0, 1.0)};
    (at_b ? link.b : link.a) = at_b ? contact.b : contact.a;
    for (int d = 0; d < 3; ++d) link.diagonal[d] += dot(rows[d], rows[d].data());
}

void AugmentedSystem::lay_pattern(std::size_t bodies) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](std::int32_t i, std::int32_t j) {
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column)
                entries.emplace_back(3 * i + row, 3 * j + column, 0.0);
    };
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(bodies); ++i) add(i, i);
    for (const Link& link : links_)
        if (link.a >= 0) add(link.a, link.b), add(link.b, link.a);
    const auto size = static_cast<Eigen::Index>(3 * bodies);
    jacobian_.resize(size, size);
    jacobian_.setFromTriplets(entries.begin(), entries.end());
    for (const Link& link : links_) {
        std::array<Place, 4> places;
        if (link.a >= 0)
            places = {find(link.a, link.a), find(link.a, link.b), find(link.b, link.a), {}};
        places[3] = find(link.b, link.b);
        places_.push_back(places);
    }
}

AugmentedSystem::Place AugmentedSystem::find(std::int32_t row, std::int32_t column) const {
    Place place;
    for (int c = 0; c < 3; ++c) {
        const int* rows = jacobian_.innerIndexPtr();
        const int first = jacobian_.outerIndexPtr()[3 * column + c];
        const int last = jacobian_.outerIndexPtr()[3 * column + c + 1];
        place.column[c] = std::lower_bound(rows + first, rows + last, 3 * row) - rows;
    }
    return place;
}

void AugmentedSystem::set_weight(double alpha) {
    for (Link& link : links_)
        for (int d = 0; d < 3; ++d) link.weight[d] = alpha * link.diagonal[d];
}

Eigen::VectorXd AugmentedSystem::residual(const Eigen::VectorXd& y) {
    Eigen::VectorXd g = y;
    for (std::size_t k = 0; k < links_.size(); ++k) {
        const Link& link = links_[k];
        std::array<double, 3> u = link.free;
        for (int d = 0; d < 3; ++d) {
            u[d] += dot(link.at_b[d], &y[3 * link.b]);
            if (link.a >= 0) u[d] -= dot(link.at_a[d], &y[3 * link.a]);
        }
        respond(k, u);
        for (int d = 0; d < 3; ++d)
            for (int c = 0; c < 3; ++c) {
                g[3 * link.b + c] -= link.at_b[d][c] * impulses_[k][d];
                if (link.a >= 0) g[3 * link.a + c] += link.at_a[d][c] * impulses_[k][d];
            }
    }
    return g;
}

void AugmentedSystem::respond(std::size_t k, const std::array<double, 3>& u) {
    const Link& link = links_[k];
    Vec3& r = impulses_[k];
    std::uint8_t& status = statuses_[k];
    r = {};
    status = 0;
    const double normal = centre_[k][0] - u[0] / link.weight[0];
    if (!(normal > 0.0)) return;
    r[0] = normal;
    status = closed;
    const auto clamp = [&](int d, double limit, std::uint8_t up, std::uint8_t down) {
        if (link.weight[d] > 0.0) r[d] = centre_[k][d] - u[d] / link.weight[d];
        if (r[d] > limit) r[d] = limit, status |= up;
        if (r[d] < -limit) r[d] = -limit, status |= down;
    };
    clamp(1, link.friction * normal, slides_up, slides_down);
    if (link.rolling > 0.0) clamp(2, link.rolling * normal, rolls_up, rolls_down);
}

/// -S'(u) of a closed contact: rows by impulse, columns by velocity.
std::array<AugmentedSystem::Row, 3> AugmentedSystem::slope(std::size_t k, bool with_sliding) const {
    const Link& link = links_[k];
    const std::uint8_t status = statuses_[k];
    std::array<Row, 3> s{};
    s[0][0] = 1.0 / link.weight[0];
    const auto branch = [&](int d, double limit, std::uint8_t up, std::uint8_t down) {
        if (status & (up | down))
            s[d][0] = with_sliding ? (status & up ? limit : -limit) * s[0][0] : 0.0;
        else if (link.weight[d] > 0.0)
            s[d][d] = 1.0 / link.weight[d];
    };
    branch(1, link.friction, slides_up, slides_down);
    if (link.rolling > 0.0) branch(2, link.rolling, rolls_up, rolls_down);
    return s;
}

const Eigen::SparseMatrix<double>& AugmentedSystem::assemble(bool with_sliding) {
    jacobian_.coeffs().setZero();
    for (Eigen::Index i = 0; i < jacobian_.rows(); ++i) jacobian_.coeffRef(i, i) = 1.0;
    for (std::size_t k = 0; k < links_.size(); ++k) {
        if (statuses_[k] == 0) continue;
        const Link& link = links_[k];
        const std::array<Row, 3> s = slope(k, with_sliding);
        add_block(places_[k][3], link.at_b, s, link.at_b, 1.0);
        if (link.a < 0) continue;
        add_block(places_[k][0], link.at_a, s, link.at_a, 1.0);
        add_block(places_[k][1], link.at_a, s, link.at_b, -1.0);
        add_block(places_[k][2], link.at_b, s, link.at_a, -1.0);
    }
    return jacobian_;
}

/// J(row body, column body) += sign sum_de row_d s_de column_e^T.
void AugmentedSystem::add_block(const Place& place, const std::array<Row, 3>& row,
                                const std::array<Row, 3>& slope, const std::array<Row, 3>& column,
                                double sign) {
    double* values = jacobian_.valuePtr();
    for (int d = 0; d < 3; ++d) {
        Row response{};  // sum_e s_de column_e
        for (int e = 0; e < 3; ++e)
            for (int c = 0; c < 3; ++c) response[c] += slope[d][e] * column[e][c];
        for (int c = 0; c < 3; ++c)
            for (int i = 0; i < 3; ++i)
                values[place.column[c] + i] += sign * row[d][i] * response[c];
    }
}

Eigen::VectorXd AugmentedSystem::velocities_of(const Impulses& r) const {
    Eigen::VectorXd y = Eigen::VectorXd::Zero(jacobian_.rows());
    for (std::size_t k = 0; k < links_.size(); ++k)
        for (int d = 0; d < 3; ++d)
            for (int c = 0; c < 3; ++c) {
                y[3 * links_[k].b + c] += links_[k].at_b[d][c] * r[k][d];
                if (links_[k].a >= 0) y[3 * links_[k].a + c] -= links_[k].at_a[d][c] * r[k][d];
            }
    return y;
}

}  // namespace turbidite::nscd
