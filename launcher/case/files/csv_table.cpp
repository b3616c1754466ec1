// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/files/csv_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

#include "coupler/keys/key_value.hpp"

namespace turbidite {
namespace {

constexpr auto blanks = " \t\r";
constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // spreadsheets' "CSV UTF-8"

/// Without the blanks around it: one within a number is a fault.
std::string trimmed(const std::string& text) {
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string::npos) return "";
    return text.substr(first, text.find_last_not_of(blanks) + 1 - first);
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> fields;
    for (std::size_t begin = 0, end = 0; end != std::string::npos; begin = end + 1) {
        end = line.find(',', begin);
        fields.push_back(trimmed(line.substr(begin, end - begin)));
    }
    return fields;
}

bool is_blank(const std::string& text) {
    return text.find_first_not_of(blanks) == std::string::npos || text.front() == '#';
}

bool has(const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
}

/// What stands between the columns instead of commas: "semicolons", "tabs"; empty if nothing does.
std::string other_separator(const std::string& header) {
    if (header.find(',') != std::string::npos) return "";
    if (header.find(';') != std::string::npos) return "semicolons";
    const auto last = header.find_last_not_of(" \t\r");
    return header.find('\t', header.find_first_not_of(" \t")) < last ? "tabs" : "";
}

void read_header(CsvTable& table, int line, const std::string& text, const CsvForm& form) {
    table.columns = split(text);
    if (const std::string separator = other_separator(text); !separator.empty())
        return table.refuse(line, "has " + separator + " between its columns",
                            "Commas separate columns, and decimals have a point: 0,1.5,2.5.",
                            "Save it so, decimal commas included.");
    for (auto column_at = table.columns.begin(); column_at != table.columns.end(); ++column_at)
        if (const std::string& column = *column_at; !has(form.columns, column))
            table.refuse(line, fmt::format("column \"{}\" is unknown", column), form.sentence,
                         "Rename or remove it.");
        else if (std::count(table.columns.begin(), column_at, column) == 1)
            table.refuse(line, fmt::format("column \"{}\" occurs more than once", column),
                         form.sentence, "Keep one.");
    for (const std::string& required : form.required)
        if (!has(table.columns, required))
            table.refuse(line, fmt::format("column \"{}\" is missing", required), form.sentence,
                         "Add it.");
}

void read_row(CsvTable& table, int line, const std::string& text) {
    CsvTable::Row row{line, split(text)};
    if (row.fields.size() == table.columns.size())
        table.rows.push_back(std::move(row));
    else
        table.refuse(line, fmt::format("{} values in \"{}\"", row.fields.size(), text),
                     fmt::format("The header names {} columns.", table.columns.size()),
                     "Give one value per column.");
}

}  // namespace

std::string CsvTable::field(const Row& row, const std::string& column) const {
    const auto at = std::find(columns.begin(), columns.end(), column);
    return at == columns.end() ? "" : row.fields[static_cast<std::size_t>(at - columns.begin())];
}

void CsvTable::refuse(int line, const std::string& fault, const std::string& allowed,
                      const std::string& remedy) {
    problems.push_back({.source = name,
                        .line = line,
                        .key = {},
                        .value = {},
                        .fault = fault,
                        .allowed = allowed,
                        .remedy = remedy});
}

CsvTable read_csv(const std::filesystem::path& file, const CsvForm& form) {
    CsvTable table;
    table.name = file.filename().string();
    std::ifstream input(file);
    if (!input) {
        table.refuse(0, "cannot be read", fmt::format("A CSV file of {}s is needed.", form.rows),
                     "Check the path " + file.string() + ".");
        return table;
    }
    std::string text;
    for (int line = 1; std::getline(input, text); ++line) {
        if (line == 1 && text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
        if (is_blank(text)) continue;
        if (!table.columns.empty()) {
            read_row(table, line, text);
            continue;
        }
        read_header(table, line, text, form);
        if (!table.problems.empty()) return table;
    }
    if (table.rows.empty() && table.problems.empty())
        table.refuse(
            0, table.columns.empty() ? "is empty" : fmt::format("contains no {}", form.rows),
            table.columns.empty() ? form.sentence : "At least one line after the header is needed.",
            fmt::format("Add {}s.", form.rows));
    return table;
}

std::optional<double> finite_number(CsvTable& table, int line, const std::string& column,
                                    const std::string& text, const std::string& remedy) {
    const auto number = parse_real(text);
    if (number && std::isfinite(*number)) return number;
    table.refuse(line, fmt::format("{} = {}", column, text), "It must be a finite number.", remedy);
    return std::nullopt;
}

std::optional<std::int64_t> whole_number(CsvTable& table, int line, const std::string& column,
                                         const std::string& text) {
    const auto number = parse_integer(text);
    if (number && *number >= 0) return number;
    table.refuse(line, fmt::format("{} = {}", column, text),
                 fmt::format("An {} is a whole number, zero or above.", column),
                 "Number them 0, 1, 2, ...");
    return std::nullopt;
}

}  // namespace turbidite
