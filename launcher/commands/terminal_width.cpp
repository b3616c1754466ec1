// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/commands/terminal_width.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "launcher/case/wrapped_text.hpp"

namespace turbidite {

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
