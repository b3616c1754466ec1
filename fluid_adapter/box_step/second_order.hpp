// SPDX-License-Identifier: GPL-2.0-or-later
//
// Steps 2 and 3 of second order in time, for any step that can convect and diffuse a velocity.
// Between two projections the window solves
//
//     du/dt = C + nu laplacian(u),    C = mean of -div(phi u) over the window
//
// C is second-order accurate: phi is the solenoidal flux at the middle of the window, extrapolated
// from the last two projections, and u follows
//
//     du/dt = -div(phi u) + s,    s = (u1^n - u2^{n-1})/dt
//
// by the third-order Runge-Kutta scheme of Shu and Osher (1988), in sub-steps of a limited Courant
// number. s is what viscosity, grains and pressure did to the velocity in the last window; it only
// steers the stages and is taken off again at the end (u2), so that step 2 remains conservative:
//
//     v1 = v + d L(v)
//     v2 = 3/4 v + 1/4 (v1 + d L(v1))
//     v  = 1/3 v + 2/3 (v2 + d L(v2))          fluxes: 1/6 (first), 1/6 (second), 2/3 (third)
//
// Step 3 integrates nu laplacian(u) + C with the two-stage SDIRK method of Alexander (1977), second
// order, L-stable and stiffly accurate, both stages with the same matrix; g = 1 - 1/sqrt(2),
// c = u2 - u1 = dt C:
//
//     (1 - g dt nu laplacian) y1 = u1 + g c
//     (1 - g dt nu laplacian) u3 = u1 + (1 - g)/g (y1 - u1) + g c
//
// The first window knows no earlier one: s = 0, and phi is its own. Its error of second order does
// not lower the order of the run. Valid C++17.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace turbidite {

/// A contiguous part of the velocity.
struct VelocityValues {
    double* first;
    std::size_t count;
};

/// What crosses the sides, as BoxStep::Force.
using SideForce = std::array<double, 2>;

/// The step that knows mesh and operators.
class SecondOrderHost {
 public:
    virtual ~SecondOrderHost() = default;

    virtual std::vector<VelocityValues> velocity_values() = 0;
    virtual void velocity_changed() = 0;  ///< through these values

    /// u -= dt div(phi u); returns what crosses the sides by it, taken before.
    virtual SideForce convect(double dt) = 0;

    /// Implicit Euler over dt; returns what crosses the sides by it, taken after.
    virtual SideForce diffuse_implicitly(double dt) = 0;
};

class SecondOrder {
 public:
    /// Courant number up to which a sub-step is stable, central fluxes included: the limit of the
    /// scheme is 1.73 for these, 1.91 for LUST and 1.17 for linearUpwind.
    static constexpr double largest_courant = 1.0;

    /// u1 becomes u2. Returns one force per sub-step.
    std::vector<SideForce> transport(SecondOrderHost& host, double dt, int parts);

    /// u2 becomes u3.
    SideForce diffuse(SecondOrderHost& host, double dt);

    /// Is there an earlier window?
    bool goes_on() const { return goes_on_; }

    /// The velocity was changed from outside: begins anew.
    void forget() { goes_on_ = false; }

    /// u2 of the last window, of all pieces, and whether there was one.
    void append_memory(SecondOrderHost& host, std::vector<double>& values);

    /// From what append_memory appended.
    void set_memory(SecondOrderHost& host, const double* values);

 private:
    using Pieces = std::vector<std::vector<double>>;

    void copy(SecondOrderHost& host, Pieces& to) const;
    SideForce sub_step(SecondOrderHost& host, double share, bool last);
    void combine(SecondOrderHost& host, const Pieces& v, double old_share, double new_share,
                 double rate_share) const;

    double dt_ = 0.0;
    Pieces window_start_, part_start_;  // u1, v
    Pieces carried_;                    // u2, of the last window until this one has its own
    bool goes_on_ = false;
};

}  // namespace turbidite
