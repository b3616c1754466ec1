// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When checkpoints are due: before the first window, after the last one, and in between whenever
// one of these has passed since the last set,
//
//     checkpoint.interval       simulated time [t_c]
//     checkpoint.windows        windows
//     checkpoint.wall_minutes   wall time [min]
//
// where 0 switches a rule off. Without any rule there are only those that the user asks for.
#pragma once

#include <chrono>
#include <cstdint>

#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

class CheckpointRule {
 public:
    using Clock = std::chrono::steady_clock;

    /// Settings without these keys have no rule.
    CheckpointRule(const Settings& settings, const RunValues& run);

    /// Whether sets are written without being asked for.
    bool any() const;

    /// Whether one is due after so many windows. Intervals of windows and simulated time count from
    /// t = 0, so that a resumed run has the same sets.
    bool due(std::int64_t windows, Clock::time_point now = Clock::now()) const;

    /// A set was written, for whatever reason.
    void written(Clock::time_point now = Clock::now()) { last_ = now; }

    std::size_t keep() const { return keep_; }

 private:
    std::int64_t by_time_ = 0, by_count_ = 0;  ///< periods in windows; 0: never
    std::chrono::duration<double> wall_{0.0};
    std::size_t keep_ = 2;
    Clock::time_point last_ = Clock::now();
};

}  // namespace turbidite
