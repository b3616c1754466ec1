// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contacts of one problem on several ranks. They are swept in phases: the cells of one parity
// after the other, then the contacts of large bodies. In a phase no body is moved by two ranks.
// After it, whoever has moved a body tells the ranks that use it: those with contacts of the body,
// and the one that owns it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "coupler/rigid/rigid_motion.hpp"
#include "granular_adapter/nscd/ranks/gathered.hpp"

namespace turbidite::nscd {

/// Bodies, by index into those of the problem, that go from rank to rank after a phase; by rank,
/// and in an order that both sides know.
struct PhaseWays {
    std::vector<std::vector<std::int32_t>> sent, received;
};

class RankPlan {
 public:
    /// `contact_ends`, `cell_ends`: the numbers of contacts and of cells of this rank up to the end
    /// of each phase. `contacts`: of all ranks. Collective.
    RankPlan(RankExchange& ranks, std::vector<PhaseWays> ways,
             std::vector<std::int32_t> contact_ends, std::vector<std::size_t> cell_ends,
             std::size_t contacts);

    RankExchange& ranks() const { return ranks_; }
    std::size_t phases() const { return ways_.size(); }
    const std::vector<std::size_t>& cell_ends() const { return cell_ends_; }
    std::size_t contacts() const { return contacts_; }

    /// Calls visit(k) for the contacts of this rank, phase by phase, and takes over the values of
    /// bodies between them.
    template <class Visit>
    void each_contact(std::vector<Twist>& values, const Visit& visit) const {
        std::int32_t k = 0;
        for (std::size_t phase = 0; phase < phases(); ++phase) {
            for (; k < contact_ends_[phase]; ++k) visit(static_cast<std::size_t>(k));
            exchange(phase, values);
        }
    }

    /// Takes over the values of bodies after a phase: read(body, to) and write(body, from) copy six
    /// doubles.
    template <class Read, class Write>
    void exchange(std::size_t phase, const Read& read, const Write& write) const {
        const PhaseWays& ways = ways_[phase];
        for (int rank = 0; rank < ranks_.size(); ++rank) {
            double* to = ranks_.outgoing(phase, rank);
            for (const std::int32_t body : ways.sent[static_cast<std::size_t>(rank)])
                read(body, to), to += doubles_per_body;
        }
        ranks_.post(phase);
        ranks_.await(phase);
        for (int rank = 0; rank < ranks_.size(); ++rank) {
            const double* from = ranks_.incoming(phase, rank);
            for (const std::int32_t body : ways.received[static_cast<std::size_t>(rank)])
                write(body, from), from += doubles_per_body;
        }
    }

    void exchange(std::size_t phase, std::vector<Twist>& values) const;

    bool any(bool here) const { return nscd::any(ranks_, here); }
    double largest(double here) const { return nscd::largest(ranks_, here); }

    static constexpr std::size_t doubles_per_body = 6;

 private:
    RankExchange& ranks_;
    std::vector<PhaseWays> ways_;
    std::vector<std::int32_t> contact_ends_;
    std::vector<std::size_t> cell_ends_;
    std::size_t contacts_;
};

}  // namespace turbidite::nscd
