// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which sweeps of a solve have momentum (sweeps/momentum.hpp). What momentum gains is smooth over
// many contacts; single ones it disturbs, and a few plain sweeps settle these. Hence cycles: 24,
// 56, then 120 sweeps with momentum and 8 without. The error, which single contacts rule, says
// nothing of a cycle before its end: there it may grow tenfold while the bed as a whole comes
// closer to its solution. A cycle that ends with no smaller error than it began with is followed by
// plain sweeps, each time twice as many. Where momentum does not help, the sweeps are in the end
// those without it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace turbidite::nscd {

class MomentumPhases {
 public:
    /// `after`: sweeps before the first with momentum.
    explicit MomentumPhases(std::int64_t after) : until_(after) {}

    /// Whether the sweeps until the next check have momentum.
    bool with_momentum() const { return phase_ == Phase::momentum; }

    /// `sweeps`: so far.
    void check(std::int64_t sweeps, double error) {
        if (sweeps < until_) return;
        switch (phase_) {
            case Phase::momentum:
                return begin(Phase::settling, sweeps + settling);
            case Phase::settling:
                return error < error_ ? go_on(sweeps, error) : pause(sweeps);
            case Phase::plain:
                return cycle(sweeps, error);
        }
    }

 private:
    enum class Phase { plain, momentum, settling };

    static constexpr std::int64_t settling = 8;
    static constexpr std::int64_t longest = 128;  ///< a cycle

    void begin(Phase phase, std::int64_t until) { phase_ = phase, until_ = until; }

    void cycle(std::int64_t sweeps, double error) {
        error_ = error;
        begin(Phase::momentum, sweeps + length_ - settling);
    }
    void go_on(std::int64_t sweeps, double error) {
        length_ = std::min(2 * length_, longest);
        pause_ = longest;
        cycle(sweeps, error);
    }
    void pause(std::int64_t sweeps) {
        begin(Phase::plain, sweeps + pause_);
        pause_ *= 2;
    }

    Phase phase_ = Phase::plain;
    std::int64_t until_;                          ///< the phase lasts
    std::int64_t length_ = 32, pause_ = longest;  ///< of the next cycle, and pause
    double error_ = 0.0;                          ///< when the cycle began
};

}  // namespace turbidite::nscd
