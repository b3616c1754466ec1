// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_ranks/phase_window.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <stdexcept>
#include <thread>

namespace turbidite::nscd {
namespace {

constexpr std::size_t line = 8;  // doubles in a line of the cache

// About 50 microseconds, some phases. A rank that waits longer has lost its processor, or its
// partner has.
constexpr int hot_turns = 1200;

void pause_briefly() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

/// The number of phases that the owner of a part has posted.
std::atomic_ref<std::uint64_t> count_in(double* part) {
    static_assert(sizeof(std::uint64_t) == sizeof(double));
    return std::atomic_ref<std::uint64_t>(*reinterpret_cast<std::uint64_t*>(part));
}

void wait_for(double* part, std::uint64_t count) {
    // Acquires what the partner wrote before it released its count in post().
    for (int turn = 0; count_in(part).load(std::memory_order_acquire) < count; ++turn)
        if (turn < hot_turns)
            pause_briefly();
        else
            std::this_thread::yield();
}

std::size_t whole_lines(std::size_t doubles) {
    return (doubles + line - 1) / line * line;
}

}  // namespace

PhaseWindow::PhaseWindow(MPI_Comm communicator)
    : communicator_(communicator), exceptions_(std::uncaught_exceptions()) {
    PMPI_Comm_rank(communicator_, &rank_);
    PMPI_Comm_size(communicator_, &ranks_);
}

PhaseWindow::~PhaseWindow() {
    int finalized = 0;
    PMPI_Finalized(&finalized);
    // Both calls of release() wait for the other ranks, which may be anywhere if an exception
    // unwinds.
    if (!finalized && std::uncaught_exceptions() == exceptions_) release();
}

void PhaseWindow::release() {
    if (window_ == MPI_WIN_NULL) return;
    PMPI_Win_unlock_all(window_);
    PMPI_Win_free(&window_);
}

void PhaseWindow::allocate(std::size_t doubles) {
    release();
    MPI_Info apart = MPI_INFO_NULL;  // each rank's part on its own pages
    PMPI_Info_create(&apart);
    PMPI_Info_set(apart, "alloc_shared_noncontig", "true");
    double* own = nullptr;
    MPI_Errhandler usual = MPI_ERRHANDLER_NULL;
    PMPI_Comm_get_errhandler(communicator_, &usual);
    // A failure is to end with a message of our own instead of in MPI's usual handler.
    PMPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN);
    const int made = PMPI_Win_allocate_shared(static_cast<MPI_Aint>(doubles * sizeof(double)),
                                              sizeof(double), apart, communicator_, &own, &window_);
    PMPI_Comm_set_errhandler(communicator_, usual);
    PMPI_Errhandler_free(&usual);
    PMPI_Info_free(&apart);
    if (made != MPI_SUCCESS)
        throw std::runtime_error(
            "MPI could not allocate shared memory for the grains ranks: give /dev/shm more room "
            "(of a container with --shm-size), or name another folder in "
            "OMPI_MCA_osc_sm_backing_directory");
    // One epoch for the life of the window: ranks synchronise by their counts, not by MPI.
    PMPI_Win_lock_all(MPI_MODE_NOCHECK, window_);
    parts_.resize(static_cast<std::size_t>(ranks_));
    for (int rank = 0; rank < ranks_; ++rank) {
        MPI_Aint size = 0;
        int unit = 0;
        PMPI_Win_shared_query(window_, rank, &size, &unit, &parts_[static_cast<std::size_t>(rank)]);
    }
    count_ = 0;
    count_in(own).store(0, std::memory_order_release);
    capacity_ = doubles;
}

void PhaseWindow::prepare(const std::vector<Traffic>& phases) {
    const auto ranks = static_cast<std::size_t>(ranks_);
    // By receiver, its offsets of all phases: what it needs to know lies together.
    std::vector<unsigned long long> offsets(phases.size() * ranks), got(offsets.size());
    sent_at_.assign(phases.size() * ranks, 0), received_at_ = sent_at_;
    // The first line of each part is its count of phases.
    unsigned long long end = line;
    std::vector<char> meets(ranks, 0);
    for (std::size_t phase = 0; phase < phases.size(); ++phase)
        for (std::size_t rank = 0; rank < ranks; ++rank) {
            sent_at_[phase * ranks + rank] = offsets[rank * phases.size() + phase] = end;
            // Whole lines of the cache, so that no two ranks read and write parts of the same line.
            end += whole_lines(phases[phase].sent[rank]);
            if (phases[phase].sent[rank] + phases[phase].received[rank] > 0) meets[rank] = 1;
        }
    partners_.clear();
    for (std::size_t rank = 0; rank < ranks; ++rank)
        if (meets[rank] != 0) partners_.push_back(static_cast<int>(rank));
    const int count = static_cast<int>(phases.size());
    PMPI_Alltoall(offsets.data(), count, MPI_UNSIGNED_LONG_LONG, got.data(), count,
                  MPI_UNSIGNED_LONG_LONG, communicator_);
    for (std::size_t phase = 0; phase < phases.size(); ++phase)
        for (std::size_t rank = 0; rank < ranks; ++rank)
            received_at_[phase * ranks + rank] = got[rank * phases.size() + phase];
    // All ranks must allocate together, so the largest need decides; half as much again, so that it
    // does not happen in every step.
    PMPI_Allreduce(MPI_IN_PLACE, &end, 1, MPI_UNSIGNED_LONG_LONG, MPI_MAX, communicator_);
    if (end > capacity_) allocate(whole_lines(end + end / 2));
    // Nobody writes to its new places before everybody has read the last phase and, after
    // allocate(), has its count at zero.
    PMPI_Barrier(communicator_);
}

double* PhaseWindow::outgoing(std::size_t phase, int to) {
    return parts_[static_cast<std::size_t>(rank_)] + sent_at_[place(phase, to)];
}

void PhaseWindow::post(std::size_t) {
    // Every rank posts every phase, also with nothing to send, so that all counts mean the same
    // phase.
    count_in(parts_[static_cast<std::size_t>(rank_)]).store(++count_, std::memory_order_release);
}

void PhaseWindow::await(std::size_t) {
    for (const int partner : partners_) wait_for(parts_[static_cast<std::size_t>(partner)], count_);
}

const double* PhaseWindow::incoming(std::size_t phase, int from) {
    return parts_[static_cast<std::size_t>(from)] + received_at_[place(phase, from)];
}

}  // namespace turbidite::nscd
