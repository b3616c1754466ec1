// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Lines that a program leaves behind whatever ends it, SIGKILL included: each has a place of its
/// own in a file, in which it is replaced by one call of the system. Valid C++17.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace turbidite {

class KeptLines {
 public:
    /// Creates the file; one of an earlier program is emptied. Where that or a later change fails,
    /// on a full disk for instance, the line is missing and nothing else changes: the lines are for
    /// a reader who has no better source.
    explicit KeptLines(const std::filesystem::path& file);
    ~KeptLines();
    KeptLines(const KeptLines&) = delete;
    KeptLines& operator=(const KeptLines&) = delete;

    /// `text` has no line end; it is cut at 511 bytes.
    void set(std::size_t line, const std::string& text);

 private:
    int file_;
};

/// In their order, without those that are empty; none if there is no file.
std::vector<std::string> kept_lines(const std::filesystem::path& file);

}  // namespace turbidite
