// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/foam_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "coupler/protocol/received.hpp"

namespace turbidite {
namespace {

constexpr std::size_t warnings_quoted = 3;

std::string without_indent(const std::string& line) {
    const auto words = line.find_first_not_of(' ');
    return words == std::string::npos ? "" : received_line(line.substr(words));
}

bool begins_warning(const std::string& line) {
    return line.rfind("--> FOAM ", 0) == 0 && line.find("Warning", 9) != std::string::npos;
}

/// Where in OpenFOAM a warning comes from: "From function …", "in file … at line 125".
bool names_the_source(const std::string& words) {
    return words.rfind("From ", 0) == 0 || words.rfind("in file ", 0) == 0;
}

void add(std::vector<FoamWarning>& warnings, const std::string& text) {
    const auto known = std::find_if(warnings.begin(), warnings.end(),
                                    [&](const FoamWarning& one) { return one.text == text; });
    if (known != warnings.end())
        ++known->count;
    else
        warnings.push_back({text, 1});
}

}  // namespace

std::vector<FoamWarning> foam_warnings(const std::filesystem::path& log) {
    std::ifstream input(log);
    std::vector<FoamWarning> warnings;
    bool begun = false;
    for (std::string line; std::getline(input, line);) {
        const std::string words = without_indent(line);
        if (begins_warning(line)) {
            begun = true;
        } else if (begun && !words.empty() && !names_the_source(words)) {
            add(warnings, words);
            begun = false;
        }
    }
    return warnings;
}

std::string foam_warning_text(const std::vector<FoamWarning>& warnings, const std::string& log) {
    if (warnings.empty()) return "";
    int all = 0;
    std::string quoted;
    for (std::size_t w = 0; w < warnings.size(); ++w) {
        all += warnings[w].count;
        if (w >= warnings_quoted) continue;
        quoted += fmt::format("{}\"{}\"", w == 0 ? "" : ", ", warnings[w].text);
        if (warnings[w].count > 1) quoted += fmt::format(" ({} times)", warnings[w].count);
    }
    if (warnings.size() > warnings_quoted)
        quoted += fmt::format(" and {} others", warnings.size() - warnings_quoted);
    return fmt::format("OpenFOAM warned {} in {}: {}",
                       all == 1 ? "once" : fmt::format("{} times", all), log, quoted);
}

}  // namespace turbidite
