// SPDX-License-Identifier: LGPL-2.1-or-later
#include "tests/mutation/mutate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

#include "launcher/case/keys/keys.hpp"

namespace turbidite::mutation {
namespace {

const std::vector<std::string> odd_values = {"0",           "-1",
                                             "1",           "2",
                                             "0.5",         "-0.0",
                                             "1e-300",      "1e300",
                                             "1e9",         "1e19",
                                             "nan",         ".nan",
                                             "inf",         "-.inf",
                                             "true",        "no",
                                             "~",           "null",
                                             "''",          "\"\"",
                                             "[]",          "{}",
                                             "[1]",         "[1, 2]",
                                             "[-1, 5]",     "[nan, 1]",
                                             "[1, 2, 3]",   "[[1], {a: [2]}]",
                                             "{a: 3}",      "{case: case.yaml}",
                                             "&a [*a, *a]", "&b {c: 1}",
                                             "*b",          "[*b, *b, *b]",
                                             "0x10",        "1_000",
                                             "1,5",         "grains.csv",
                                             "walls.csv",   "m",
                                             "../..",       "/",
                                             "2147483648",  "9223372036854775808",
                                             "0.9069",      "3 4"};

/// The terminating zero is one of them.
constexpr char odd_letters[] = "{}[],:#&*!|>'\"%@`-?. \t\n\r\x7f\xc3\xa9\xff";

std::size_t below(std::size_t count, Random& random) {
    return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

template <class List>
auto pick(const List& list, Random& random) {
    return list[below(std::size(list), random)];
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    if (lines.empty()) lines.emplace_back();
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    return fmt::format("{}\n", fmt::join(lines, "\n"));
}

void change_letter(std::string& text, Random& random) {
    if (text.empty()) return;
    const std::size_t at = below(text.size(), random);
    const char letter = pick(odd_letters, random);
    switch (below(3, random)) {
        case 0:
            text[at] = letter;
            break;
        case 1:
            text.insert(at, 1, letter);
            break;
        default:
            text.erase(at, 1 + below(4, random));
    }
}

/// A number or word becomes another value, or a neighbouring number.
void change_value(std::string& text, Random& random) {
    std::vector<std::pair<std::size_t, std::size_t>> words;
    const auto in_word = [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '_' || c == '-';
    };
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i;
        while (end < text.size() && in_word(text[end])) ++end;
        if (end > i) words.emplace_back(i, end - i);
        i = std::max(end, i + 1);
    }
    if (words.empty()) return;
    const auto [at, length] = pick(words, random);
    text.replace(at, length, pick(odd_values, random));
}

void change_lines(std::string& text, Random& random) {
    std::vector<std::string> lines = lines_of(text);
    const std::size_t at = below(lines.size(), random);
    switch (below(5, random)) {
        case 0:
            lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(at));
            break;
        case 1:
            lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(at), lines[at]);
            break;
        case 2:
            std::swap(lines[at], lines[below(lines.size(), random)]);
            break;
        case 3:
            lines[at].insert(0, 1 + below(4, random), ' ');
            break;
        default:
            lines.resize(at + 1), lines[at].resize(lines[at].size() / 2);
    }
    text = joined(lines);
}

std::string with_names(std::string key, Random& random) {
    for (const char* name : {"NAME", "FIRST", "SECOND"})
        if (const auto at = key.find(name); at != std::string::npos)
            key.replace(at, std::string(name).size(),
                        pick(std::vector<std::string>{"m", "steel", "default", "", "m.n"}, random));
    return key;
}

std::string value_of(const KeySpec& key, Random& random) {
    if (!key.choices.empty() && below(3, random) > 0) return pick(key.choices, random).name;
    if (!key.fallback.empty() && below(3, random) == 0) return key.fallback;
    if (key.range.contains(key.range.lower) && below(4, random) == 0)
        return fmt::format("{}", key.range.lower);
    if (key.range.contains(key.range.upper) && below(4, random) == 0)
        return fmt::format("{}", key.range.upper);
    return pick(odd_values, random);
}

void set_key(CaseText& text, Random& random) {
    const KeySpec key = pick(key_table(), random);
    text.set.push_back(with_names(key.name, random) + "=" + value_of(key, random));
}

void change_text(CaseText& text, Random& random) {
    std::string* const parts[] = {&text.yaml, &text.yaml, &text.yaml, &text.grains, &text.walls};
    const bool of_study = !text.study.empty() && below(4, random) > 0;
    std::string& part = of_study ? text.study : *pick(parts, random);
    switch (below(3, random)) {
        case 0:
            return change_letter(part, random);
        case 1:
            return change_value(part, random);
        default:
            return change_lines(part, random);
    }
}

}  // namespace

std::string CaseText::all() const {
    return fmt::format(
        "--set {}\n--- case.yaml\n{}\n--- grains.csv\n{}\n--- walls.csv\n{}\n--- study.yaml\n{}\n",
        fmt::join(set, " --set "), yaml, grains, walls, study);
}

CaseText mutated(CaseText text, Random& random) {
    const std::size_t changes = 1 + below(4, random);
    for (std::size_t n = 0; n < changes; ++n)
        if (below(2, random) == 0)
            set_key(text, random);
        else
            change_text(text, random);
    return text;
}

}  // namespace turbidite::mutation
