// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/ranks/rank_rows.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "fluid_adapter/ranks/mpi_pencils.hpp"

namespace turbidite {
namespace {

constexpr int upward_tag = 7, downward_tag = 8;

}  // namespace

RankRows::RankRows(const RankGroup& group, const SeparableOperator& plane, const CellRows& cells)
    : group_(group),
      columns_(plane.layer()),
      rows_(plane.y.cells),
      periodic_(plane.y.periodic()),
      spans_(cells.rows_of_rank()) {
    // All ranks know all spans, so all refuse.
    for (const Span& span : spans_)
        if (span.count < beyond)
            throw std::invalid_argument(std::to_string(rows_) + " rows of cells are too few for " +
                                        std::to_string(group.size()) + " ranks");
    below_ = holder(first() - 1);
    above_ = holder(first() + count());
}

int RankRows::holder(int row) const {
    // Called with -1 and rows_ as well, just beyond the ends.
    if (periodic_) row = (row + rows_) % rows_;
    for (int rank = 0; rank < group_.size(); ++rank)
        if (row >= spans_[rank].first && row < spans_[rank].first + spans_[rank].count) return rank;
    return -1;
}

std::unique_ptr<Pencils> RankRows::pencils() const {
    return std::make_unique<MpiPencils>(group_, columns_, spans_);
}

void RankRows::exchange(const double* edges, double* outside) {
    // edges: first two rows, last two; outside: two below, two above. Tags name the direction of
    // travel: on a ring of two ranks both neighbours are the same one.
    const int two_rows = beyond * columns_;
    MPI_Request requests[4];
    int count = 0;
    if (open_below()) {
        PMPI_Irecv(outside, two_rows, MPI_DOUBLE, below_, upward_tag, group_.comm(),
                   &requests[count++]);
        PMPI_Isend(edges, two_rows, MPI_DOUBLE, below_, downward_tag, group_.comm(),
                   &requests[count++]);
    }
    if (open_above()) {
        PMPI_Irecv(outside + two_rows, two_rows, MPI_DOUBLE, above_, downward_tag, group_.comm(),
                   &requests[count++]);
        PMPI_Isend(edges + two_rows, two_rows, MPI_DOUBLE, above_, upward_tag, group_.comm(),
                   &requests[count++]);
    }
    PMPI_Waitall(count, requests, MPI_STATUSES_IGNORE);
}

}  // namespace turbidite
