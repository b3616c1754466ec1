// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "launcher/case/keys/wrapped_text.hpp"

namespace turbidite {

bool rewrites_lines() {
    const char* kind = std::getenv("TERM");
    return isatty(STDOUT_FILENO) != 0 && (kind == nullptr || std::string(kind) != "dumb");
}

namespace {

int width_of(int stream) {
    winsize size{};
    int columns = 80;
    if (ioctl(stream, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        columns = size.ws_col;
    else if (const char* given = std::getenv("COLUMNS"); given && std::atoi(given) > 0)
        columns = std::atoi(given);
    return std::clamp(columns, 40, 120);
}

std::string for_stream(int stream, const std::string& lines) {
    return isatty(stream) ? fitted(lines, width_of(stream)) : lines;
}

}  // namespace

int terminal_width() {
    return width_of(STDOUT_FILENO);
}

std::string for_stdout(const std::string& lines) {
    return for_stream(STDOUT_FILENO, lines);
}

std::string for_stderr(const std::string& lines) {
    return for_stream(STDERR_FILENO, lines);
}

bool stdout_took_all() {
    return std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
}

void print_on_stderr(const std::string& lines) {
    std::fputs(lines.c_str(), stderr);
}

void tell_on_stderr(const std::string& text) {
    print_on_stderr(for_stderr(fmt::format("turbidite: {}\n", text)));
}

}  // namespace turbidite
