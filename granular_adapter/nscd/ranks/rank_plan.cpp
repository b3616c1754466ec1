// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/ranks/rank_plan.hpp"

#include <cstring>

namespace turbidite::nscd {
namespace {

std::vector<std::size_t> doubles(const std::vector<std::vector<std::int32_t>>& bodies) {
    std::vector<std::size_t> count;
    for (const auto& of_rank : bodies) count.push_back(of_rank.size() * RankPlan::doubles_per_body);
    return count;
}

static_assert(sizeof(Twist) == RankPlan::doubles_per_body * sizeof(double));

}  // namespace

RankPlan::RankPlan(RankExchange& ranks, std::vector<PhaseWays> ways,
                   std::vector<std::int32_t> contact_ends, std::vector<std::size_t> cell_ends,
                   std::size_t contacts)
    : ranks_(ranks),
      ways_(std::move(ways)),
      contact_ends_(std::move(contact_ends)),
      cell_ends_(std::move(cell_ends)),
      contacts_(contacts) {
    std::vector<RankExchange::Traffic> phases;
    for (const PhaseWays& phase : ways_)
        phases.push_back({doubles(phase.sent), doubles(phase.received)});
    // The ways stay the same for all sweeps of the solve.
    ranks_.prepare(phases);
}

void RankPlan::exchange(std::size_t phase, std::vector<Twist>& values) const {
    exchange(
        phase,
        [&](std::int32_t body, double* to) {
            std::memcpy(to, &values[static_cast<std::size_t>(body)], sizeof(Twist));
        },
        [&](std::int32_t body, const double* from) {
            std::memcpy(static_cast<void*>(&values[static_cast<std::size_t>(body)]), from,
                        sizeof(Twist));
        });
}

}  // namespace turbidite::nscd
