// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/ranks/cell_rows.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "fluid_adapter/ranks/mpi_pencils.hpp"

namespace turbidite {
namespace {

constexpr int cell_tag = 3;

bool are_all_once(std::vector<Span> spans, int total) {
    std::sort(spans.begin(), spans.end(), [](const Span& a, const Span& b) {
        return std::make_pair(a.first, a.count) < std::make_pair(b.first, b.count);
    });
    int next = 0;
    for (const Span& span : spans) {
        if (span.count > 0 && span.first != next) return false;
        next += span.count;
    }
    return next == total;
}

}  // namespace

CellRows::CellRows(const RankGroup& group, int columns, int rows, const std::vector<int>& cells)
    : group_(group), columns_(columns) {
    choose_rows(rows, cells);
    sort_cells(cells);
    check_complete();
    if (!straight_) return;
    own_cells_ = std::vector<int>(), own_places_ = std::vector<int>();  // 8 bytes per cell
}

std::unique_ptr<Pencils> CellRows::pencils() const {
    // Rows and columns are then one array, and no MPI is called.
    if (!group_.parallel()) return std::make_unique<WholeGrid>(columns_, rows_of_rank_[0].count);
    return std::make_unique<MpiPencils>(group_, columns_, rows_of_rank_);
}

double CellRows::first(const double* rows) const {
    const int root = row_holder(0);
    return group_.from(root, group_.rank() == root ? rows[0] : 0.0);
}

/// Uses the complete rows that the ranks already have, if they do; else even spans.
void CellRows::choose_rows(int rows, const std::vector<int>& cells) {
    int lowest = rows, highest = -1;
    for (const int cell : cells) {
        lowest = std::min(lowest, cell / columns_);
        highest = std::max(highest, cell / columns_);
    }
    const Span mine = cells.empty() ? Span{} : Span{lowest, highest - lowest + 1};
    // As many cells as these rows have: they are whole, unless a cell is there twice.
    const bool whole = static_cast<std::size_t>(mine.count) * columns_ == cells.size();
    const std::vector<int> firsts = group_.everywhere(mine.first);
    const std::vector<int> counts = group_.everywhere(mine.count);
    // Every rank decides by the same numbers, so all decide alike.
    rows_of_rank_ = even_spans(rows, group_.size());
    if (!group_.all(whole)) return;
    std::vector<Span> slabs(group_.size());
    for (int rank = 0; rank < group_.size(); ++rank) slabs[rank] = {firsts[rank], counts[rank]};
    // Otherwise cells are missing or duplicated, which the check below reports.
    if (are_all_once(slabs, rows)) rows_of_rank_ = slabs;
}

int CellRows::row_holder(int row) const {
    for (int rank = 0; rank < group_.size(); ++rank) {
        const Span& rows = rows_of_rank_[rank];
        if (row >= rows.first && row < rows.first + rows.count) return rank;
    }
    throw std::invalid_argument("the grid has no row " + std::to_string(row));
}

void CellRows::sort_cells(const std::vector<int>& cells) {
    const int ranks = group_.size();
    ByRank<int> away(ranks), places(ranks);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const int row = cells[c] / columns_;
        const int holder = row_holder(row);
        const int place = cells[c] - columns_ * rows_of_rank_[holder].first;
        const bool stays = holder == group_.rank();
        // The cell here, and in the same order its place in the rows of the rank that has these.
        (stays ? own_cells_ : away[holder]).push_back(static_cast<int>(c));
        (stays ? own_places_ : places[holder]).push_back(place);
    }
    const auto append = [](std::vector<Part>& parts, std::vector<int>& all, int rank,
                           const std::vector<int>& list) {
        if (list.empty()) return;
        const int begin = static_cast<int>(all.size());
        all.insert(all.end(), list.begin(), list.end());
        parts.push_back({rank, begin, static_cast<int>(all.size())});
    };
    // Each holder learns where the values that will come from a rank belong; later only values are
    // sent, in this order.
    const ByRank<int> received = all_to_all(group_, places);
    for (int rank = 0; rank < ranks; ++rank) {
        append(away_, away_cells_, rank, away[rank]);
        if (rank != group_.rank()) append(received_, received_places_, rank, received[rank]);
    }
    // own_cells_ is 0, 1, 2, ... here: the rank's order is that of the rows.
    straight_ = stays() && own_cells_ == own_places_;
    away_values_.resize(away_cells_.size());
    received_values_.resize(received_places_.size());
}

void CellRows::check_complete() const {
    const std::size_t size =
        static_cast<std::size_t>(rows_of_rank_[group_.rank()].count) * columns_;
    // Every place of a rank's rows is filled by exactly one cell, on all ranks.
    std::vector<int> places = own_places_;
    places.insert(places.end(), received_places_.begin(), received_places_.end());
    std::sort(places.begin(), places.end());
    bool complete = places.size() == size;
    for (std::size_t k = 0; complete && k < size; ++k) complete = places[k] == static_cast<int>(k);
    if (!group_.all(complete))
        throw std::invalid_argument(
            "the ranks' cells do not cover every cell of the grid exactly once");
}

void CellRows::begin_exchange(const std::vector<Part>& out, double* out_values,
                              const std::vector<Part>& in, double* in_values) {
    requests_.clear();
    // Receives first, so that arriving values have a place.
    for (const Part& part : in)
        PMPI_Irecv(in_values + part.begin, part.end - part.begin, MPI_DOUBLE, part.rank, cell_tag,
                   group_.comm(), &requests_.emplace_back());
    for (const Part& part : out)
        PMPI_Isend(out_values + part.begin, part.end - part.begin, MPI_DOUBLE, part.rank, cell_tag,
                   group_.comm(), &requests_.emplace_back());
}

void CellRows::end_exchange() {
    if (requests_.empty()) return;  // a single rank may have no MPI
    PMPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

}  // namespace turbidite
