// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Sums of per-grain values over the ranks that hold the grain. Ranks that share a grain find each
// other by its id, through a rank that keeps the register of that id: this needs no geometry and no
// list of all grains. After that only these ranks communicate. Sums run in the order of the ranks,
// so that all holders get the same bits. Valid C++17.
#pragma once

#include <vector>

#include "coupler/protocol/records.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class SharedGrains {
 public:
    explicit SharedGrains(const RankGroup& group) : group_(group) {}

    /// Sets the grains held by this rank, each once. Collective.
    void hold(const GrainId* ids, int count);

    /// Sums rows[g * per_grain ...] of the grains held, in place. Collective; `per_grain` is the
    /// same on every rank.
    void sum(double* rows, int per_grain);

 private:
    struct Partner {
        int rank = 0;
        std::vector<int> grains;  // held by both, in the order of ids
        std::vector<double> sent, received;
    };

    void begin(const double* rows, int per_grain);
    void add_own(double* rows, int per_grain) const;

    RankGroup group_;
    std::vector<Partner> partners_;
    std::vector<int> shared_;  // indices of grains held by other ranks too
    std::vector<double> own_;  // this rank's values of them
    std::vector<MPI_Request> requests_;
};

}  // namespace turbidite
