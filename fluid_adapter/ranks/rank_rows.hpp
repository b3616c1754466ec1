// SPDX-License-Identifier: GPL-2.0-or-later
//
// The rows of a box (box_step/box_rows.hpp) distributed over several ranks: spans of y, where each
// rank exchanges two rows with those below and above. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/box_step/box_rows.hpp"
#include "fluid_adapter/ranks/cell_rows.hpp"

namespace turbidite {

class RankRows final : public BoxRows {
 public:
    /// Throws std::invalid_argument, on every rank, if a rank has fewer than `beyond` rows.
    RankRows(const RankGroup& group, const SeparableOperator& plane, const CellRows& cells);

    int first() const override { return own().first; }
    int count() const override { return own().count; }
    bool open_below() const override { return below_ >= 0; }
    bool open_above() const override { return above_ >= 0; }
    std::unique_ptr<Pencils> pencils() const override;
    void exchange(const double* edges, double* outside) override;

 private:
    const Span& own() const { return spans_[group_.rank()]; }
    int holder(int row) const;  // rank that has the row; -1 beyond a side

    RankGroup group_;
    int columns_, rows_;
    bool periodic_;
    std::vector<Span> spans_;
    int below_ = -1, above_ = -1;  // ranks
};

}  // namespace turbidite
