// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A velocity or an impulse in the frame of its contact:
//
//     n      along the normal, from a to b                                    [m/s] [N s]
//     t, s   along the two tangents, s = n x t                                [m/s] [N s]
//     roll   about e_z: spin of b relative to a, moment impulse on b   [rad/s] [N m s]
//
// In the plane s = e_z: there is no motion along it, and every spin is about it. `roll` is of the
// plane only: in space spins and moments are vectors.
#pragma once

#include <cmath>

namespace turbidite::nscd {

struct ContactVector {
    double n = 0.0;
    double t = 0.0;
    double s = 0.0;
    double roll = 0.0;

    constexpr ContactVector() = default;
    constexpr ContactVector(double n, double t, double s, double roll)
        : n(n), t(t), s(s), roll(roll) {}

    bool operator==(const ContactVector&) const = default;

    friend ContactVector operator+(const ContactVector& a, const ContactVector& b) {
        return {a.n + b.n, a.t + b.t, a.s + b.s, a.roll + b.roll};
    }
    friend ContactVector operator-(const ContactVector& a, const ContactVector& b) {
        return {a.n - b.n, a.t - b.t, a.s - b.s, a.roll - b.roll};
    }
    friend ContactVector operator*(double factor, const ContactVector& a) {
        return {factor * a.n, factor * a.t, factor * a.s, factor * a.roll};
    }

    /// r . u, the work of an impulse.
    friend double dot(const ContactVector& a, const ContactVector& b) {
        return a.n * b.n + a.t * b.t + a.s * b.s + a.roll * b.roll;
    }

    /// Magnitude of the normal and tangential part, without rolling.
    friend double norm(const ContactVector& u) {
        return std::sqrt(u.n * u.n + u.t * u.t + u.s * u.s);
    }
};

/// A vector of the plane: s = 0.
constexpr ContactVector in_plane(double n, double t, double roll = 0.0) {
    return {n, t, 0.0, roll};
}

/// |u_t|, the magnitude of the tangential part.
inline double tangential(const ContactVector& u) {
    return std::hypot(u.t, u.s);
}

}  // namespace turbidite::nscd
