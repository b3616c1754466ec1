// SPDX-License-Identifier: GPL-2.0-or-later
//
// Reads the layers of a rank's field in order, each extended by two values at both ends of its rows
// and, in space, by two rows at both ends, with two more layers below the first and above the last,
// so that stencils need not know about sides or ranks. Beyond a side lies the mirror image of the
// inside (the side is half a cell from the centres, separable_operator.hpp), shifted where the side
// prescribes a value (side_values.hpp); elsewhere, what box_rows.hpp says.
//
// Layers are copies: the caller may overwrite the field behind the reader. Valid C++17.
#pragma once

#include <array>
#include <functional>
#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"
#include "fluid_adapter/box_step/padded_layer.hpp"
#include "fluid_adapter/box_step/side_values.hpp"

namespace turbidite {

class RowReader {
 public:
    static constexpr int beyond = BoxRows::beyond;
    static_assert(beyond == PaddedLayer::beyond);

    /// `rows` must outlive it, and so must the values on the sides; null: none are prescribed.
    RowReader(const SeparableOperator& grid, BoxRows& rows, const SideValues* sides = nullptr);

    /// Restarts at the first layer. `values`: the rank's layers, contiguous. Called by every rank.
    void begin(const double* values);

    /// The same for a field that is to be changed first: `change(j)` changes layer j of `values`
    /// in place, once, before it is read. A pass that changes a field and one that reads it become
    /// one if the layers are read to the end.
    using Change = std::function<void(int)>;
    void begin(const double* values, Change change);

    /// Row k of layer j, -beyond <= j < layers + beyond: values [-beyond, x.cells + beyond); in
    /// space -beyond <= k < z.cells + beyond. Layers must be requested in ascending order; the last
    /// `kept` remain valid.
    const double* row(int j, int k = 0) {
        while (loaded_ < j) load(++loaded_);
        return slots_[static_cast<unsigned>(j + beyond) % kept].row(k);
    }

    /// Fills the values beyond both ends of row k of layer j, and the rows beyond both ends of the
    /// layer. Layers beyond the rank's own take the sides to be at rest: no stencil reaches into
    /// their corners.
    void extend(double* row, int j, int k) const;
    void extend(PaddedLayer& layer, int j) const;

    static constexpr int kept = 4;

 private:
    bool at_edge(int j) const { return j < beyond || j >= rows_.count() - beyond; }
    void load(int j);
    void look_outside(const double* values);
    void mirror(int from, int to, int side);
    double on_side(int side, int j, int k) const;
    void add_image(PaddedLayer& layer, int from, int to, int side, int j) const;
    bool own(int j) const { return j >= 0 && j < rows_.count(); }

    SeparableOperator grid_;
    BoxRows& rows_;
    const SideValues* sides_;
    const double* values_ = nullptr;
    Change change_;                        // of layers that are not at the edges; may be empty
    int loaded_ = 0;                       // index of the last layer read
    std::vector<double> edges_, outside_;  // as in box_rows.hpp
    std::vector<PaddedLayer> slots_;
};

/// Factor of the mirror image beyond this end: 1 or -1.
double mirrored(End end);

}  // namespace turbidite
