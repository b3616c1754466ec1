// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/timeline.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/host_name.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

constexpr auto longest_unwritten = std::chrono::seconds(1);
constexpr std::size_t most_unwritten = 1 << 16;  // [bytes]

/// Microseconds of the machine's monotonic clock, the same for all processes of a host.
double microseconds(std::chrono::steady_clock::time_point at) {
    return std::chrono::duration<double, std::micro>(at.time_since_epoch()).count();
}

// The file appears with its bracket, whichever process comes first.
void create_with_bracket(const fs::path& file, const std::string& unique) {
    const fs::path draft = file.string() + "." + unique;
    if (std::FILE* out = std::fopen(draft.c_str(), "w")) {
        std::fputs("[\n", out);
        std::fclose(out);
    }
    std::error_code exists;
    // Fails if the file is there already: the bracket is written once, before any event.
    fs::create_hard_link(draft, file, exists);
    fs::remove(draft, exists);
}

const char* name_of(Timeline::Part part) {
    switch (part) {
        case Timeline::Part::compute:
            return "compute";
        case Timeline::Part::wait:
            return "wait";
        case Timeline::Part::transfer:
            break;
    }
    return "transfer";
}

std::string name_event(const char* kind, const std::string& place, const std::string& name) {
    return std::string("{\"ph\":\"M\",\"name\":\"") + kind + "\"," + place +
           ",\"args\":{\"name\":\"" + name + "\"}},\n";
}

}  // namespace

Timeline::Timeline(const fs::path& run_folder, Role role, int rank)
    : file_(run_folder / "timeline" / (host_name() + ".json")),
      place_("\"pid\":" + std::to_string(static_cast<int>(role)) +
             // A role is shown as a process, a rank as a thread of it, whatever their real numbers.
             ",\"tid\":" + std::to_string(rank)) {
    std::error_code told_below;
    fs::create_directories(file_.parent_path(), told_below);
    const std::string own = std::string(role_name(role)) + std::to_string(rank);
    if (!fs::exists(file_, told_below)) create_with_bracket(file_, own);
    descriptor_ = ::open(file_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC);
    if (descriptor_ < 0)
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + file_.string() +
                          " (output.timeline): is the disk full, or the folder read-only?");
    text_ = name_event("process_name", place_, role_name(role)) +
            name_event("thread_name", place_, "rank " + std::to_string(rank));
}

Timeline::~Timeline() {
    note_span(Clock::now());
    flush();
    if (descriptor_ >= 0) ::close(descriptor_);
}

void Timeline::enter(Part part, const char* what, std::int64_t window) {
    const Clock::time_point now = Clock::now();
    note_span(now);
    part_ = part, what_ = what, window_ = window, begin_ = now;
    if (now - written_ > longest_unwritten || text_.size() > most_unwritten) flush();
}

void Timeline::note_span(Clock::time_point end) {
    if (descriptor_ < 0) return;
    char event[256];
    const int length = std::snprintf(
        event, sizeof event,
        "{\"ph\":\"X\",\"name\":\"%s\",\"cat\":\"%s\",\"ts\":%.3f,\"dur\":%.3f,%s,"
        "\"args\":{\"window\":%lld}},\n",
        what_, name_of(part_), microseconds(begin_), microseconds(end) - microseconds(begin_),
        place_.c_str(), static_cast<long long>(window_));
    // An event that was cut off would make the file unreadable from there on: left out.
    if (length > 0 && length < static_cast<int>(sizeof event)) text_.append(event, length);
}

void Timeline::flush() {
    struct stat now {};
    const bool room = descriptor_ >= 0 && ::fstat(descriptor_, &now) == 0 &&
                      now.st_size + static_cast<off_t>(text_.size()) <= most_bytes;
    // One call: lines of several processes do not mix.
    const bool whole = room && ::write(descriptor_, text_.data(), text_.size()) ==
                                   static_cast<ssize_t>(text_.size());
    text_.clear();
    written_ = Clock::now();
    if (whole || descriptor_ < 0) return;
    ::close(descriptor_);  // full: the run goes on without
    descriptor_ = -1;
}

}  // namespace turbidite
