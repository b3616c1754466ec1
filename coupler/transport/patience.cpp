// SPDX-License-Identifier: LGPL-2.1-or-later
#include <sys/prctl.h>

#include <algorithm>
#include <thread>

#include "coupler/transport/channel.hpp"
#include "coupler/transport/doorbell.hpp"

namespace turbidite {
namespace {

constexpr double hot = 50e-6;             // [s] of polling first: answers that come at once
constexpr double share = 1.0 / 64.0;      // of the time waited: what a sleep may add to it, unrung
constexpr double shortest_sleep = 20e-6;  // [s]
constexpr double longest_sleep = 2e-3;    // [s]
constexpr double longest_gap = 1.0;       // [s] between two looks of a process that is not stopped

/// By default Linux wakes a sleeper up to 50 us late.
void sleep_exactly() {
    static thread_local const int once = ::prctl(PR_SET_TIMERSLACK, 1000UL, 0UL, 0UL, 0UL);
    static_cast<void>(once);
}

double seconds_since(Patience::Clock::time_point past) {
    return std::chrono::duration<double>(Patience::Clock::now() - past).count();
}

}  // namespace

double Patience::seconds() const {
    return waited_ + std::min(seconds_since(last_look_), longest_gap);
}

void Patience::wait(bool in_transit) {
    waited_ = seconds();
    last_look_ = Clock::now();
    if (in_transit) return std::this_thread::yield();  // the other end may need this core
    // Since the last ring: after one, polling begins again, since its frame comes by MPI and may
    // take a few looks more.
    const double waited = seconds_since(last_ring_);
    if (waited < hot) return;
    sleep_exactly();
    // 1/64 of the time waited so far is at most what an unrung sleep adds to it, within the bounds.
    if (Doorbell::own().sleep(std::clamp(share * waited, shortest_sleep, longest_sleep)))
        last_ring_ = Clock::now();
}

}  // namespace turbidite
