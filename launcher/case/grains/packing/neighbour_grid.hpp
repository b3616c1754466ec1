// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cells over the box, square or cubic, that hold the grains by their centres. The neighbours of a
// grain are in the nine cells around it, in space the 27: cells are at least as wide as the largest
// relevant distance of two centres, 2 R_max + reach. Grains may have any size and form; periodic
// directions use the nearest image.
#pragma once

#include <cstddef>
#include <vector>

#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

class NeighbourGrid {
 public:
    /// `reach` is the largest gap of interest [D]. Grains are discs unless their forms are given,
    /// which must outlive the grid.
    NeighbourGrid(const PackingBox& box, double largest_radius, double reach,
                  const GrainForms* forms = nullptr);

    void insert(const PlacedGrain& grain);
    void move(std::size_t index, double x, double y, double z = 0.0);

    const Packing& grains() const { return grains_; }

    /// Distance between circumscribed circles or spheres [D].
    double circle_gap(const PlacedGrain& one, const PlacedGrain& other) const;

    /// Surface distance between two grains, negative when they overlap [D].
    double gap(const PlacedGrain& one, const PlacedGrain& other) const;

    /// Indices of the grains in the cells around a point, each once, ascending.
    std::vector<std::size_t> near(double x, double y, double z = 0.0) const;

    /// True if no grain except number `except` is closer than `smallest_gap` to the surface of
    /// `grain`.
    bool is_free(const PlacedGrain& grain, double smallest_gap,
                 std::size_t except = static_cast<std::size_t>(-1)) const;

 private:
    std::size_t column(double x) const;
    std::size_t row(double y) const;
    std::size_t layer(double z) const;
    std::vector<std::size_t>& cell_at(const PlacedGrain& grain);
    Vec3 distance(const PlacedGrain& one, const PlacedGrain& other) const;
    bool is_closer(const PlacedGrain& one, const PlacedGrain& other, double least) const;
    /// Whether the predicate holds for one of the grains in the cells around a point.
    template <class Predicate>
    bool any_near(double x, double y, double z, const Predicate& holds) const;

    PackingBox box_;
    const GrainForms* forms_ = nullptr;
    double cell_ = 1.0;
    std::size_t columns_ = 1;
    std::size_t rows_ = 1;
    std::size_t layers_ = 1;
    std::vector<std::vector<std::size_t>> cells_;
    Packing grains_;
};

}  // namespace turbidite
