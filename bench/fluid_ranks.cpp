// SPDX-License-Identifier: GPL-3.0-or-later
#include "bench/fluid_ranks.hpp"

#include <type_traits>

namespace turbidite::bench {
namespace {

static_assert(std::is_trivially_copyable_v<Kick>, "kicks travel as bytes");

/// Where each rank's bytes begin in the list of all.
std::vector<int> starts_of(const std::vector<int>& counts) {
    std::vector<int> starts(counts.size(), 0);
    for (std::size_t r = 1; r < counts.size(); ++r) starts[r] = starts[r - 1] + counts[r - 1];
    return starts;
}

/// How far beyond its surface a grain matters to a rank. More than any stencil or rule of points
/// reaches, so that nothing here depends on them.
double margin(const Settings& settings) {
    return settings.real("run.diameter");
}

}  // namespace

FluidRanks::FluidRanks(bool parallel, int* argc, char*** argv) {
    if (!parallel) return;
    mpi_ = std::make_unique<MpiEnvironment>(argc, argv);
    ::MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
}

void FluidRanks::initialise(FoamAdapter& fluid, const Settings& settings,
                            const ShapeTable& shapes) {
    // Nobody else is in this world, so that OpenFOAM may have it as it is.
    if (mpi_) fluid.share(MPI_Comm_c2f(MPI_COMM_WORLD));
    const Box box = fluid.initialise(settings, shapes);
    if (mpi_) plan_.emplace(std::vector<Box>{box}, margin(settings), Vec3{});
}

std::vector<GrainState> FluidRanks::here(const std::vector<GrainState>& grains) const {
    if (!plan_) return grains;
    Motion motion;
    motion.grains = grains;
    return plan_->by_place(motion).front().grains;
}

std::vector<Kick> FluidRanks::all(const std::vector<Kick>& kicks) const {
    if (!mpi_) return kicks;
    int ranks = 0;
    ::MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    const int mine = static_cast<int>(kicks.size() * sizeof(Kick));
    std::vector<int> counts(ranks);
    ::MPI_Allgather(&mine, 1, MPI_INT, counts.data(), 1, MPI_INT, MPI_COMM_WORLD);
    const std::vector<int> starts = starts_of(counts);
    std::vector<Kick> result((starts.back() + counts.back()) / sizeof(Kick));
    ::MPI_Allgatherv(kicks.data(), mine, MPI_BYTE, result.data(), counts.data(), starts.data(),
                     MPI_BYTE, MPI_COMM_WORLD);
    return result;
}

void FluidRanks::meet() const {
    if (mpi_) ::MPI_Barrier(MPI_COMM_WORLD);
}

}  // namespace turbidite::bench
