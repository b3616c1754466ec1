// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/checkpoint/checkpoint_rule.hpp"

#include <algorithm>
#include <cmath>

namespace turbidite {
namespace {

bool divides(std::int64_t period, std::int64_t windows) {
    return period > 0 && windows % period == 0;
}

}  // namespace

CheckpointRule::CheckpointRule(const Settings& settings, const RunValues& run) {
    const double interval =
        settings.has("checkpoint.interval") ? settings.real("checkpoint.interval") : 0.0;
    if (interval > 0.0) {
        // [t_c] to whole windows, at least one. llround is undefined beyond 64 bits.
        const double windows = std::min(interval * run.time / run.step, 9e18);
        by_time_ = std::max<std::int64_t>(1, std::llround(windows));
    }
    if (settings.has("checkpoint.windows")) by_count_ = settings.integer("checkpoint.windows");
    if (settings.has("checkpoint.wall_minutes"))
        wall_ = std::chrono::duration<double>(60.0 * settings.real("checkpoint.wall_minutes"));
    if (settings.has("checkpoint.keep"))
        keep_ = static_cast<std::size_t>(settings.integer("checkpoint.keep"));
}

bool CheckpointRule::any() const {
    return by_time_ > 0 || by_count_ > 0 || wall_.count() > 0.0;
}

bool CheckpointRule::due(std::int64_t windows, Clock::time_point now) const {
    // Wall time counts from the last set; windows count from t = 0, so that a run in parts has the
    // sets of one in one part.
    const bool late = wall_.count() > 0.0 && now - last_ >= wall_;
    return late || divides(by_time_, windows) || divides(by_count_, windows);
}

}  // namespace turbidite
