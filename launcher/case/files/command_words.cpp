// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/files/command_words.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <sstream>

#include "launcher/case/files/file_names.hpp"

namespace turbidite {
namespace {

bool is_executable(const std::filesystem::path& file) {
    return is_file(file) && access(file.c_str(), X_OK) == 0;
}

}  // namespace

std::optional<std::vector<std::string>> command_words(const std::string& text) {
    std::vector<std::string> words;
    bool inside = false;  // a word; it may be empty if it is quoted
    char quote = '\0';
    for (const char c : text) {
        if (quote != '\0' && c != quote) {
            words.back() += c;
        } else if (c == quote) {
            quote = '\0';
        } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
            inside = false;
        } else {
            if (!inside) words.emplace_back();
            inside = true;
            if (c == '\'' || c == '"')
                quote = c;
            else
                words.back() += c;
        }
    }
    if (quote != '\0' || words.empty()) return std::nullopt;
    return words;
}

std::string command_text(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) {
        const bool plain = !word.empty() && word.find_first_of(" \t\r\n'\"") == std::string::npos;
        const char quote = word.find('\'') == std::string::npos ? '\'' : '"';
        text += text.empty() ? "" : " ";
        text += plain ? word : quote + word + quote;
    }
    return text;
}

std::vector<std::string> with_absolute_files(std::vector<std::string> words,
                                             const std::filesystem::path& folder) {
    for (std::string& word : words) {
        if (word.empty()) continue;
        const auto file = std::filesystem::absolute(folder / word);
        if (is_file(file)) word = file.lexically_normal().string();
    }
    return words;
}

std::filesystem::path find_program_file(const std::string& name) {
    if (name.find('/') != std::string::npos) return is_executable(name) ? name : "";
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (is_executable(std::filesystem::path(folder) / name))
            return std::filesystem::path(folder) / name;
    return {};
}

}  // namespace turbidite
