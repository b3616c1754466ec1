// SPDX-License-Identifier: LGPL-2.1-or-later
#include <algorithm>
#include <thread>

#include "coupler/transport/channel.hpp"

namespace turbidite {
namespace {

constexpr double hot = 50e-6;       // [s] of polling first: most answers on an idle machine
constexpr int shortest_sleep = 20;  // [us] near the expected arrival
constexpr int longest_sleep = 400;  // [us] limits the delay that sleeping adds to a window
constexpr double alert_from = 0.9;  // of the expected wait: from here on sleeps are short
constexpr double alert_until = 1.2;

}  // namespace

Patience::Patience(double expected) : start_(Clock::now()), expected_(expected) {}

double Patience::seconds() const {
    return std::chrono::duration<double>(Clock::now() - start_).count();
}

void Patience::wait(bool in_transit) {
    if (in_transit) return std::this_thread::yield();  // the other end may need this core
    const double waited = seconds();
    if (waited < hot) return;
    int sleep = std::min(shortest_sleep << std::min(sleeps_++, 5), longest_sleep);
    const bool near_arrival = waited > alert_from * expected_ && waited < alert_until * expected_;
    if (near_arrival) sleep = shortest_sleep;
    std::this_thread::sleep_for(std::chrono::microseconds(sleep));
}

}  // namespace turbidite
