// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which sweeps of a solve have momentum (sweeps/momentum.hpp). What momentum gains is smooth over
// many contacts; single ones it disturbs, and a few plain sweeps settle these. Hence cycles of 32,
// 64, then 128 sweeps, of which the last eighth, at least 8, is plain. The error, which single
// contacts rule, says nothing of a cycle before its end: there it may grow severalfold while the
// bed as a whole comes closer to its solution, and even the end of a cycle may be worse than its
// beginning. After three cycles in a row that have not found a smaller error plain sweeps follow,
// each time twice as many. Where momentum does not help, the sweeps are in the end those without
// it.
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
                return begin(Phase::settling, sweeps + settling());
            case Phase::settling:
                judge(error);
                return failed_ < patience ? cycle(sweeps) : pause(sweeps);
            case Phase::plain:
                smallest_ = error;
                return cycle(sweeps);
        }
    }

 private:
    enum class Phase { plain, momentum, settling };

    static constexpr std::int64_t longest = 128;  ///< cycle
    static constexpr int patience = 3;            ///< with cycles that fail

    std::int64_t settling() const { return std::max(length_ / 8, std::int64_t{8}); }

    void begin(Phase phase, std::int64_t until) { phase_ = phase, until_ = until; }
    void cycle(std::int64_t sweeps) { begin(Phase::momentum, sweeps + length_ - settling()); }

    void judge(double error) {
        length_ = std::min(2 * length_, longest);
        if (error < smallest_)
            smallest_ = error, failed_ = 0, pause_ = longest;
        else
            ++failed_;
    }

    void pause(std::int64_t sweeps) {
        begin(Phase::plain, sweeps + pause_);
        failed_ = 0;
        pause_ *= 2;
    }

    Phase phase_ = Phase::plain;
    std::int64_t until_;                          ///< the phase lasts
    std::int64_t length_ = 32, pause_ = longest;  ///< of the next cycle, and pause
    double smallest_ = 0.0;                       ///< error at the ends of cycles
    int failed_ = 0;                              ///< cycles in a row
};

}  // namespace turbidite::nscd
