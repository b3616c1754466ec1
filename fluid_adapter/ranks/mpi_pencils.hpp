// SPDX-License-Identifier: GPL-2.0-or-later
//
// Pencils (linear_solvers/pencils.hpp) shared by several ranks. Each rank holds the complete rows
// of a span of y and, after the transpose, the complete columns of a span of modes.
//
// Columns are stored row by row, so that the contribution of another rank's rows is contiguous. On
// one node the columns are in memory shared by the ranks, and every rank copies the parts of its
// rows to their places and back. Between nodes, and where that memory is short, they are sent as
// messages: packed on the way to the
// columns, where they arrive in place; on the way back they are sent in place and unpacked.
//
// Measured at 320 x 960 cells on two ranks of one node, without the kernel's copying between
// processes (as in containers): the two solves of the viscous step take 9.7 ms with messages and
// 4.7 ms with shared memory, 8.3 ms on one rank. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/linear_solvers/pencils.hpp"
#include "fluid_adapter/ranks/rank_group.hpp"
#include "fluid_adapter/ranks/shared_values.hpp"

namespace turbidite {

class MpiPencils final : public Pencils {
 public:
    /// `rows_of_rank`: spans of y, one per rank, in any order, that together contain every row
    /// once.
    MpiPencils(const RankGroup& group, int columns, const std::vector<Span>& rows_of_rank)
        : MpiPencils(group, columns, rows_of_rank, group.one_node()) {}

    /// Chooses whether memory is shared where it has room; for tests.
    MpiPencils(const RankGroup& group, int columns, const std::vector<Span>& rows_of_rank,
               bool shared_memory);

    int row_count() const override { return own_rows().count; }
    double* rows() override { return row_values_.get(); }
    int first_mode() const override { return own_modes().first; }
    int mode_count() const override { return own_modes().count; }
    double* columns() override {
        return shared_ ? shared_->of(group_.rank()) : column_values_.get();
    }
    void to_columns() override;
    void to_rows() override;
    double from_mode_zero(double value) const override { return group_.from(0, value); }

 private:
    const Span& own_rows() const { return rows_of_rank_[group_.rank()]; }
    const Span& own_modes() const { return modes_of_rank_[group_.rank()]; }
    std::size_t column_size() const;  // number of values in this rank's columns
    int packed_size(int rank) const;  // number of values shared with another rank, per direction
    double* block_of_rows(int rank);  // in this rank's columns: the part from that rank's rows
    double* place_of_rows(int rank);  // in that rank's shared columns: the part from our rows
    void send_to_columns();
    void send_to_rows();
    template <class Visit>
    void for_rows_of_block(int rank, double* block, Visit visit);
    template <class Visit>
    void for_shared_blocks(Visit visit);

    RankGroup group_;
    int columns_;
    std::vector<Span> rows_of_rank_, modes_of_rank_;
    AlignedValues row_values_;
    std::unique_ptr<SharedValues> shared_;  // columns, if on one node
    AlignedValues column_values_;           // columns otherwise
    // This rank's rows, grouped by the rank that holds the modes.
    std::vector<double> packed_;
    std::vector<std::size_t> starts_;  // start of each rank's group
    std::vector<MPI_Request> requests_;
};

}  // namespace turbidite
