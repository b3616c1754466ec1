// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Plays a recording to a participant: sends it what the coupler had sent, and compares what it
// answers, number by number, with what it had answered then. The participant cannot tell the
// difference, and its partner need not be there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "coupler/transport/recording.hpp"

namespace turbidite {

struct ReplayReport {
    std::int64_t windows = 0;      ///< that were played
    std::int64_t messages = 0;     ///< that were compared
    std::int64_t differences = 0;  ///< of them, how many contain a different number
    double largest = 0.0;          ///< |difference| over the largest of this number in its message
    std::vector<std::string> first;  ///< the first differences, one sentence each
    bool complete = true;            ///< false: the recording had been cut off
};

struct ReplayOrder {
    double limit = 600.0;  ///< waiting time for an answer [s]
    std::function<void(std::int64_t window)> progress = [](std::int64_t) {};
};

/// Throws Failure when the participant fails (its code and text), falls silent (stalled), sends a
/// message of another kind or order than then (participant failed), or has another number of ranks
/// (handshake refused).
ReplayReport replay(Recording& recording, Channel& participant, const ReplayOrder& order);

}  // namespace turbidite
