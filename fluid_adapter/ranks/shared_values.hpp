// SPDX-License-Identifier: LGPL-2.1-or-later
//
// An array of every rank that all ranks of a node can read and write directly: memory shared
// through MPI, so that what one rank has for another is copied once, by whoever has it, and not
// through messages (in a shared-memory transport without kernel help: twice, in pieces).
// Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class SharedValues {
 public:
    /// `count` zeros on this rank. Made and destroyed by all ranks together; they must share a node
    /// (RankGroup::one_node).
    SharedValues(const RankGroup& group, std::size_t count);
    ~SharedValues();
    SharedValues(const SharedValues&) = delete;
    SharedValues& operator=(const SharedValues&) = delete;

    double* of(int rank) const { return values_[rank]; }

    /// What any rank did to any array before is seen by all after it. By all ranks.
    void fence() const;

 private:
    RankGroup group_;
    MPI_Win window_ = MPI_WIN_NULL;
    std::vector<double*> values_;
};

}  // namespace turbidite
