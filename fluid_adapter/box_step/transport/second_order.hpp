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
//     du/dt = L(u) + s,    L(u) = -div(phi u),    s = (u1^n - u2^{n-1})/dt
//
// by the third-order Runge-Kutta scheme of Shu and Osher (1988), in sub-steps of a limited Courant
// number. s is what viscosity, grains and pressure did to the velocity in the last window; it only
// steers the stages and is taken off again at the end (u2), so that step 2 remains conservative:
//
//     v1 = v + d L(v)
//     v2 = 3/4 v + 1/4 (v1 + d L(v1))
//     v  = 1/3 v + 2/3 (v2 + d L(v2))          fluxes: 1/6 (first), 1/6 (second), 2/3 (third)
//
// Where cells are large against the way that momentum diffuses in a window, L contains viscosity
// as well, u2 is u3, and step 3 has nothing left to do: no linear system. Elsewhere step 3
// integrates nu laplacian(u) + C with the two-stage SDIRK method of Alexander (1977), second order,
// L-stable and stiffly accurate, both stages with the same matrix; g = 1 - 1/sqrt(2),
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
#include <functional>
#include <optional>
#include <vector>

#include "fluid_adapter/box_step/transport/velocity_stage.hpp"

namespace turbidite {

/// A contiguous part of the velocity.
struct VelocityValues {
    double* first;
    std::size_t count;
};

/// Is shown arrays, one after the other, to read or to fill them.
using ValuesVisit = std::function<void(double* first, std::size_t count)>;

/// What crosses the sides, as BoxForce.
using SideForce = std::array<double, 3>;

/// The step that knows mesh and operators.
class SecondOrderHost {
 public:
    virtual ~SecondOrderHost() = default;

    /// The velocity itself.
    virtual std::vector<VelocityValues> velocity_values() = 0;
    virtual void velocity_changed() = 0;  ///< through these values

    /// Returns what crosses the sides by dt L(u), taken before.
    virtual SideForce play(const VelocityStage& stage) = 0;

    /// The velocity itself, by implicit Euler over dt; returns what crosses the sides by it, taken
    /// after.
    virtual SideForce diffuse_implicitly(double dt) = 0;
};

/// How a window is cut for transport.
struct TransportParts {
    int count = 1;
    bool viscous = false;  ///< L contains viscosity
};

class SecondOrder {
 public:
    /// Courant number of a sub-step with the share `central` of linear interpolation; none: limited
    /// interpolation. The scheme is stable up to 1.73 for a share of 1 (linear), 1.91 for 3/4
    /// (LUST) and 1.17 for 0 (linearUpwind).
    static double largest_courant(std::optional<double> central) {
        return central && *central >= 0.75 ? 1.5 : 1.0;
    }

    /// For the largest Courant number of the flux over that, and nu dt (4/hx2 + 4/hy2), the fastest
    /// decay. Viscosity is part of L where it costs one more sub-step at most.
    static TransportParts parts(double relative_courant, double decay);

    /// u1 becomes u3 if viscosity is part of L. Otherwise u1 remains, until `diffuse`, and u2 is in
    /// `transported`. Returns one force per sub-step.
    std::vector<SideForce> transport(SecondOrderHost& host, double dt, TransportParts parts);

    /// u2, or u3 if viscosity is part of L, after `transport`; the pieces of velocity_values.
    const VelocityStage::Values& transported() const { return carried_values_; }

    /// u1 becomes u3, where viscosity is not part of L.
    SideForce diffuse(SecondOrderHost& host, double dt);

    /// Is there an earlier window?
    bool goes_on() const { return goes_on_; }

    /// The arrays that only `transport` needs, of no content; whoever takes them gives others back.
    std::vector<std::vector<double>>& idle_stages() { return working_; }

    /// The velocity was changed from outside: begins anew.
    void forget() { goes_on_ = false; }

    /// u2 of the last window, of all pieces, and whether there was one: the arrays themselves.
    void visit_memory(SecondOrderHost& host, const ValuesVisit& visit);

    /// The same, copied.
    void append_memory(SecondOrderHost& host, std::vector<double>& values);

    /// From what append_memory appended.
    void set_memory(SecondOrderHost& host, const double* values);

 private:
    using Pieces = std::vector<std::vector<double>>;

    VelocityStage::Values room(SecondOrderHost& host, Pieces& pieces) const;
    void make_room(SecondOrderHost& host);
    SideForce sub_step(SecondOrderHost& host, VelocityStage stage, double share, bool last);

    Pieces working_, part_start_;
    Pieces carried_;  // u2, of the last window until this one has its own
    VelocityStage::Values carried_values_;
    bool goes_on_ = false;
};

}  // namespace turbidite
