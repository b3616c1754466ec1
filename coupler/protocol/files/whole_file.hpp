// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Files that may be read at any time during a run.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>
#include <string>

namespace turbidite {

/// The content, byte for byte; empty if there is no file that can be read.
std::string read_whole(const std::filesystem::path& file);

/// Writes to a file beside `file` (name + ".part") and renames it: a reader sees either the old or
/// the new content, never a part of it. On failure throws Failure (participant failed) naming
/// `file`; the old content is then kept and the part removed.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(std::ostream&)>& content);

/// The same, and waits until the disk has the new content, under its name: after a power cut, too,
/// there is either the old content or the new one.
void write_whole_on_disk(const std::filesystem::path& file,
                         const std::function<void(std::ostream&)>& content);

}  // namespace turbidite
