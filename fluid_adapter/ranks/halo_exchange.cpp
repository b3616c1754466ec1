// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/halo_exchange.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

namespace turbidite {
namespace {

constexpr int import_tag = 4, export_tag = 5;
constexpr int nobody = -1;

/// The owner of each wanted cell. Every rank keeps the register for a range of cell numbers, so
/// that no rank holds the whole grid.
std::vector<int> owners_of(const RankGroup& group, int cells, const std::vector<int>& own,
                           const std::vector<int>& wanted) {
    // Rank r keeps the register of the cells r stretch .. (r + 1) stretch - 1.
    const int ranks = group.size(), stretch = (cells + ranks - 1) / ranks;
    ByRank<int> owned(ranks), asked(ranks), answers(ranks);
    for (const int cell : own) owned[cell / stretch].push_back(cell % stretch);
    for (const int cell : wanted) asked[cell / stretch].push_back(cell % stretch);

    std::vector<int> keeper(stretch, nobody);
    // All claims are in before the first question is answered.
    const ByRank<int> claims = all_to_all(group, owned), questions = all_to_all(group, asked);
    for (int rank = 0; rank < ranks; ++rank)
        for (const int cell : claims[rank]) keeper[cell] = rank;
    for (int rank = 0; rank < ranks; ++rank)
        for (const int cell : questions[rank]) answers[rank].push_back(keeper[cell]);

    const ByRank<int> replies = all_to_all(group, answers);
    std::vector<std::size_t> next(ranks, 0);
    std::vector<int> owners;
    for (const int cell : wanted) {
        const int rank = cell / stretch;
        // Answers come in the order of the questions.
        owners.push_back(replies[rank][next[rank]++]);
    }
    return owners;
}

}  // namespace

HaloExchange::HaloExchange(const RankGroup& group, int cells, const std::vector<int>& own,
                           const std::vector<int>& halo)
    : group_(group), own_(own.size()) {
    const std::vector<int> owners = owners_of(group, cells, own, halo);
    const bool known = std::find(owners.begin(), owners.end(), nobody) == owners.end();
    // All ranks throw together: one that stopped alone would leave the others waiting.
    if (!group.all(known)) throw std::invalid_argument("a cell of the grid belongs to no rank");
    find_neighbours(own, owners, halo);
}

void HaloExchange::find_neighbours(const std::vector<int>& own, const std::vector<int>& owners,
                                   const std::vector<int>& wanted) {
    ByRank<int> asked(group_.size());
    // Both sides of a pair have its cells in ascending order of their numbers, so that messages
    // hold values alone.
    for (std::size_t k = 0; k < wanted.size(); ++k) asked[owners[k]].push_back(wanted[k]);
    for (std::vector<int>& list : asked) std::sort(list.begin(), list.end());
    const ByRank<int> shared = turbidite::all_to_all(group_, asked);

    std::unordered_map<int, int> local;
    for (std::size_t c = 0; c < own.size(); ++c) local[own[c]] = static_cast<int>(c);
    for (int rank = 0; rank < group_.size(); ++rank) {
        if (asked[rank].empty() && shared[rank].empty()) continue;
        Neighbour neighbour;
        neighbour.rank = rank;
        for (const int cell : shared[rank]) neighbour.shared.push_back(local.at(cell));
        // The halo is ordered by owner: what comes from one neighbour is contiguous.
        neighbour.first = static_cast<int>(halo_.size());
        neighbour.count = static_cast<int>(asked[rank].size());
        halo_.insert(halo_.end(), asked[rank].begin(), asked[rank].end());
        neighbours_.push_back(std::move(neighbour));
    }
}

std::vector<int> HaloExchange::shared() const {
    std::vector<int> cells;
    for (const Neighbour& neighbour : neighbours_)
        cells.insert(cells.end(), neighbour.shared.begin(), neighbour.shared.end());
    return cells;
}

void HaloExchange::import(std::array<double*, 2> fields) {
    import({fields[0], fields[1]}, {fields[0] + own_, fields[1] + own_});
}

void HaloExchange::import(std::array<const double*, 2> own, std::array<double*, 2> halo) {
    for (Neighbour& neighbour : neighbours_) {
        neighbour.owned_values.clear();
        for (const double* field : own)
            // Both fields in one message, one after the other
            for (const int cell : neighbour.shared) neighbour.owned_values.push_back(field[cell]);
    }
    exchange(true);
    for (const Neighbour& neighbour : neighbours_) {
        const double* values = neighbour.halo_values.data();
        for (double* field : halo) {
            std::copy_n(values, neighbour.count, field + neighbour.first);
            values += neighbour.count;
        }
    }
}

void HaloExchange::export_sums(std::array<double*, 2> fields) {
    for (Neighbour& neighbour : neighbours_) {
        neighbour.halo_values.clear();
        for (const double* field : fields) {
            const double* halo = field + own_ + neighbour.first;
            neighbour.halo_values.insert(neighbour.halo_values.end(), halo, halo + neighbour.count);
        }
    }
    exchange(false);
    for (const Neighbour& neighbour : neighbours_) {
        const double* values = neighbour.owned_values.data();
        for (double* field : fields)
            // In ascending order of ranks, whichever message has come first
            for (const int cell : neighbour.shared) field[cell] += *values++;
    }
}

void HaloExchange::exchange(bool to_halo) {
    constexpr std::size_t fields = 2;
    const int tag = to_halo ? import_tag : export_tag;
    requests_.clear();
    for (Neighbour& neighbour : neighbours_) {
        std::vector<double>& in = to_halo ? neighbour.halo_values : neighbour.owned_values;
        in.resize(fields * (to_halo ? neighbour.count : neighbour.shared.size()));
        if (!in.empty())
            PMPI_Irecv(in.data(), static_cast<int>(in.size()), MPI_DOUBLE, neighbour.rank, tag,
                       group_.comm(), &requests_.emplace_back());
    }
    for (Neighbour& neighbour : neighbours_) {
        const std::vector<double>& out = to_halo ? neighbour.owned_values : neighbour.halo_values;
        if (!out.empty())
            PMPI_Isend(out.data(), static_cast<int>(out.size()), MPI_DOUBLE, neighbour.rank, tag,
                       group_.comm(), &requests_.emplace_back());
    }
    PMPI_Waitall(static_cast<int>(requests_.size()), requests_.data(), MPI_STATUSES_IGNORE);
}

}  // namespace turbidite
