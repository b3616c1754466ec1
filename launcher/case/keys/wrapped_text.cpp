// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/wrapped_text.hpp"

#include <sstream>

namespace turbidite {
namespace {

constexpr int narrowest_column = 20;

/// Where the text of a line begins that its continuations stand below.
int text_column(const std::string& line, int width) {
    const std::size_t first = line.find_first_not_of(' ');
    const std::size_t gap = line.find("  ", first);
    const std::size_t second = line.find_first_not_of(' ', gap);
    const bool has_room =
        second != std::string::npos && static_cast<int>(second) + narrowest_column <= width;
    return static_cast<int>(has_room ? second : first);
}

std::string fitted_line(const std::string& line, int width) {
    if (static_cast<int>(line.size()) <= width) return line + "\n";
    const int column = text_column(line, width);
    return line.substr(0, column) + wrapped(line.substr(column), column, width).substr(column);
}

}  // namespace

std::string wrapped(const std::string& text, int indent, int width) {
    std::istringstream words(text);
    std::string lines, line(indent, ' '), word;
    bool begun = false;
    while (words >> word) {
        if (begun && static_cast<int>(line.size() + 1 + word.size()) > width) {
            lines += line + "\n";
            line.assign(indent, ' ');
            begun = false;
        }
        line += (begun ? " " : "") + word;
        begun = true;
    }
    return begun ? lines + line + "\n" : lines;
}

std::string fitted(const std::string& lines, int width) {
    std::istringstream all(lines);
    std::string text;
    for (std::string line; std::getline(all, line);) text += fitted_line(line, width);
    return text;
}

}  // namespace turbidite
