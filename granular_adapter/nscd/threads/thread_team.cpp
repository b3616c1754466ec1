// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/threads/thread_team.hpp"

#include <utility>

namespace turbidite::nscd {
namespace {

// About 20 microseconds, the time of a few stretches of a sweep. A thread that waits longer has
// lost its processor, or its partner has.
constexpr int hot_turns = 500;

void pause_briefly() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
}

}  // namespace

void ThreadTeam::Patience::wait() {
    if (++turns_ < hot_turns)
        pause_briefly();
    else
        std::this_thread::yield();
}

void ThreadTeam::Meeting::wait() {
    const std::int64_t before = arrivals_.fetch_add(1, std::memory_order_acq_rel);
    const std::int64_t all = (before / threads_ + 1) * threads_;
    Patience patience;
    while (arrivals_.load(std::memory_order_acquire) < all) patience.wait();
}

ThreadTeam::ThreadTeam(int size) {
    for (int number = 1; number < size; ++number)
        threads_.emplace_back([this, number] { serve(number); });
}

ThreadTeam::~ThreadTeam() {
    order_.store(-1, std::memory_order_release);
    order_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

void ThreadTeam::run(const std::function<void(int)>& work) {
    if (threads_.empty()) return work(0);
    work_ = &work;
    // The release of order_ publishes work_ and busy_ to the threads that acquire it; the release
    // of each thread's busy_ publishes what it has written to the caller.
    busy_.store(static_cast<int>(threads_.size()), std::memory_order_relaxed);
    order_.fetch_add(1, std::memory_order_release);
    order_.notify_all();
    work_as(0);
    Patience patience;
    while (busy_.load(std::memory_order_acquire) > 0) patience.wait();
    if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadTeam::work_as(int number) {
    try {
        (*work_)(number);
    } catch (...) {
        const std::lock_guard lock(failing_);
        if (!failure_) failure_ = std::current_exception();
    }
}

void ThreadTeam::serve(int number) {
    for (std::int64_t seen = 0;;) {
        Patience patience;
        // Sweeps follow each other within microseconds: spinning saves waking the thread. Between
        // solves it sleeps.
        for (int turn = 0; turn < hot_turns && order_.load(std::memory_order_acquire) == seen;
             ++turn)
            patience.wait();
        order_.wait(seen, std::memory_order_acquire);
        seen = order_.load(std::memory_order_acquire);
        if (seen < 0) return;
        work_as(number);
        busy_.fetch_sub(1, std::memory_order_release);
    }
}

}  // namespace turbidite::nscd
