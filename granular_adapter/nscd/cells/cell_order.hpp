// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order of contacts by global cells, in which Gauss-Seidel can be divided among ranks without
// changing a bit. Space is divided into cubes of edge
//
//     L = max(5 d, 2 span/1e6),   d = 2 r_max (1 + share) + reach
//
// d is a bound of the distance of two centres in contact, r_max the largest radius up to four times
// the median, span the farthest a centre is from the origin of the cells (twenty bits are enough
// for a cell). A contact belongs to the cell of its body with the lower id, and cells have one of
// eight parities. Since L > 2 d, contacts of different cells of one parity share no body: these
// cells may be swept in any order or at the same time.
//
// Order: parities of x, then z, then y, even before odd; within a cell from the top down
// (contact_order.hpp), in bands of equal height; ids; feature. Contacts of bodies above four times
// the median radius do not set the size of the cells: they are a class of their own after the eight
// parities, from the top down.
//
// The contacts are given in another order with the same result, in which neighbours follow each
// other closely, so that several sweeps can (sweep_pipeline.hpp): along each axis the cells 0, 2,
// 1, 4, 3, 6, 5, ... Cells that share a body differ by at most one along each axis, and of two such
// indices the even one is first in both orders.
//
// Nothing depends on the order in which bodies are stored.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

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

    void add(const ContactPoint& point);

    /// Indices of the points added so far, in order.
    std::vector<std::int32_t> take();

    /// Indices of a cell along the axes.
    struct Cell {
        std::uint64_t x = 0, y = 0, z = 0;
        bool large = false;  ///< of no cell: a body is large

        /// 0 to 7, in the order of the sweep; 8 for the contacts of large bodies.
        int parity() const {
            return large ? 8 : static_cast<int>((x & 1) << 2 | (z & 1) << 1 | (y & 1));
        }
    };
    Cell cell(const ContactPoint& point) const;

 private:
    /// Equal cells along one axis: a fixed number where it is periodic.
    struct Axis {
        double lower = 0.0, edge = 1.0;
        std::int64_t count = 0;  ///< 0: no end

        std::uint64_t index(double x) const;
    };
    struct Place {
        std::uint64_t cell;  ///< place of the cell in the order
        double layer;        ///< an integer, increasing downwards
        GrainId first, second;
        std::int32_t wall, feature;
        std::int32_t point;
    };

    void lay_axes(double least_edge);
    double layer(const ContactPoint& point) const;
    bool is_large(std::int32_t body) const;

    CellScene scene_;
    double large_ = 0.0;  ///< radius above which bodies are a class of their own [m]
    std::array<Axis, 3> axes_;
    Vec3 down_{};
    bool layered_ = false;
    std::vector<Place> places_;
};

}  // namespace turbidite::nscd
