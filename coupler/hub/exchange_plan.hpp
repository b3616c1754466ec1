// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which rank needs which grains. Grains ranks own grains by id; a fluid rank needs every grain
// whose bounding sphere touches its box. Sized by count, never by the largest id;
// grains may appear, vanish and migrate between windows. No MPI here: the plan sorts records,
// channels carry them.
#pragma once

#include <vector>

#include "coupler/protocol/grain_index.hpp"
#include "coupler/protocol/wire.hpp"

namespace turbidite {

class ExchangePlan {
 public:
    /// `period` [m] per axis: 0 where the domain is not cyclic.
    ExchangePlan(std::vector<Box> fluid_boxes, Vec3 period);

    /// Merges what the grains ranks sent into one list and remembers which rank owns which grain.
    /// Those of several ranks are in the order of their ids, so that sums over grains do not depend
    /// on who owns them; those of one rank in the order in which it has sent them first, and after
    /// that in which it sends other grains.
    /// Contacts (checked by hub/checks/contact_check) are in the order of contact_before, whatever
    /// the number of ranks. Throws PhysicsRefused when an id occurs twice.
    Motion gather(std::vector<Motion> shares);

    /// How often `gather` had to find the places of the grains anew.
    std::int64_t builds() const { return index_.builds(); }

    /// The rank that owns each grain, in the order of the last `gather`.
    const std::vector<int>& owners() const { return owner_; }

    /// For every fluid rank, the grains that touch its box. The shares refer to `motion`.
    std::vector<MotionShare> by_place(const Motion& motion) const;

    /// For every grains rank, the records of its grains (as of the last `gather`). Throws
    /// PhysicsRefused unless every grain gets exactly one record.
    template <class Record>
    std::vector<std::vector<Record>> by_owner(std::vector<Record> records) const;

 private:
    Motion merged(const std::vector<Motion>& shares);
    template <class Record>
    std::vector<int> owners_of(const std::vector<Record>& records) const;
    [[noreturn]] void refuse_missing(const std::vector<bool>& answered) const;

    std::vector<Box> boxes_;
    Vec3 period_;
    GrainIndex index_;        ///< of the last `gather`
    std::vector<int> owner_;  ///< rank, by place in index_
    std::size_t owners_ = 0;
};

/// The population split into `ranks` shares (protocol/even_shares.hpp).
std::vector<Motion> shares_of(const std::vector<GrainState>& population, int ranks);

}  // namespace turbidite
