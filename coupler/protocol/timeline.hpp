// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// What each rank did when, as a trace that Perfetto (ui.perfetto.dev) and chrome://tracing open:
/// the JSON array form of the trace event format, whose closing bracket may be missing, so that the
/// file of a killed run is as good as that of one that ended.
///
///     RUN/timeline/HOST.json      all ranks on that host, on its clock
///
/// Processes append whole lines. Nothing is written any more once the file has 64 MB. Valid C++17.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <string>

#include "coupler/protocol/hello.hpp"

namespace turbidite {

/// One rank's part of the trace.
class Timeline {
 public:
    enum class Part { compute, wait, transfer };

    static constexpr std::int64_t most_bytes = 64 << 20;

    /// Opens or joins the file of this host. Throws Failure (participant failed) naming the file.
    Timeline(const std::filesystem::path& run_folder, Role role, int rank);
    ~Timeline();
    Timeline(const Timeline&) = delete;
    Timeline& operator=(const Timeline&) = delete;

    /// From now on the rank does this; what it did before ends. `what` outlives the timeline.
    void enter(Part part, const char* what, std::int64_t window);

    /// Writes what has been noted; else this happens every second. A full disk stops it for good.
    void flush();

    const std::filesystem::path& file() const { return file_; }

 private:
    using Clock = std::chrono::steady_clock;

    void note_span(Clock::time_point end);

    std::filesystem::path file_;
    std::string place_;  ///< "pid": …, "tid": … of every event
    std::string text_;   ///< not yet written
    int descriptor_ = -1;
    Part part_ = Part::transfer;
    const char* what_ = "start";
    std::int64_t window_ = -1;
    Clock::time_point begin_ = Clock::now(), written_ = begin_;
};

/// For a timeline that may be absent.
inline void enter(Timeline* timeline, Timeline::Part part, const char* what, std::int64_t window) {
    if (timeline) timeline->enter(part, what, window);
}

}  // namespace turbidite
