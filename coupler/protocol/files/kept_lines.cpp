// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/kept_lines.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <fstream>

namespace turbidite {
namespace {

constexpr std::size_t line_size = 512;  // bytes, with blanks behind the text and the line's end

}  // namespace

KeptLines::KeptLines(const std::filesystem::path& file)
    : file_(open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {}

KeptLines::~KeptLines() {
    if (file_ >= 0) close(file_);
}

void KeptLines::set(std::size_t line, const std::string& text) {
    if (file_ < 0) return;
    std::string whole = text.substr(0, line_size - 1);
    whole.resize(line_size - 1, ' ');
    whole += '\n';
    // A line lies within a page, so a reader sees it whole, the old one or the new one.
    const auto place = static_cast<off_t>(line * line_size);
    [[maybe_unused]] const ssize_t written = pwrite(file_, whole.data(), whole.size(), place);
}

std::vector<std::string> kept_lines(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        line.erase(line.find_last_not_of(std::string(" \0", 2)) + 1);
        // Where an earlier line is not there, the file has a hole.
        line.erase(0, line.find_first_not_of('\0'));
        if (!line.empty()) lines.push_back(line);
    }
    return lines;
}

}  // namespace turbidite
