// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/fluid/fluid_ranks.hpp"

#include <type_traits>

namespace turbidite::bench {
namespace {

/// Offsets of each rank's bytes in the concatenated list.
std::vector<int> starts_of(const std::vector<int>& counts) {
    std::vector<int> starts(counts.size(), 0);
    for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
    return starts;
}

template <class Record>
std::vector<Record> of_all_ranks(const std::vector<Record>& records) {
    static_assert(std::is_trivially_copyable_v<Record>, "records travel as bytes");
    int ranks = 0;
    ::MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const int mine = static_cast<int>(records.size() * sizeof(Record));
    std::vector<int> counts(ranks);
    ::MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    const std::vector<int> starts = starts_of(counts);
    std::vector<Record> result((starts.back() + counts.back()) / sizeof(Record));
    ::MPI_Allgatherv(records.data(), mine, MPI_BYTE, result.data(), counts.data(), starts.data(),
                     MPI_BYTE, MPI_COMM_WORLD);
    return result;
}

}  // namespace

FluidRanks::FluidRanks(bool parallel, int* argc, char*** argv) {
    if (!parallel) return;
    mpi_ = std::make_unique<MpiEnvironment>(argc, argv);
    ::MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
}

void FluidRanks::initialise(FoamAdapter& fluid, const Settings& settings,
                            const ShapeTable& shapes) {
    // This world has no other programs, so OpenFOAM may use it directly.
    if (mpi_) fluid.share(MPI_Comm_c2f(MPI_COMM_WORLD));
    const Box box = fluid.initialise(settings, shapes);
    if (mpi_) plan_.emplace(std::vector<Box>{box}, Vec3{});
}

std::vector<GrainState> FluidRanks::here(const std::vector<GrainState>& grains) const {
    if (!plan_) return grains;
    Motion motion;
    motion.grains = grains;
    return plan_->by_place(motion).front().grains();
}

std::vector<Kick> FluidRanks::all(const std::vector<Kick>& kicks) const {
    return mpi_ ? of_all_ranks(kicks) : kicks;
}

std::vector<FreeResponse> FluidRanks::all(const std::vector<FreeResponse>& responses) const {
    return mpi_ ? of_all_ranks(responses) : responses;
}

void FluidRanks::meet() const {
    if (mpi_) ::MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace turbidite::bench
