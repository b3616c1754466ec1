// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact problem with a proximal term, as a semi-smooth equation for the velocities of the
// bodies. Around a centre c (impulses) every contact alone has the regularised law
//
//     u + P (r - c)  in the place of u,   P = alpha diag(W_kk)
//
// which, P being diagonal, gives r explicitly as a function S of u: Signorini's r_n =
// max(0, c_n - u_n/P_n), then friction and rolling clamp c_t - u_t/P_t and c_w - w/P_w to mu r_n
// and rolling r_n. With M^-1 = L L^T per body and v = v_free + L y what remains is
//
//     G(y) = y - L^T H S(u(y)) = 0,      J = 1 - L^T H S'(u) H^T L
//
// three unknowns per body however many contacts there are. J is regular whatever the rank of W,
// symmetric positive definite while no contact slides, and constant while none changes its status.
// A solution with r = c solves the contact problem itself: Coulomb's exact law, not its convex
// relative.
#pragma once

#include <Eigen/SparseCore>
#include <array>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/contact_problem.hpp"

namespace turbidite::nscd {

class AugmentedSystem {
 public:
    explicit AugmentedSystem(const ContactProblem& problem);

    /// P for the relative weight alpha > 0.
    void set_weight(double alpha);
    void set_centre(const Impulses& c) { centre_ = c; }

    /// Sets impulses() to S(u(y)) and returns G.
    Eigen::VectorXd residual(const Eigen::VectorXd& y);

    /// J at the statuses of the last residual(); the pattern is the same every time.
    const Eigen::SparseMatrix<double>& jacobian() { return assemble(true); }

    /// The same without what makes it unsymmetric, the dependence of sliding on the normal:
    /// symmetric positive definite.
    const Eigen::SparseMatrix<double>& symmetric_jacobian() { return assemble(false); }

    /// y of the velocities that impulses r cause.
    Eigen::VectorXd velocities_of(const Impulses& r) const;

    /// S(u(y)) of the last residual(): within the cones to the last bit.
    const Impulses& impulses() const { return impulses_; }

    /// Open, sticking or sliding which way, per contact, at the last residual().
    const std::vector<std::uint8_t>& statuses() const { return statuses_; }

 private:
    using Row = std::array<double, 3>;

    /// One contact: rows of L^T H on either side for n, t and rolling.
    struct Link {
        std::int32_t a = -1, b = -1;  ///< -1: nothing that moves
        std::array<Row, 3> at_a{}, at_b{};
        std::array<double, 3> free{};      ///< u with v_free, and bias
        std::array<double, 3> diagonal{};  ///< W_kk
        std::array<double, 3> weight{};    ///< P
        double friction = 0.0, rolling = 0.0;
    };
    /// Where the 3x3 block (row body, column body) starts, by columns, in the values of J.
    struct Place {
        std::array<std::int64_t, 3> column{};
    };

    void add_end(Link& link, bool at_b, const Contact& contact, const BodyMobility& body) const;
    void lay_pattern(std::size_t bodies);
    Place find(std::int32_t row, std::int32_t column) const;
    void respond(std::size_t k, const std::array<double, 3>& u);
    std::array<Row, 3> slope(std::size_t k, bool with_sliding) const;
    const Eigen::SparseMatrix<double>& assemble(bool with_sliding);
    void add_block(const Place& place, const std::array<Row, 3>& row,
                   const std::array<Row, 3>& slope, const std::array<Row, 3>& column, double sign);

    std::vector<Link> links_;
    std::vector<std::array<Place, 4>> places_;  ///< aa, ab, ba, bb of each link
    Eigen::SparseMatrix<double> jacobian_;
    Impulses centre_, impulses_;
    std::vector<std::uint8_t> statuses_;
};

}  // namespace turbidite::nscd
