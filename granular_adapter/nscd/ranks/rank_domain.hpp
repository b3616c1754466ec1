// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The part of a configuration that a rank works on. A body belongs to the rank of its cell
// (rank_cuts.hpp), large ones to the first rank. Before a step
//
//     settle   bodies that have left their cells go to other ranks, with all that is kept of them
//     copies   every rank gets copies of the bodies within the distance d of its cells
//     plan     which velocities go from rank to rank while the contacts are swept
//
// All functions that are not const are called by all ranks in the same order.
#pragma once

#include <memory>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "granular_adapter/nscd/cells/parity_grid.hpp"
#include "granular_adapter/nscd/detection/detection.hpp"
#include "granular_adapter/nscd/laws/contact_states.hpp"
#include "granular_adapter/nscd/problem/mobilities.hpp"
#include "granular_adapter/nscd/problem/warm_start.hpp"
#include "granular_adapter/nscd/ranks/rank_cuts.hpp"
#include "granular_adapter/nscd/ranks/rank_plan.hpp"

namespace turbidite::nscd {

/// All that a rank has of its bodies, in their order, and keeps about their contacts.
struct RankShare {
    Bodies& bodies;
    std::vector<std::vector<Twist>*> twists;  ///< one per body each
    Mobilities* mobilities = nullptr;
    ContactMemory &memory, &moments;
    ContactStates& states;
};

class RankDomain {
 public:
    explicit RankDomain(RankExchange& ranks) : ranks_(ranks) {}

    RankExchange& ranks() const { return ranks_; }

    /// Of the bodies of all ranks.
    CellSizes sizes(const Bodies& own, const PeriodicBox& box);
    /// Throws as check_periods does, on all ranks.
    void check_periods(const Bodies& own, double range, const PeriodicBox& box);

    /// Two motions, from which the largest relative velocity of any two bodies of all ranks can be
    /// found (detection/reach.hpp).
    std::vector<Twist> extremes(const std::vector<Twist>& own) const;

    /// Gives bodies to the ranks of their cells, and what is kept of a contact to the rank that
    /// finds it.
    void settle(const ParityGrid& grid, const RankShare& share);

    /// Appends copies of the bodies of other ranks; `share.bodies` are the own ones before.
    void add_copies(const ParityGrid& grid, Bodies& bodies,
                    const std::vector<std::vector<Twist>*>& twists, Mobilities* mobilities);
    std::size_t own() const { return own_; }

    /// Places and velocities of the copies as their owners have them now.
    void follow(Bodies& bodies) const;

    /// For the contacts of a detection among `bodies`, copies included.
    const RankPlan& plan(const ParityGrid& grid, const Bodies& bodies, const OrderedPoints& found);

 private:
    void cut(const ParityGrid& grid, const Bodies& own);
    std::vector<int> holders(const ParityGrid& grid, const Bodies& bodies, std::size_t body) const;
    void find_large(const ParityGrid& grid, const Bodies& own);
    bool find_large_ids(const ParityGrid& grid, const Bodies& own);
    bool is_of_large(const ContactKey& key) const;
    bool is_uneven(const std::vector<double>& work) const;
    int home(const ParityGrid& grid, const Vec3& position, double radius) const;
    void number_shared(const ParityGrid& grid, const Bodies& bodies);
    std::vector<double> contacts_of_phases(const std::vector<std::int32_t>& ends) const;
    std::vector<std::vector<int>> users(const Bodies& bodies, const OrderedPoints& found) const;
    std::vector<PhaseWays> ways(const Bodies& bodies, const OrderedPoints& found,
                                const std::vector<std::int32_t>& contact_ends) const;

    RankExchange& ranks_;
    std::vector<double> radii_;  ///< of all bodies
    CellSizes sizes_;
    struct {
        RankCuts cuts;
        bool cut = false;
        std::int64_t steps = 0;  ///< since they were cut
        bool counted = false;    ///< the loads are of contacts; the same on all ranks
    } areas_;
    std::vector<CellLoad> loads_;  ///< of the own cells in the last step
    PeriodicBox box_;
    struct Large {
        Vec3 position{};
        double radius = 0.0;
    };
    struct {
        std::vector<Large> places;        ///< of all ranks
        std::unordered_set<GrainId> ids;  ///< the same
        bool known = false;               ///< whether the ids are those by `sizes_`
    } large_;
    std::size_t own_ = 0;
    std::vector<std::vector<std::int32_t>> lent_;  ///< by rank: own bodies of which it has copies
    std::vector<std::size_t> borrowed_;            ///< by rank: the number of its bodies here
    std::vector<std::vector<int>> holders_;        ///< by body: other ranks that have it
    std::unordered_map<GrainId, std::int32_t>
        shared_;  ///< places of bodies that others have as well
    std::unique_ptr<RankPlan> plan_;
};

}  // namespace turbidite::nscd
