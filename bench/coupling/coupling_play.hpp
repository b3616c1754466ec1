// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Jobs of turbidite-bench-coupling under mpirun, and what they leave.
#pragma once

#include <string>
#include <vector>

#include "bench/coupling/stamps.hpp"
#include "bench/timing/step_clock.hpp"

namespace turbidite::bench {

class Site;

struct CouplingJob {
    std::int64_t grains = 1400, windows = 10;
    int fluid_ranks = 1, grains_ranks = 1;
    double pause = 0.0;  ///< of the grains program in every window [s]
};

/// One program of a job.
struct Ranks {
    std::vector<Stamp> stamps;  ///< of all ranks
    std::vector<Sample>
        samples;  ///< by rank: processor and wall time from window 1 on, peak memory
                  ///< (`resident`), bytes "sent" and "received" in window 1
    /// The largest value over the ranks.
    double largest(const std::string& count) const;
    double largest_resident() const;
};

struct PlayedJob {
    Ranks coupler, fluid, grains;
};

PlayedJob play_coupling(Site& site, const CouplingJob& job);

/// Median time of `bytes` bytes over the bare relay (relay.hpp) [s].
double play_relay(Site& site, std::int64_t bytes, int turns);

}  // namespace turbidite::bench
