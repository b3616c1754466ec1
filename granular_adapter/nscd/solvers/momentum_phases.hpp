// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which sweeps of a solve have momentum (sweeps/momentum.hpp). Momentum gains what is smooth over
// many contacts, and disturbs single ones, which a few plain sweeps settle. Hence cycles that end
// with plain sweeps: short ones of 24 + 8 sweeps, in which single contacts are disturbed little,
// and long ones of 112 + 16, which reach across a deep bed.
//
// A solve begins with short cycles, and goes on with them as long as each takes a quarter off the
// error. Long ones follow until one fails, that is, ends with more than the smallest error so far;
// then a short one is tried again. The error, which single contacts rule, says nothing of a long
// cycle before its end: there it may grow severalfold while the bed as a whole comes closer to its
// solution, and even the end of a cycle may be worse than its beginning. After three cycles in a
// row that fail plain sweeps follow, each time twice as many. Where momentum does not help, the
// sweeps are in the end those without it.
#pragma once

#include <cstdint>

namespace turbidite::nscd {

class MomentumPhases {
 public:
    /// `after`: sweeps before the first with momentum.
    explicit MomentumPhases(std::int64_t after) : until_(after) {}

    /// Whether the sweeps until the next check have momentum.
    bool with_momentum() const { return phase_ == Phase::momentum; }

    /// `sweeps`: so far; `error`: after them, relative.
    void check(std::int64_t sweeps, double error) {
        if (sweeps < until_) return;
        switch (phase_) {
            case Phase::momentum:
                return begin(Phase::settling, sweeps + cycle().settling);
            case Phase::settling:
                judge(error);
                return failed_ < patience ? begin_cycle(sweeps, error) : pause(sweeps);
            case Phase::plain:
                smallest_ = error;
                return begin_cycle(sweeps, error);
        }
    }

 private:
    enum class Phase { plain, momentum, settling };

    /// Sweeps of a cycle.
    struct Cycle {
        std::int64_t momentum, settling;
    };
    static constexpr Cycle short_cycle{24, 8}, long_cycle{112, 16};
    static constexpr std::int64_t shortest_pause = 128;
    static constexpr int patience = 3;  ///< with cycles that fail

    const Cycle& cycle() const { return is_long_ ? long_cycle : short_cycle; }

    void begin(Phase phase, std::int64_t until) { phase_ = phase, until_ = until; }
    void begin_cycle(std::int64_t sweeps, double error) {
        begin_ = error;
        begin(Phase::momentum, sweeps + cycle().momentum);
    }

    void judge(double error) {
        const bool better = error < smallest_;
        is_long_ = is_long_ ? better : error > 0.75 * begin_;
        if (better)
            smallest_ = error, failed_ = 0, pause_ = shortest_pause;
        else
            ++failed_;
    }

    void pause(std::int64_t sweeps) {
        begin(Phase::plain, sweeps + pause_);
        is_long_ = false, failed_ = 0;
        pause_ *= 2;
    }

    Phase phase_ = Phase::plain;
    std::int64_t until_;     ///< the phase lasts
    bool is_long_ = false;   ///< cycle
    double begin_ = 0.0;     ///< error at the beginning of the cycle
    double smallest_ = 0.0;  ///< at the ends of cycles
    int failed_ = 0;         ///< cycles in a row
    std::int64_t pause_ = shortest_pause;
};

}  // namespace turbidite::nscd
