// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Exchange of cell values known to several ranks: each cell has one owner, and any number of ranks
// may have it in their halo. Two ranks are neighbours if one owns a halo cell of the other, so any
// decomposition is possible. There is one message per neighbour and direction for all components
// together: latency matters more than volume to an iteration that calls this several times. Valid
// C++17.
#pragma once

#include <array>
#include <vector>

#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class HaloExchange {
 public:
    /// `cells`: number of cells of the grid. `own`: numbers of this rank's cells, which have the
    /// local indices 0, 1, ...; `halo`: numbers of the other cells it knows, in any order.
    /// Collective; throws std::invalid_argument on every rank if a halo cell has no owner.
    HaloExchange(const RankGroup& group, int cells, const std::vector<int>& own,
                 const std::vector<int>& halo);

    /// The halo cells in the order of their local indices, which follow those of the own cells.
    const std::vector<int>& halo() const { return halo_; }

    /// Own cells that are in another rank's halo, possibly repeated.
    std::vector<int> shared() const;

    /// Owners' values of two fields into the halos: one value per own cell, one per halo cell.
    void import(std::array<const double*, 2> own, std::array<double*, 2> halo);

    /// The same where the halo's values follow the own cells'.
    void import(std::array<double*, 2> fields);

    /// Adds halos' values to the owners'. Contributions are added in the order of the ranks.
    void export_sums(std::array<double*, 2> fields);

 private:
    struct Neighbour {
        int rank = 0;
        std::vector<int> shared;   // own cells that are in its halo
        int first = 0, count = 0;  // halo cells that it owns, in the halo's order
        std::vector<double> owned_values, halo_values;
    };

    void find_neighbours(const std::vector<int>& own, const std::vector<int>& owners,
                         const std::vector<int>& wanted);
    void exchange(bool to_halo);

    RankGroup group_;
    std::size_t own_;  // cells
    std::vector<int> halo_;
    std::vector<Neighbour> neighbours_;
    std::vector<MPI_Request> requests_;
};

}  // namespace turbidite
