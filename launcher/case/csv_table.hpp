// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A table of a case as CSV: a line of column names, then one line per row; blank lines and lines
// that begin with # are passed over. Knows which columns there may be, not what they mean.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"

namespace turbidite {

struct CsvForm {
    std::vector<std::string> columns;   ///< all that are known
    std::vector<std::string> required;  ///< those that must be there
    std::string sentence;               ///< what the first line must read
    std::string rows;                   ///< what a row is, in the singular: "grain"
};

struct CsvTable {
    struct Row {
        int line = 0;  ///< 1-based
        std::vector<std::string> fields;
    };
    std::string name;  ///< of the file, in error texts
    std::vector<std::string> columns;
    std::vector<Row> rows;
    std::vector<CaseProblem> problems;

    /// Adds a problem that belongs to a line; 0: to none.
    void refuse(int line, const std::string& fault, const std::string& allowed,
                const std::string& remedy);
};

/// Rows are complete wherever there is no problem.
CsvTable read_csv(const std::filesystem::path& file, const CsvForm& form);

/// A finite number, or nothing and a problem.
std::optional<double> finite_number(CsvTable& table, int line, const std::string& column,
                                    const std::string& text, const std::string& remedy);

/// Zero or above, or nothing and a problem.
std::optional<std::int64_t> whole_number(CsvTable& table, int line, const std::string& column,
                                         const std::string& text);

}  // namespace turbidite
