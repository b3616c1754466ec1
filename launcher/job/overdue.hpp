// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What nobody within a job can notice: that mpirun starts none of its programs, and that it or a
// program stays when the run is over, in an exit handler of the user or a thread of its host, while
// the others wait in MPI_Finalize.
#pragma once

#include <chrono>
#include <optional>

#include "coupler/protocol/settings.hpp"
#include "launcher/case/files/run_folder.hpp"

namespace turbidite {

/// For JobOrder::had_children: whether programs of a job have been started, and all on this host.
bool played_here(const RunFolder& folder);

/// For JobOrder::overdue: whether a job has not begun within limits.start, or not ended within
/// limits.stall_hard of the end of its run, of which it says on stderr who stays.
class Overdue {
 public:
    Overdue(RunFolder folder, Settings settings);

    bool operator()();

 private:
    using Clock = std::chrono::steady_clock;  // a clock that is set would shorten or stretch it

    bool past(Clock::time_point from, const char* limit) const;
    bool has_not_begun();

    RunFolder folder_;
    Settings settings_;
    Clock::time_point ordered_ = Clock::now();
    bool begun_ = false;
    std::optional<Clock::time_point> over_;
};

}  // namespace turbidite
