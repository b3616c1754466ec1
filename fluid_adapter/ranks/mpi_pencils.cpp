// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/ranks/mpi_pencils.hpp"

#include <algorithm>
#include <numeric>

namespace turbidite {
namespace {

constexpr int to_columns_tag = 1, to_rows_tag = 2;

int total_rows(const std::vector<Span>& spans) {
    return std::accumulate(spans.begin(), spans.end(), 0,
                           [](int sum, const Span& span) { return sum + span.count; });
}

}  // namespace

MpiPencils::MpiPencils(const RankGroup& group, int columns, const std::vector<Span>& rows_of_rank)
    : group_(group),
      columns_(columns),
      rows_of_rank_(rows_of_rank),
      modes_of_rank_(even_spans(columns, group.size())),
      row_values_(aligned_values(static_cast<std::size_t>(columns) * own_rows().count)),
      column_values_(
          aligned_values(static_cast<std::size_t>(own_modes().count) * total_rows(rows_of_rank))),
      starts_(group.size()) {
    std::size_t size = 0;
    for (int rank = 0; rank < group_.size(); ++rank) {
        starts_[rank] = size;
        if (rank != group_.rank()) size += packed_size(rank);
    }
    packed_.resize(size);
}

int MpiPencils::packed_size(int rank) const {
    return own_rows().count * modes_of_rank_[rank].count;
}

double* MpiPencils::block_of_rows(int rank) {
    return columns() + static_cast<std::size_t>(rows_of_rank_[rank].first) * mode_count();
}

/// visit(part of a row with the rank's modes, its place in `block`) for every row of this rank.
template <class Visit>
void MpiPencils::for_rows_of_block(int rank, double* block, Visit visit) {
    const Span& modes = modes_of_rank_[rank];
    double* part = rows() + modes.first;
    for (int j = 0; j < row_count(); ++j, part += columns_, block += modes.count)
        visit(part, block, modes.count);
}

void MpiPencils::to_columns() {
    const auto pack = [](const double* part, double* block, int n) { std::copy_n(part, n, block); };
    requests_.clear();
    for (int rank = 0; rank < group_.size(); ++rank)
        if (rank != group_.rank())
            PMPI_Irecv(block_of_rows(rank), rows_of_rank_[rank].count * mode_count(), MPI_DOUBLE,
                       rank, to_columns_tag, group_.comm(), &requests_.emplace_back());
    for (int step = 1; step < group_.size(); ++step) {
        const int rank = (group_.rank() + step) % group_.size();
        double* block = packed_.data() + starts_[rank];
        for_rows_of_block(rank, block, pack);
        PMPI_Isend(block, packed_size(rank), MPI_DOUBLE, rank, to_columns_tag, group_.comm(),
                   &requests_.emplace_back());
    }
    for_rows_of_block(group_.rank(), block_of_rows(group_.rank()), pack);
    PMPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

void MpiPencils::to_rows() {
    const auto unpack = [](double* part, const double* block, int n) {
        std::copy_n(block, n, part);
    };
    requests_.clear();
    for (int rank = 0; rank < group_.size(); ++rank)
        if (rank != group_.rank())
            PMPI_Irecv(packed_.data() + starts_[rank], packed_size(rank), MPI_DOUBLE, rank,
                       to_rows_tag, group_.comm(), &requests_.emplace_back());
    for (int step = 1; step < group_.size(); ++step) {
        const int rank = (group_.rank() + step) % group_.size();
        PMPI_Isend(block_of_rows(rank), rows_of_rank_[rank].count * mode_count(), MPI_DOUBLE, rank,
                   to_rows_tag, group_.comm(), &requests_.emplace_back());
    }
    for_rows_of_block(group_.rank(), block_of_rows(group_.rank()), unpack);
    PMPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    for (int rank = 0; rank < group_.size(); ++rank)
        if (rank != group_.rank()) for_rows_of_block(rank, packed_.data() + starts_[rank], unpack);
}

}  // namespace turbidite
