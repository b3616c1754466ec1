// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Momentum between sweeps (Nesterov 1983; Polyak 1964). With x_k the impulses and velocities after
// k sweeps, the next sweep starts from
//
//     y_k = x_k + beta_k (x_k - x_{k-1}),    beta_k = min(k/(k + 2), 0.95)
//
// A sweep moves impulses by one contact or a few, so that a column of n grains takes some n^2
// sweeps to feel its load, and some n with momentum. The bound makes momentum forget in some twenty
// sweeps: without it the column swings about its solution. Velocities are affine in the impulses, v
// = v_free + M^-1 H r, so that those of y_k belong to its impulses. An impulse of y_k may be
// outside its cone; the next update puts it back.
//
// Which sweeps have it: solvers/momentum_phases.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"
#include "granular_adapter/nscd/sweeps/thread_team.hpp"

namespace turbidite::nscd {

template <class Rows>
class Momentum {
 public:
    void restart() { steps_ = 0; }

    /// Takes x_k of the layout, and leaves y_k there. Between two calls the layout has the same
    /// groups, or restart() was called.
    void extrapolate(SweepLayout<Rows>& layout, ThreadTeam& team) {
        if (steps_ == 0) {
            bodies_.resize(layout.bodies.size());
            impulses_.resize(layout.rows.size());
        }
        const double k = static_cast<double>(steps_), beta = std::min(k / (k + 2.0), 0.95);
        team.run([&](int thread) {
            advance_part(layout.bodies, bodies_, beta, team, thread);
            advance_part(layout.rows, impulses_, beta, team, thread);
        });
        ++steps_;
    }

 private:
    using Body = typename Rows::Body;
    /// By row.
    using RowImpulses = decltype(impulse_lanes(std::declval<const Rows&>()));

    // x + beta (x - before), which leaves what is constant as it is. In the first step `before` is
    // of no meaning: it counts only times beta > 0.
    static double next(double x, double before, double beta) {
        return beta == 0.0 ? x : x + beta * (x - before);
    }
    template <class State, class Before>
    static void advance_part(std::vector<State>& x, std::vector<Before>& before, double beta,
                             const ThreadTeam& team, int thread) {
        const std::size_t end = team.part_begin(before.size(), thread + 1);
        for (std::size_t i = team.part_begin(before.size(), thread); i < end; ++i)
            advance(x[i], before[i], beta);
    }
    static void advance(Body& body, Body& before, double beta) {
        const Body now = body;
        auto* const x = reinterpret_cast<double*>(&body);
        const auto* const old = reinterpret_cast<const double*>(&before);
        for (std::size_t i = 0; i < sizeof(Body) / sizeof(double); ++i)
            x[i] = next(x[i], old[i], beta);
        before = now;
    }
    static void advance(Rows& row, RowImpulses& before, double beta) {
        const RowImpulses now = impulse_lanes(row);
        RowImpulses y = now;
        for (std::size_t i = 0; i < y.size(); ++i)
            for (int lane = 0; lane < Rows::width; ++lane)
                y[i].v[lane] = next(now[i].v[lane], before[i].v[lane], beta);
        set_impulse_lanes(row, y);
        before = now;
    }

    std::size_t steps_ = 0;
    std::vector<Body> bodies_;           ///< of x_{k-1}
    std::vector<RowImpulses> impulses_;  ///< the same
};

}  // namespace turbidite::nscd
