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
// A stretch of a sweep (contact_schedule.hpp) takes its rows, and the bodies that it uses first, to
// y_k just before it updates them, when they are in the cache. The sweep before must have finished
// with all of them, which a stretch waits for in any case (sweep_pipeline.hpp).
//
// Which sweeps have it: solvers/momentum_phases.hpp.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "granular_adapter/nscd/sweeps/sweep_layout.hpp"

namespace turbidite::nscd {

template <class Rows>
class Momentum {
 public:
    void restart() { steps_ = 0; }

    /// Before sweeps over the layout, whose groups are always the same.
    void prepare(const SweepLayout<Rows>& layout) {
        if (steps_ > 0) return;
        if (first_use_ends_.empty()) find_first_uses(layout);
        bodies_.resize(first_uses_.size());
        impulses_.assign(layout.rows.size(), {});
        had_impulse_.assign(layout.awake.size(), 0);
    }

    /// beta of the sweep after `sweeps` more.
    double beta(std::size_t sweeps) const {
        const auto k = static_cast<double>(steps_ + sweeps);
        return std::min(k / (k + 2.0), 0.95);
    }
    void advance(std::size_t sweeps) { steps_ += sweeps; }

    /// Takes x_k in the layout to y_k: the groups of a stretch, ...
    void extrapolate_groups(SweepLayout<Rows>& layout, const Stretch& stretch, double beta) {
        for (std::int32_t i = stretch.active.first; i < stretch.active.last; ++i)
            advance_row(layout, i, beta);
        for (std::int32_t i = stretch.resting.first; i < stretch.resting.last; ++i) {
            // A group that falls asleep still has the impulses before, and with them momentum. Most
            // groups have neither, and their impulses are not looked at.
            const auto resting = static_cast<std::size_t>(i - layout.schedule.active);
            std::uint8_t &awake = layout.awake[resting], &had = had_impulse_[resting];
            if ((awake | had) == 0) continue;
            awake = advance_row(layout, i, beta) ? 1 : 0;
            had = has_impulse(impulses_[static_cast<std::size_t>(i)]) ? 1 : 0;
        }
    }
    /// ... the bodies that no stretch before this one uses, ...
    void extrapolate_bodies(SweepLayout<Rows>& layout, std::size_t stretch, double beta) {
        const std::size_t first = stretch == 0 ? 0 : first_use_ends_[stretch - 1];
        extrapolate_bodies(layout, first, first_use_ends_[stretch], beta);
    }
    /// ... or all bodies.
    void extrapolate_bodies(SweepLayout<Rows>& layout, double beta) {
        extrapolate_bodies(layout, 0, first_uses_.size(), beta);
    }

 private:
    using Body = typename Rows::Body;
    /// By row.
    using RowImpulses = decltype(impulse_lanes(std::declval<const Rows&>()));

    // In the first step `before` is of no meaning, and beta 0.
    static double next(double x, double before, double beta) { return x + beta * (x - before); }

    void extrapolate_bodies(SweepLayout<Rows>& layout, std::size_t first, std::size_t last,
                            double beta) {
        for (std::size_t i = first; i < last; ++i)
            advance_body(layout.bodies[first_uses_[i]], bodies_[i], beta);
    }
    static void advance_body(Body& body, Body& before, double beta) {
        const Body now = body;
        auto* const x = reinterpret_cast<double*>(&body);
        const auto* const old = reinterpret_cast<const double*>(&before);
        for (std::size_t i = 0; i < sizeof(Body) / sizeof(double); ++i)
            x[i] = next(x[i], old[i], beta);
        before = now;
    }
    /// Whether the group has an impulse now.
    bool advance_row(SweepLayout<Rows>& layout, std::int32_t group, double beta) {
        Rows& row = layout.rows[static_cast<std::size_t>(group)];
        RowImpulses& before = impulses_[static_cast<std::size_t>(group)];
        const RowImpulses now = impulse_lanes(row);
        RowImpulses y = now;
        for (std::size_t i = 0; i < y.size(); ++i)
            for (int lane = 0; lane < Rows::width; ++lane)
                y[i].v[lane] = next(now[i].v[lane], before[i].v[lane], beta);
        set_impulse_lanes(row, y);
        before = now;
        return has_impulse(y);
    }
    /// Impulses are normal ones first.
    static bool has_impulse(const RowImpulses& impulses) {
        bool has = false;
        for (int lane = 0; lane < Rows::width; ++lane) has |= impulses[0].v[lane] != 0.0;
        return has;
    }

    void find_first_uses(const SweepLayout<Rows>& layout) {
        // Bodies that do not move have slots as well.
        std::vector<std::uint8_t> unused(layout.bodies.size());
        for (const std::int32_t slot : layout.slots)
            if (slot >= 0) unused[static_cast<std::size_t>(slot)] = 1;
        for (const Stretch& stretch : layout.schedule.stretches) {
            layout.each_slot(stretch, [&](std::size_t slot) {
                if (std::exchange(unused[slot], std::uint8_t{0}) != 0) first_uses_.push_back(slot);
            });
            first_use_ends_.push_back(first_uses_.size());
        }
    }

    std::size_t steps_ = 0;
    std::vector<Body> bodies_;               ///< of x_{k-1}, in the order of their first uses
    std::vector<RowImpulses> impulses_;      ///< of x_{k-1}
    std::vector<std::uint8_t> had_impulse_;  ///< by group at rest, in x_{k-1}
    std::vector<std::size_t> first_uses_, first_use_ends_;  ///< slots of bodies; by stretch
};

}  // namespace turbidite::nscd
