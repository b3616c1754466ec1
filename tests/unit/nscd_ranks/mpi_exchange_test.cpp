// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the ranks of the contact engine give each other arrives, by either way.
#include "granular_adapter/nscd_ranks/mpi_exchange.hpp"

#include <gtest/gtest.h>

#include "granular_adapter/nscd/ranks/gathered.hpp"

namespace turbidite::nscd {
namespace {

using Way = MpiExchange::Way;

class Exchange : public testing::TestWithParam<Way> {
 protected:
    MpiExchange ranks{MPI_COMM_WORLD, GetParam()};
    const int me = ranks.rank(), all = ranks.size();
};

TEST_P(Exchange, GathersInTheOrderOfTheRanks) {
    // Rank r gives r numbers.
    const std::vector<int> found = gathered(ranks, std::vector<int>(std::size_t(me), 10 + me));
    std::vector<int> expected;
    for (int rank = 0; rank < all; ++rank)
        expected.insert(expected.end(), std::size_t(rank), 10 + rank);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(largest(ranks, 0.5 * me), 0.5 * (all - 1));
    EXPECT_EQ(any(ranks, me == all - 1), true);
    EXPECT_EQ(any(ranks, false), false);
}

TEST_P(Exchange, SwapsParts) {
    std::vector<std::vector<int>> parts(static_cast<std::size_t>(all));
    for (int to = 0; to < all; ++to)
        parts[std::size_t(to)].assign(std::size_t(me + 2 * to), 100 * me + to);
    const auto got = swapped(ranks, parts);
    for (int from = 0; from < all; ++from)
        EXPECT_EQ(got[std::size_t(from)],
                  std::vector<int>(std::size_t(from + 2 * me), 100 * from + me));
}

/// Doubles from one rank to another in a phase; in phase 1 only to the next rank, in phase 2 none.
std::size_t count(std::size_t phase, int from, int to, int ranks, int size) {
    if (from == to || phase == 2) return 0;
    if (phase == 1) return to == (from + 1) % ranks ? 3 : 0;
    return static_cast<std::size_t>(size * (1 + from + 2 * to));
}

double value(std::size_t phase, int from, int to, int turn) {
    return 1000.0 * static_cast<double>(phase) + 100.0 * from + 10.0 * to + 0.001 * turn;
}

// Many turns without a pause, so that a rank that is ahead would overwrite what others still read.
TEST_P(Exchange, PhasesRepeatInTurn) {
    for (const int size : {1, 50, 2, 3000}) {
        std::vector<RankExchange::Traffic> phases(3);
        for (std::size_t phase = 0; phase < phases.size(); ++phase)
            for (int other = 0; other < all; ++other) {
                phases[phase].sent.push_back(count(phase, me, other, all, size));
                phases[phase].received.push_back(count(phase, other, me, all, size));
            }
        ranks.prepare(phases);
        int wrong = 0;
        for (int turn = 0; turn < 200; ++turn)
            for (std::size_t phase = 0; phase < phases.size(); ++phase) {
                for (int to = 0; to < all; ++to)
                    std::fill_n(ranks.outgoing(phase, to), phases[phase].sent[std::size_t(to)],
                                value(phase, me, to, turn));
                ranks.post(phase);
                ranks.await(phase);
                for (int from = 0; from < all; ++from)
                    for (std::size_t i = 0; i < phases[phase].received[std::size_t(from)]; ++i)
                        wrong += ranks.incoming(phase, from)[i] != value(phase, from, me, turn);
            }
        EXPECT_EQ(wrong, 0) << size;
    }
}

INSTANTIATE_TEST_SUITE_P(Ways, Exchange,
                         testing::Values(Way::shared_memory_if_possible, Way::messages));

}  // namespace
}  // namespace turbidite::nscd
