// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of faults.txt, which says what its columns mean.
#pragma once

#include <filesystem>
#include <fstream>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace turbidite {

struct FaultLine {
    std::string name, message, change;
    int code = 0;
    std::vector<std::string> says;
};

/// What a failed test of this line is called.
inline void PrintTo(const FaultLine& fault, std::ostream* out) {
    *out << fault.name << ": " << fault.message << " " << fault.change;
}

inline std::vector<FaultLine> fault_table() {
    const std::filesystem::path file = std::filesystem::path(FAULTS_FOLDER) / "faults.txt";
    std::ifstream in(file);
    const auto trimmed = [](const std::string& text) {
        const auto first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
        return first == std::string::npos ? "" : text.substr(first, last - first + 1);
    };
    std::vector<FaultLine> table;
    for (std::string line; std::getline(in, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::vector<std::string> cells;
        std::istringstream row(line);
        for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
        if (cells.size() < 5) throw std::runtime_error(file.string() + ": " + line);
        table.push_back(
            {cells[0], cells[1], cells[2], std::stoi(cells[3]), {cells.begin() + 4, cells.end()}});
    }
    if (table.empty()) throw std::runtime_error("no faults in " + file.string());
    return table;
}

/// For names of tests, which have no hyphens.
inline std::string test_name(const FaultLine& fault) {
    std::string name;
    for (const char c : fault.name) name += c == '-' ? '_' : c;
    return name;
}

}  // namespace turbidite
