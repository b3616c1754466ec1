// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Waiting for participants: a failure of any of them is reported at once, a soft limit prints who
// waits for whom, a hard limit ends the run.
#pragma once

#include <csignal>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "coupler/hub/participant_link.hpp"
#include "coupler/protocol/files/kept_lines.hpp"
#include "coupler/protocol/timeline.hpp"

namespace turbidite {

/// The program has been asked by a signal to end. Not an error of the run: the job is being ended
/// by mpirun, with a cause of its own.
struct EndedFromOutside {};

class Watch {
 public:
    using Print = std::function<void(const std::string&)>;

    /// Limits in seconds.
    Watch(std::vector<ParticipantLink*> links, double soft, double hard, Print print);

    /// Keeps the wait-for table in this file from now on, so that it is there when this program is
    /// killed in a wait.
    void leave_table(const std::filesystem::path& file);

    /// Returns when every rank of `link` has delivered `kind`. Throws Failure: one reported by a
    /// participant, or `stalled`, which names the silent ranks.
    void wait_for(ParticipantLink& link, Kind kind);

    /// Notes waits, and work between them, there.
    void set_timeline(Timeline* timeline) { timeline_ = timeline; }

    /// From now on `wait_for` throws EndedFromOutside when `signal` is not 0.
    void end_on(const volatile std::sig_atomic_t& signal) { signal_ = &signal; }

    /// One line per rank: who works, who waits, since when.
    std::string wait_for_table() const;

    /// Seconds spent in `wait_for` since the last call of this function.
    double take_waited();

 private:
    bool any_in_transit() const;
    void keep_table();

    std::vector<ParticipantLink*> links_;
    double soft_, hard_;
    Print print_;
    const volatile std::sig_atomic_t* signal_ = nullptr;
    Timeline* timeline_ = nullptr;
    std::unique_ptr<KeptLines> table_;
    double waited_ = 0.0;
};

}  // namespace turbidite
