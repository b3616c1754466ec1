// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "launcher/case/keys/wrapped_text.hpp"

namespace turbidite {

bool rewrites_lines() {
    const char* kind = std::getenv("TERM");
    return isatty(STDOUT_FILENO) != 0 && (kind == nullptr || std::string(kind) != "dumb");
}

int terminal_width() {
    winsize size{};
    int columns = 80;
    if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        columns = size.ws_col;
    else if (const char* given = std::getenv("COLUMNS"); given && std::atoi(given) > 0)
        columns = std::atoi(given);
    return std::clamp(columns, 40, 120);
}

std::string for_stdout(const std::string& lines) {
    return isatty(STDOUT_FILENO) ? fitted(lines, terminal_width()) : lines;
}

}  // namespace turbidite
