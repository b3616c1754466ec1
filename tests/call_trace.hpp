// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The calls of this process by which files get to the disk, in their order: fsync and rename take
// the place of libc's in a program that links call_trace.cpp, and call them.
#pragma once

#include <sys/stat.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace turbidite::trace {

/// What a file or a folder was at some moment; another write, or another entry, changes it.
struct Version {
    long size = -1;
    timespec changed{};

    bool operator==(const Version& other) const {
        return size == other.size && changed.tv_sec == other.changed.tv_sec &&
               changed.tv_nsec == other.changed.tv_nsec;
    }
};

Version version_of(const std::filesystem::path& path);

struct Call {
    enum class Kind { sync, rename } kind;
    std::filesystem::path path, to;  ///< `to`: of a rename
    Version version;                 ///< of the path, before the call
    /// Of a folder that is renamed: its files.
    std::map<std::filesystem::path, Version> content;
};

/// The calls since it was made. One at a time.
class Recorder {
 public:
    Recorder();
    ~Recorder();
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;

    std::vector<Call> calls() const;
};

/// The versions that the disk has after these calls, by the names they then have.
std::map<std::filesystem::path, Version> on_disk(const std::vector<Call>& calls);

}  // namespace turbidite::trace
