// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The global cells by which contacts are ordered and divided among ranks: cubes of edge
//
//     L = max(5 d, 2 span/1e6),   d = 2 r_max (1 + share) + reach
//
// d is a bound of the distance of two centres in contact, r_max the largest radius up to four times
// the median, span the farthest a centre is from the origin of the cells (twenty bits are enough
// for a cell). Cells have one of eight parities, and since L > 2 d, contacts of different cells of
// one parity share no body.
#pragma once

#include <array>
#include <cstdint>

#include "granular_adapter/nscd/problem/bodies.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::nscd {

/// Of all bodies of a configuration, those of all ranks included.
struct CellSizes {
    double large = 0.0;     ///< radius above which bodies are a class of their own [m]
    double largest = 0.0;   ///< radius up to that [m]
    double smallest = 0.0;  ///< radius [m]
    double span = 0.0;      ///< the largest distance of a centre from the origin along any axis [m]
};

/// Without the span.
CellSizes sizes_of(const std::vector<double>& radii);
double span_of(const std::vector<Vec3>& centres, const Vec3& origin);
CellSizes cell_sizes(const Bodies& bodies, const PeriodicBox& box);

class ParityGrid {
 public:
    /// Contact points have gaps below reach + share (r_a + r_b).
    ParityGrid(const CellSizes& sizes, const PeriodicBox& box, double reach, double share);

    /// Indices of a cell along the axes.
    struct Cell {
        std::uint64_t x = 0, y = 0, z = 0;
        bool large = false;  ///< of no cell: a body is large

        /// 0 to 7, in the order of the sweep; 8 for the contacts of large bodies.
        int parity() const {
            return large ? 8 : static_cast<int>((x & 1) << 2 | (z & 1) << 1 | (y & 1));
        }
        /// Among all cells, in an order in which of two that touch the one with the lower parity
        /// comes first.
        std::uint64_t place() const;
    };
    Cell cell(const Vec3& centre) const;
    bool is_large(double radius) const { return radius > sizes_.large; }

    /// Centre of a cell [m].
    Vec3 centre(const Cell& cell) const;

    /// Bound of the distance of two centres in contact, whatever their size [m].
    double bound(double radius_a, double radius_b) const {
        return (radius_a + radius_b) * (1.0 + share_) + reach_;
    }

    /// Calls visit(cell) for all cells within the distance d of a point, some more than once.
    template <class Visit>
    void each_cell_near(const Vec3& x, const Visit& visit) const {
        for (int corner = 0; corner < 8; ++corner) {
            Vec3 there = x;
            for (int axis = 0; axis < 3; ++axis)
                there[axis] += (corner >> axis & 1) != 0 ? wide_ : -wide_;
            visit(cell(box_.wrap(there)));
        }
    }

    const CellSizes& sizes() const { return sizes_; }

 private:
    /// Equal cells along one axis: a fixed number where it is periodic.
    struct Axis {
        double lower = 0.0, edge = 1.0;
        std::int64_t count = 0;  ///< 0: no end

        std::uint64_t index(double x) const;
        double middle(std::uint64_t index) const;
    };

    CellSizes sizes_;
    PeriodicBox box_;
    double reach_, share_;
    double wide_;  ///< a little more than d
    std::array<Axis, 3> axes_;
};

}  // namespace turbidite::nscd
