// SPDX-License-Identifier: GPL-2.0-or-later
//
// Pencils (linear_solvers/pencils.hpp) shared by several ranks. Each rank holds the complete rows
// of a span of y and, after the transpose, the complete columns of a span of modes.
//
// Columns are stored row by row, so the part that another rank sends is one contiguous piece of
// them: on the way to columns values are copied once to pack them and arrive in place, on the way
// back they leave from where they are and are copied once on arrival. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"

namespace turbidite {

class MpiPencils final : public Pencils {
 public:
    /// `rows_of_rank`: spans of y, one per rank, which together are all rows once; in any order.
    MpiPencils(const RankGroup& group, int columns, const std::vector<Span>& rows_of_rank);

    int row_count() const override { return own_rows().count; }
    double* rows() override { return row_values_.get(); }
    int first_mode() const override { return own_modes().first; }
    int mode_count() const override { return own_modes().count; }
    double* columns() override { return column_values_.get(); }
    void to_columns() override;
    void to_rows() override;
    double from_mode_zero(double value) const override { return group_.from(0, value); }

 private:
    const Span& own_rows() const { return rows_of_rank_[group_.rank()]; }
    const Span& own_modes() const { return modes_of_rank_[group_.rank()]; }
    double* block_of_rows(int rank);  // columns: what comes from the rank's rows
    int packed_size(int rank) const;  // values shared with another rank, one way
    template <class Visit>
    void for_rows_of_block(int rank, double* block, Visit visit);

    RankGroup group_;
    int columns_;
    std::vector<Span> rows_of_rank_, modes_of_rank_;
    AlignedValues row_values_, column_values_;
    std::vector<double> packed_;       // this rank's rows, by the rank that has the modes
    std::vector<std::size_t> starts_;  // where each rank's part of it begins
    std::vector<MPI_Request> requests_;
};

}  // namespace turbidite
