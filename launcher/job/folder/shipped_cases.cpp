// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/shipped_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "coupler/keys/nearest_name.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

/// "quickstart" for quickstart, quickstart.yaml and configs/quickstart.yaml, "validation/rebound"
/// for that one; empty for paths that lead elsewhere.
std::string shipped_name(const fs::path& word) {
    if (word.empty() || word.is_absolute() || word.lexically_normal() != word ||
        *word.begin() == "..")
        return "";
    const fs::path name = *word.begin() == "configs" ? word.lexically_relative("configs") : word;
    return name.extension() == ".yaml" ? (name.parent_path() / name.stem()).string()
                                       : name.string();
}

}  // namespace

std::vector<std::string> shipped_cases(const Programs& programs) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(programs.configs()))
        if (entry.path().extension() == ".yaml" && entry.path() != programs.expected())
            names.push_back(entry.path().stem());
    std::sort(names.begin(), names.end());
    return names;
}

fs::path case_named(const std::string& word, const Programs& programs) {
    const std::string name = shipped_name(word);
    const bool is_file = fs::exists(word) && !fs::is_directory(word);
    if (is_file || name.empty()) return word;
    const fs::path shipped = programs.configs() / (name + ".yaml");
    if (fs::exists(shipped)) return shipped;
    if (word != name || fs::path(word).has_parent_path() || fs::exists(word)) return word;
    const std::vector<std::string> names = shipped_cases(programs);
    const std::string all = fmt::format("The shipped ones are {}.", fmt::join(names, ", "));
    throw Failure(
        ExitCode::bad_input,
        fmt::format("turbidite: there is no file {}, and no shipped case of that name\n  {}", word,
                    did_you_mean(word, names, all)));
}

}  // namespace turbidite
