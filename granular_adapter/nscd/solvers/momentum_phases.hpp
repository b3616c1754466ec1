// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which sweeps of a solve have momentum (sweeps/momentum.hpp). Momentum disturbs single contacts
// while the packing as a whole comes closer to its solution: errors may grow a little, and fall as
// soon as plain sweeps follow. A phase with momentum therefore ends when the error grows, one more
// check of plain sweeps settles it, and only then is it judged: where it reduced the error less per
// sweep than plain sweeps did, plain sweeps follow, each time twice as many. Where momentum does
// not help, the sweeps are in the end those without it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace turbidite::nscd {

class MomentumPhases {
 public:
    /// `after`: sweeps before the first phase with momentum.
    explicit MomentumPhases(std::int64_t after) : until_(after) {}

    /// Whether the sweeps until the next check have momentum.
    bool with_momentum() const { return phase_ == Phase::momentum; }

    /// `sweeps`: so far; `error`: squared.
    void check(std::int64_t sweeps, double error) {
        const State now{sweeps, error};
        if (phase_ == Phase::momentum && grows(error)) {
            phase_ = Phase::settling;
        } else if (phase_ == Phase::settling) {
            const bool paid = pays(between(start_, now));
            pause_ = paid ? shortest_pause : 2 * pause_;
            phase_ = Phase::plain, start_ = now, until_ = paid ? sweeps : sweeps + pause_;
        }
        if (phase_ == Phase::plain && sweeps >= until_) {
            if (sweeps > start_.sweeps) plain_ = between(start_, now);
            phase_ = Phase::momentum, start_ = now;
        }
        last_error_ = error;
    }

 private:
    enum class Phase { plain, momentum, settling };
    struct State {
        std::int64_t sweeps = 0;
        double error = 1.0;
    };

    static constexpr std::int64_t shortest_pause = 8;

    /// By half since the last check, or to four times what it was when the phase began.
    bool grows(double error) const {
        return error > 1.5 * last_error_ || error > 4.0 * start_.error;
    }

    /// By how much the logarithm of the error has fallen, and in how many sweeps.
    struct Fall {
        double depth = 0.0;
        std::int64_t sweeps = 1;
    };
    static Fall between(const State& from, const State& to) {
        return {std::log(from.error / to.error), to.sweeps - from.sweeps};
    }

    /// The first plain sweeps smooth what momentum has roughened, and say little about those that
    /// would follow: what a few of them gained is taken for the gain of as many as had momentum.
    bool pays(const Fall& with) const {
        return with.depth / static_cast<double>(with.sweeps) >=
               plain_.depth / static_cast<double>(std::max(plain_.sweeps, with.sweeps));
    }

    Phase phase_ = Phase::plain;
    State start_;              ///< of the phase
    double last_error_ = 1.0;  ///< at the last check
    Fall plain_;               ///< of the last plain phase
    std::int64_t pause_ = shortest_pause, until_;
};

}  // namespace turbidite::nscd
