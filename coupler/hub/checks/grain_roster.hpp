// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grains that are in the run: those of the population, less those that the grains program has
// announced as removed. Every message must speak of each of them exactly once.
#pragma once

#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "coupler/hub/checks/arrival.hpp"

namespace turbidite {

/// A grain that has left the run, and the grains rank that had it.
struct Leaver {
    GrainId id = 0;
    int rank = 0;
};

class GrainRoster {
 public:
    explicit GrainRoster(const std::vector<GrainState>& population);

    /// Checks the grains of `motion` or `state`; those that a `state` reports as removed leave the
    /// run, and are returned. Throws PhysicsRefused naming the sender and the first grain that is
    /// unknown, sent twice, missing, or not the body that it is in the population.
    std::vector<Leaver> check(const std::vector<Motion>& shares, const Arrival& arrival);

    /// Checks the fluid's answers, one for every grain. Throws like the other.
    void check(const std::vector<Kicks>& shares, const Arrival& arrival) const;
    void check(const std::vector<std::vector<FreeResponse>>& shares, const Arrival& arrival) const;

    /// Those that are in a run that goes on, by the ranks that own them.
    void resume(const std::vector<Motion>& shares) { remember(shares); }

    std::size_t size() const { return present_.size(); }
    bool has(GrainId id) const { return places_.count(id) > 0; }

 private:
    /// To the round-off of a host that keeps masses, or diameters.
    static bool keeps(double known, double now) { return std::abs(now - known) <= 1e-9 * known; }

    struct Entry {
        GrainId id = 0;
        std::int32_t shape = 0, material = 0;
        bool prescribed = false;
        double radius = 0.0, density = 0.0;
        int rank = 0;  ///< the grains rank that sent it when the order last changed

        bool is_the_same_body(const GrainState& grain) const {
            return grain.shape == shape && grain.material == material &&
                   grain.prescribed == prescribed && keeps(radius, grain.radius) &&
                   keeps(density, grain.density);
        }
        /// "shape 3 instead of 0": what is not the same.
        std::string difference(const GrainState& grain) const;
        bool fits(const GrainState& grain) const {
            return grain.id == id && is_the_same_body(grain);
        }
        template <class Answer>
        bool fits(const Answer& answer) const {
            return answer.id == id;
        }
    };
    using Seen = std::vector<int>;  ///< by place in present_: the rank that sent it, or nobody

    /// The common case: the grains of the last message in the same order.
    template <class Shares>
    bool unchanged(const Shares& shares) const;
    void note_ranks(const std::vector<Motion>& shares);
    template <class Shares>
    Seen tally(const Shares& shares, const Arrival& arrival) const;
    void check_bodies(const std::vector<Motion>& shares, const Arrival& arrival) const;
    void check_missing(const Seen& seen, const std::vector<Motion>& shares,
                       const Arrival& arrival) const;
    std::vector<Leaver> leavers(const Seen& seen) const;
    void remember(const std::vector<Motion>& shares);
    template <class Shares>
    void check_answers(const Shares& shares, const Arrival& arrival) const;

    std::vector<Entry> present_;  ///< in the order of the last message of the grains
    std::unordered_map<GrainId, std::size_t> places_;
};

}  // namespace turbidite
