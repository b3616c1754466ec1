// SPDX-License-Identifier: LGPL-2.1-or-later
//
// G = B m^-1 B^T over the boundary points of all grains, the same for x and y: how an impulse at
// one point moves the fluid at another. Points act on each other where their stencils share cells,
// so G is sparse, and most cells are used by points of one grain alone. With private cells those,
// and shared ones the cells that points of several grains use or that other ranks know,
//
//     G  =  G_private  +  B_s m_s^-1 B_s^T
//
// where G_private has blocks of one grain, stored as numbers between points, and only the product
// with B_s, of the shared cells, goes through cells (and ranks). Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/plane/border_sums.hpp"

namespace turbidite {

class PointCoupling {
 public:
    /// Finds the shared cells. Then follow the rows of G_private, of all points in their order.
    void begin(const FluidField& field, const CollocationPoints& points);

    /// The cell of a slot is shared.
    bool shared(int slot) const { return shared_[slot] >= 0; }

    /// A row: with the point itself first, then with earlier points of the same grain.
    void begin_row() { row_.push_back(static_cast<int>(entries_.size())); }
    void add(int point, double value) { entries_.push_back({point, value}); }

    /// y = G w; point vectors as in boundary_operator.hpp. By every rank.
    void apply(const FluidField& field, const double* w, double* y);

 private:
    struct Entry {
        int point;
        double value;
    };
    struct Link {  // between a point and a shared cell
        int point, cell;
        double weight;
    };

    void find_shared(const FluidField& field, const CollocationPoints& points);
    int number(const FluidField& field, const StencilCell& at);
    void apply_private(const double* w, double* y) const;

    std::vector<int> user_;    // by slot: the grain whose points use the cell, -1 none, -2 several
    std::vector<int> shared_;  // by slot: number of the shared cell, -1 private
    std::vector<Link> links_;
    std::vector<PlaneVector> cells_;  // by number
    std::vector<double> per_mass_;    // 1/m_c, the same
    std::vector<BorderValue> border_;
    std::vector<int> row_;  // where each point's entries begin
    std::vector<Entry> entries_;
    BorderSums sums_;
};

}  // namespace turbidite
