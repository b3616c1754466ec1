// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Random contact problems, harder than packings of discs: arms in any direction (W_nt != 0),
// several contacts per pair of bodies, bodies with tied fluid.
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "coupler/rigid/vec3.hpp"
#include "planar.hpp"

namespace turbidite::nscd::problems {

inline PlanarTensor planar(const Eigen::Matrix3d& a) {
    PlanarTensor tensor;
    tensor.xx = a(0, 0), tensor.yy = a(1, 1), tensor.ss = a(2, 2);
    tensor.xy = a(0, 1), tensor.xs = a(0, 2), tensor.ys = a(1, 2);
    return tensor;
}

inline Eigen::Matrix3d dense(const PlanarTensor& t) {
    Eigen::Matrix3d m;
    m << t.xx, t.xy, t.xs, t.xy, t.yy, t.ys, t.xs, t.ys, t.ss;
    return m;
}

struct Recipe {
    int bodies = 12;
    int extra_contacts = 8;  ///< in addition to one contact of each body with the one before
    bool dragging = true;    ///< full mobilities instead of diagonal ones
    double friction = 1.0;   ///< upper limit
    double rolling = 0.0;    ///< upper limit [m]
    unsigned seed = 1;
};

/// Bodies that fall onto each other and onto a floor. Body 0 is fixed, body 1 cannot rotate.
/// Normals are tilted by at most 0.7, with tan 0.7 < 1. If bodies rise faster the higher they are,
/// all contacts open with u_n > mu |u_t|; a solution therefore exists for every friction up to 1.
inline ContactProblem random_problem(const Recipe& recipe) {
    std::mt19937_64 random(recipe.seed);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    ContactProblem problem;
    for (int i = 0; i < recipe.bodies; ++i) {
        Eigen::Matrix3d b;
        for (int k = 0; k < 9; ++k) b(k) = 0.5 * any(random);
        const Eigen::Matrix3d drag = b.transpose() * b;
        BodyMobility m = recipe.dragging ? planar(drag + 0.5 * Eigen::Matrix3d::Identity())
                                         : BodyMobility(1.5 + any(random), 4.0 + any(random));
        if (i == 0) m = {};
        if (i == 1) m = {1.0, 0.0};
        nscd::planar::bodies(problem).push_back(m);
        problem.free.push_back({{any(random), -2.0 + any(random), 0.0}, {0.0, 0.0, any(random)}});
    }
    problem.free[0] = {};
    const auto touch = [&](int a, int b) {
        Contact contact;
        contact.a = a, contact.b = b;
        const double angle = 0.7 * any(random);
        contact.normal = {std::sin(angle), std::cos(angle), 0.0};
        contact.tangent = tangent_of(contact.normal);
        contact.arm_a = {0.5 * any(random), 0.5 * any(random), 0.0};
        contact.arm_b = {0.5 * any(random), 0.5 * any(random), 0.0};
        contact.friction = 0.5 * recipe.friction * (1.0 + any(random));
        contact.rolling = 0.5 * recipe.rolling * (1.0 + any(random));
        contact.bias = in_plane(0.2 * any(random), 0.0);
        problem.contacts.push_back(contact);
    };
    for (int i = 1; i < recipe.bodies; ++i) touch(i % 4 == 1 ? -1 : i - 1, i);
    for (int k = 0; k < recipe.extra_contacts; ++k) {
        const int b = 1 + static_cast<int>(random() % (recipe.bodies - 1));
        touch(static_cast<int>(random() % b), b);
    }
    return problem;
}

/// H^T M^-1 H by dense algebra, rows and columns (n, t) of each contact.
inline Eigen::MatrixXd dense_delassus(const ContactProblem& problem) {
    const auto n = static_cast<int>(problem.contacts.size());
    const auto m = static_cast<int>(size(problem.bodies));
    Eigen::MatrixXd h = Eigen::MatrixXd::Zero(3 * m, 2 * n);
    Eigen::MatrixXd mobility = Eigen::MatrixXd::Zero(3 * m, 3 * m);
    for (int i = 0; i < m; ++i)
        mobility.block<3, 3>(3 * i, 3 * i) = dense(nscd::planar::bodies(problem)[i]);
    for (int k = 0; k < n; ++k) {
        const Contact& c = problem.contacts[k];
        const auto add = [&](std::int32_t body, const Vec3& arm, double sign) {
            for (int d = 0; body >= 0 && d < 2; ++d) {
                const Vec3& e = d == 0 ? c.normal : c.tangent;
                h.block<3, 1>(3 * body, 2 * k + d) +=
                    sign * Eigen::Vector3d(e[0], e[1], cross(arm, e)[2]);
            }
        };
        add(c.a, c.arm_a, -1.0);
        add(c.b, c.arm_b, 1.0);
    }
    return h.transpose() * mobility * h;
}

}  // namespace turbidite::nscd::problems
