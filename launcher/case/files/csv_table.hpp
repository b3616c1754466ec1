// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A table of a case as CSV: a line of column names, then one line per row; blank lines and lines
// that begin with # are skipped. Knows which columns are allowed, not what they mean.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"

namespace turbidite {

struct CsvForm {
    std::vector<std::string> columns;   ///< all known columns
    std::vector<std::string> required;  ///< the mandatory ones
    std::string sentence;               ///< the required form of the first line, in words
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

    /// What a row has in a column; empty without such a column.
    std::string field(const Row& row, const std::string& column) const;

    /// Adds a problem in a line; 0: in no particular line.
    void refuse(int line, const std::string& fault, const std::string& allowed,
                const std::string& remedy);
};

/// Rows are complete if there is no problem.
CsvTable read_csv(const std::filesystem::path& file, const CsvForm& form);

/// A finite number, or nothing and a problem.
std::optional<double> finite_number(CsvTable& table, int line, const std::string& column,
                                    const std::string& text, const std::string& remedy);

/// Zero or above, or nothing and a problem.
std::optional<std::int64_t> whole_number(CsvTable& table, int line, const std::string& column,
                                         const std::string& text);

}  // namespace turbidite
