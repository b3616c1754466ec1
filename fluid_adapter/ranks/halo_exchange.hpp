// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Values of cells that several ranks know: one owner, any number of ranks with the cell in their
// halo. Neighbours are whoever owns a halo cell, so any decomposition will do. One message per
// neighbour and direction, for all components at once: an iteration that calls this several times
// pays for latency more than for bytes. Valid C++17.
#pragma once

#include <initializer_list>
#include <vector>

#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class HaloExchange {
 public:
    /// `cells`: how many the grid has. `own`: numbers of this rank's cells, which have the local
    /// indices 0, 1, ...; `halo`: numbers of the others it knows, in any order. Collective; throws
    /// std::invalid_argument on every rank when a halo cell has no owner.
    HaloExchange(const RankGroup& group, int cells, const std::vector<int>& own,
                 const std::vector<int>& halo);

    /// The halo in the order of its local indices, which follow the own cells'.
    const std::vector<int>& halo() const { return halo_; }

    /// Own cells that are in another rank's halo, some twice.
    std::vector<int> shared() const;

    /// Owners' values into the halos. Every field has one value per local cell.
    void import(std::initializer_list<double*> fields);

    /// Adds halos' values to the owners'. Contributions are added in the order of the ranks.
    void export_sums(std::initializer_list<double*> fields);

 private:
    struct Neighbour {
        int rank = 0;
        std::vector<int> shared;   // own cells that are in its halo
        int first = 0, count = 0;  // halo cells that it owns: local indices
        std::vector<double> owned_values, halo_values;
    };

    void find_neighbours(const std::vector<int>& own, const std::vector<int>& owners,
                         const std::vector<int>& wanted);
    void exchange(std::size_t fields, bool to_halo);

    RankGroup group_;
    std::vector<int> halo_;
    std::vector<Neighbour> neighbours_;
    std::vector<MPI_Request> requests_;
};

}  // namespace turbidite
