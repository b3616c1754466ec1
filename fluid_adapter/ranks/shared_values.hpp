// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One array per rank that all ranks of a node can read and write directly, in shared memory
// allocated by MPI. Data for another rank is copied once, by the rank that has it; messages copy it
// twice and in pieces, in a shared-memory transport without kernel support. Valid C++17.
#pragma once

#include <cstddef>
#include <vector>

#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

/// Free bytes of the file system behind the memory that MPI shares; infinite if it is unknown.
double free_shared_memory();

class SharedValues {
 public:
    /// Whether there is room for `count` values on this rank and those of the others. Containers
    /// often have 64 MB. Collective.
    static bool fits(const RankGroup& group, std::size_t count, double free = free_shared_memory());

    /// `count` zeros on this rank. Created and destroyed collectively; the ranks must share a node
    /// (RankGroup::one_node).
    SharedValues(const RankGroup& group, std::size_t count);
    /// Not collective where an exception unwinds: other ranks may be anywhere, and the program
    /// ends.
    ~SharedValues();
    SharedValues(const SharedValues&) = delete;
    SharedValues& operator=(const SharedValues&) = delete;

    double* of(int rank) const { return values_[rank]; }

    /// Writes by any rank before it are visible to all ranks after it. Collective.
    void fence() const;

 private:
    RankGroup group_;
    int exceptions_;  // on their way when it was made
    MPI_Win window_ = MPI_WIN_NULL;
    std::vector<double*> values_;
};

}  // namespace turbidite
