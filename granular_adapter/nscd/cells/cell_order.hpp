// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order of contacts by global cells (parity_grid.hpp), in which Gauss-Seidel can be divided
// among ranks without changing a bit. A contact belongs to the cell of its body with the lower id.
// Contacts of different cells of one parity share no body: these cells may be swept in any order or
// at the same time.
//
// Order: parities of x, then z, then y, even before odd; within a cell from the top down
// (contact_order.hpp), in bands of equal height; ids; feature. Contacts of bodies above four times
// the median radius do not set the size of the cells: they are a class of their own after the eight
// parities, from the top down.
//
// On one rank the contacts are given in another order with the same result, in which neighbours
// follow each other closely, so that several sweeps can (sweep_pipeline.hpp): along each axis the
// cells 0, 2, 1, 4, 3, 6, 5, ... Cells that share a body differ by at most one along each axis, and
// of two such indices the even one is first in both orders. On several ranks they are in phases,
// parity by parity.
//
// Nothing depends on the order in which bodies are stored.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "granular_adapter/nscd/cells/parity_grid.hpp"
#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/problem/contact_cells.hpp"
#include "granular_adapter/nscd/threads/thread_team.hpp"

namespace turbidite::nscd {

/// A configuration to be ordered. References, which must outlive the order.
struct CellScene {
    const Bodies& bodies;
    const std::vector<Wall>& walls;
    PeriodicBox box;
    Vec3 gravity{};      ///< without it all contacts have the same height
    double reach = 0.0;  ///< contact points have gaps below reach + share (r_a + r_b) [m]
    double share = 0.0;
    double band = 0.0;  ///< heights that differ by less count as equal [m]
};

class CellOrder {
 public:
    explicit CellOrder(const CellScene& scene);
    /// On several ranks: contacts in phases, by cells that are the same for all.
    CellOrder(const CellScene& scene, const ParityGrid& grid);

    /// What decides where a point comes.
    struct Place {
        std::uint64_t cell;  ///< place of the cell in the order
        double layer;        ///< an integer, increasing downwards
        GrainId first, second;
        std::int32_t wall, feature;
        std::int32_t phase;
        std::int32_t point;  ///< index in the order of detection
    };
    Place place(const ContactPoint& point) const;

    void add(Place place);

    /// Indices of the points added so far, in order. The team shares the work.
    std::vector<std::int32_t> take(ThreadTeam& team);

    /// The cells of the points taken last, and the number of them up to the end of each phase.
    ContactCells take_cells() { return std::move(cells_); }
    std::vector<std::size_t> take_phase_ends() { return std::move(phase_ends_); }

    using Cell = ParityGrid::Cell;
    Cell cell(const ContactPoint& point) const;

 private:
    double layer(const ContactPoint& point) const;
    bool is_large(std::int32_t body) const;
    void take_phase(const std::vector<Place>& places, std::vector<std::int32_t>& order);

    CellScene scene_;
    ParityGrid grid_;
    Vec3 down_{};
    bool layered_ = false;
    bool by_parity_;
    std::vector<std::vector<Place>> phases_;
    std::int32_t count_ = 0;
    ContactCells cells_;
    std::vector<std::size_t> phase_ends_;
};

}  // namespace turbidite::nscd
