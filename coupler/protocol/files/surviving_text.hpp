// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// A text that a program leaves behind whatever ends it, SIGKILL included: it lies in memory shared
/// with a file, so that the system has it with every change, without a call. Valid C++17.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace turbidite {

class SurvivingText {
 public:
    /// Creates the file, for texts of up to `capacity` bytes; one of an earlier program is emptied.
    /// Where that fails, on a full disk for instance, nothing is left behind, and nothing else
    /// changes: the text is for a reader who has no better source.
    SurvivingText(const std::filesystem::path& file, std::size_t capacity);
    ~SurvivingText();
    SurvivingText(const SurvivingText&) = delete;
    SurvivingText& operator=(const SurvivingText&) = delete;

    /// Cut at the capacity. A program that is killed meanwhile leaves an empty text.
    void set(const std::string& text);

 private:
    std::size_t capacity_;
    char* memory_ = nullptr;
};

/// Empty if there is none.
std::string read_surviving_text(const std::filesystem::path& file);

}  // namespace turbidite
