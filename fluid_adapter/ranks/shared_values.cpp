// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/shared_values.hpp"

#include <sys/statvfs.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <limits>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

/// Where Open MPI keeps windows of shared memory.
std::string backing_directory() {
    const char* named = std::getenv("OMPI_MCA_osc_sm_backing_directory");
    return named ? named : "/dev/shm";
}

}  // namespace

double free_shared_memory() {
    struct statvfs disk;
    if (::statvfs(backing_directory().c_str(), &disk) != 0)
        return std::numeric_limits<double>::infinity();
    return static_cast<double>(disk.f_bavail) * static_cast<double>(disk.f_frsize);
}

bool SharedValues::fits(const RankGroup& group, std::size_t count, double free) {
    double bytes = static_cast<double>(count * sizeof(double)), least = -free;
    group.sum(&bytes, 1);
    group.max(&least, 1);  // of -free: the least free space
    // What MPI adds for itself, and what else is written there meanwhile.
    return 1.1 * bytes + 1e6 <= -least;
}

SharedValues::SharedValues(const RankGroup& group, std::size_t count)
    : group_(group), exceptions_(std::uncaught_exceptions()), values_(group.size()) {
    MPI_Info apart = MPI_INFO_NULL;  // each rank's array on its own pages
    PMPI_Info_create(&apart);
    PMPI_Info_set(apart, "alloc_shared_noncontig", "true");
    double* own = nullptr;
    // The default handler would abort the job without a message.
    MPI_Errhandler usual = MPI_ERRHANDLER_NULL;
    PMPI_Comm_get_errhandler(group_.comm(), &usual);
    PMPI_Comm_set_errhandler(group_.comm(), MPI_ERRORS_RETURN);
    const int made = PMPI_Win_allocate_shared(static_cast<MPI_Aint>(count * sizeof(double)),
                                              sizeof(double), apart, group_.comm(), &own, &window_);
    PMPI_Comm_set_errhandler(group_.comm(), usual);
    PMPI_Errhandler_free(&usual);
    PMPI_Info_free(&apart);
    if (made != MPI_SUCCESS)
        throw std::runtime_error(
            "MPI could not allocate shared memory for the ranks in " + backing_directory() +
            ": give it more room (of a container with --shm-size), or name another folder in "
            "OMPI_MCA_osc_sm_backing_directory");
    // One epoch from here until the window is freed; within it `fence` synchronises.
    PMPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
    for (int rank = 0; rank < group_.size(); ++rank) {
        MPI_Aint size = 0;
        int unit = 0;
        PMPI_Win_shared_query(window_, rank, &size, &unit, &values_[rank]);
    }
    // Each rank its own; the fence shows them to the others.
    std::fill_n(own, count, 0.0);
    fence();
}

SharedValues::~SharedValues() {
    int finalized = 0;  // the host's objects may outlive MPI
    PMPI_Finalized(&finalized);
    // Both calls wait for the other ranks.
    if (finalized || std::uncaught_exceptions() > exceptions_) return;
    PMPI_Win_unlock_all(window_);
    PMPI_Win_free(&window_);
}

void SharedValues::fence() const {
    // Own writes out, all ranks here, writes of others in.
    PMPI_Win_sync(window_);
    PMPI_Barrier(group_.comm());
    PMPI_Win_sync(window_);
}

}  // namespace turbidite
