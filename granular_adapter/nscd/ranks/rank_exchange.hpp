// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How the ranks of a contact engine exchange data; the engine knows no MPI. Every function is
// called by all ranks in the same order.
#pragma once

#include <cstddef>
#include <vector>

namespace turbidite::nscd {

class RankExchange {
 public:
    using Bytes = std::vector<char>;

    virtual ~RankExchange() = default;

    virtual int rank() const = 0;
    virtual int size() const = 0;

    /// What every rank gives, on all ranks, in the order of the ranks.
    virtual std::vector<Bytes> gather(Bytes mine) = 0;

    /// To every rank its part; returns what every rank gave to this one.
    virtual std::vector<Bytes> swap(std::vector<Bytes> parts) = 0;

    // Within a solve, doubles travel again and again along the same ways, in phases that follow
    // each other in turn.

    /// Numbers of doubles of a phase, by rank.
    struct Traffic {
        std::vector<std::size_t> sent, received;
    };
    /// Sets the ways of all phases; what is sent to a rank is what it receives from this one.
    virtual void prepare(const std::vector<Traffic>& phases) = 0;

    /// Where to put what is sent in a phase, before post().
    virtual double* outgoing(std::size_t phase, int to) = 0;
    virtual void post(std::size_t phase) = 0;

    /// Waits for the doubles that others have sent in a phase.
    virtual void await(std::size_t phase) = 0;
    virtual const double* incoming(std::size_t phase, int from) = 0;
};

}  // namespace turbidite::nscd
