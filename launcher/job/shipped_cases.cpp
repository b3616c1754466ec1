// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/shipped_cases.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "coupler/keys/nearest_name.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

/// "quickstart" for quickstart, quickstart.yaml and configs/quickstart.yaml; empty for other paths.
std::string plain_name(fs::path word) {
    if (word.parent_path() == "configs") word = word.filename();
    if (word.has_parent_path()) return "";
    return word.extension() == ".yaml" ? word.stem() : word;
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
    const std::string name = plain_name(word);
    if (fs::exists(word) || name.empty()) return word;
    const fs::path shipped = programs.configs() / (name + ".yaml");
    if (fs::exists(shipped)) return shipped;
    if (word != name) return word;
    const std::vector<std::string> names = shipped_cases(programs);
    throw Failure(ExitCode::bad_input,
                  fmt::format("turbidite: there is no file {0}, and no shipped case of that name\n"
                              "  Did you mean {1}? The shipped ones are {2}.",
                              word, nearest_name(word, names), fmt::join(names, ", ")));
}

}  // namespace turbidite
