// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/ranks/mpi_pencils.hpp"

#include <algorithm>
#include <numeric>

namespace turbidite {
namespace {

constexpr int to_columns_tag = 1, to_rows_tag = 2;

void pack(const double* part, double* block, int n) {
    std::copy_n(part, n, block);
}

void unpack(double* part, const double* block, int n) {
    std::copy_n(block, n, part);
}

int total_rows(const std::vector<Span>& spans) {
    return std::accumulate(spans.begin(), spans.end(), 0,
                           [](int sum, const Span& span) { return sum + span.count; });
}

}  // namespace

MpiPencils::MpiPencils(const RankGroup& group, int columns, const std::vector<Span>& rows_of_rank,
                       bool shared_memory)
    : group_(group),
      columns_(columns),
      rows_of_rank_(rows_of_rank),
      // Evenly, whatever rows the ranks have
      modes_of_rank_(even_spans(columns, group.size())),
      row_values_(aligned_values(static_cast<std::size_t>(columns) * own_rows().count)),
      starts_(group.size()) {
    if (shared_memory && SharedValues::fits(group, column_size())) {
        shared_ = std::make_unique<SharedValues>(group, column_size());
        return;
    }
    column_values_ = aligned_values(column_size());
    std::size_t size = 0;
    for (int rank = 0; rank < group_.size(); ++rank) {
        starts_[rank] = size;
        // The own part is copied straight to its place.
        if (rank != group_.rank()) size += packed_size(rank);
    }
    packed_.resize(size);
}

std::size_t MpiPencils::column_size() const {
    return static_cast<std::size_t>(own_modes().count) * total_rows(rows_of_rank_);
}

int MpiPencils::packed_size(int rank) const {
    return own_rows().count * modes_of_rank_[rank].count;
}

double* MpiPencils::block_of_rows(int rank) {
    // Columns are stored by y, mode_count() values each: rows of consecutive y are one block.
    return columns() + static_cast<std::size_t>(rows_of_rank_[rank].first) * mode_count();
}

/// visit(part of a row with that rank's modes, its place in `block`) for every row of this rank.
template <class Visit>
void MpiPencils::for_rows_of_block(int rank, double* block, Visit visit) {
    const Span& modes = modes_of_rank_[rank];
    double* part = rows() + modes.first;
    for (int j = 0; j < row_count(); ++j, part += columns_, block += modes.count)
        visit(part, block, modes.count);
}

/// The same for all ranks, with shared memory; the own block comes last, to avoid contention.
template <class Visit>
void MpiPencils::for_shared_blocks(Visit visit) {
    for (int step = 1; step <= group_.size(); ++step) {
        const int rank = (group_.rank() + step) % group_.size();
        for_rows_of_block(rank, place_of_rows(rank), visit);
    }
}

double* MpiPencils::place_of_rows(int rank) {
    return shared_->of(rank) +
           static_cast<std::size_t>(own_rows().first) * modes_of_rank_[rank].count;
}

void MpiPencils::to_columns() {
    if (!shared_) return send_to_columns();
    shared_->fence();  // no rank reads columns any more
    // Every rank writes its rows into the columns of all.
    for_shared_blocks(pack);
    shared_->fence();
}

void MpiPencils::to_rows() {
    if (!shared_) return send_to_rows();
    shared_->fence();
    // Only reads columns; the first fence of the next to_columns keeps them until all have done so.
    for_shared_blocks(unpack);
}

void MpiPencils::send_to_columns() {
    requests_.clear();
    for (int rank = 0; rank < group_.size(); ++rank)
        if (rank != group_.rank())
            // Straight to its place, where rows of consecutive y follow each other
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

void MpiPencils::send_to_rows() {
    requests_.clear();
    for (int rank = 0; rank < group_.size(); ++rank)
        if (rank != group_.rank())
            PMPI_Irecv(packed_.data() + starts_[rank], packed_size(rank), MPI_DOUBLE, rank,
                       to_rows_tag, group_.comm(), &requests_.emplace_back());
    for (int step = 1; step < group_.size(); ++step) {
        const int rank = (group_.rank() + step) % group_.size();
        // A block of columns is contiguous: sent as it is, unpacked into rows by the receiver.
        PMPI_Isend(block_of_rows(rank), rows_of_rank_[rank].count * mode_count(), MPI_DOUBLE, rank,
                   to_rows_tag, group_.comm(), &requests_.emplace_back());
    }
    // While messages are on their way
    for_rows_of_block(group_.rank(), block_of_rows(group_.rank()), unpack);
    PMPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
    for (int rank = 0; rank < group_.size(); ++rank)
        if (rank != group_.rank()) for_rows_of_block(rank, packed_.data() + starts_[rank], unpack);
}

}  // namespace turbidite
