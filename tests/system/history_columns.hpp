// SPDX-License-Identifier: LGPL-2.1-or-later
//
// history.csv by column name, for tests of whole runs.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace turbidite {

using Columns = std::map<std::string, std::vector<double>>;

/// Empty cells become NaN.
inline Columns columns_of(const std::string& history) {
    std::istringstream lines(history);
    std::string line, cell;
    std::getline(lines, line);
    std::vector<std::string> names;
    for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
    Columns columns;
    while (std::getline(lines, line)) {
        std::istringstream row(line + ",");
        for (std::size_t i = 0; i < names.size() && std::getline(row, cell, ','); ++i)
            columns[names[i]].push_back(cell.empty() ? NAN : std::stod(cell));
    }
    return columns;
}

inline double largest(const std::vector<double>& values) {
    double result = 0.0;
    for (const double value : values) result = std::max(result, std::abs(value));
    return result;
}

inline double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
    EXPECT_EQ(a.size(), b.size());
    double result = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        result = std::max(result, std::abs(a[i] - b[i]));
    return result;
}

}  // namespace turbidite
