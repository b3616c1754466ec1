// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/ranks/shared_values.hpp"

#include <algorithm>
#include <stdexcept>

namespace turbidite {

SharedValues::SharedValues(const RankGroup& group, std::size_t count)
    : group_(group), values_(group.size()) {
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
        throw std::runtime_error("MPI could not allocate shared memory for the ranks");
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
    if (finalized) return;
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
