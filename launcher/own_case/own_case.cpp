// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/own_case/own_case.hpp"

#include <fmt/format.h>

#include <fstream>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "launcher/case/files/case_entries.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& file, const std::string& text) {
    std::error_code ignored;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out)
        throw Failure(ExitCode::bad_input,
                      fmt::format("turbidite: {} cannot be written", file.string()));
}

/// Values of the case that are files beside it, such as grains.file.
std::vector<fs::path> files_named_by(const fs::path& shipped) {
    std::vector<fs::path> names;
    for (const CaseEntry& entry : read_case_entries(shipped, {}).entries) {
        const fs::path name = entry.value;
        std::error_code ignored;
        if (name.is_relative() && fs::is_regular_file(shipped.parent_path() / name, ignored))
            names.push_back(name);
    }
    return names;
}

void require_free(const fs::path& file) {
    if (!fs::exists(file)) return;
    throw Failure(ExitCode::bad_input,
                  fmt::format("turbidite: {} exists already\n  Choose another name, or remove it.",
                              file.string()));
}

}  // namespace

OwnCase write_own_case(const fs::path& shipped, const fs::path& file) {
    OwnCase own{file, {}};
    const std::vector<fs::path> names = files_named_by(shipped);
    require_free(file);
    for (const fs::path& name : names) require_free(file.parent_path() / name);
    const std::string head = fmt::format(
        "# Begun as a copy of {}. Every key, with unit, default and range: `turbidite keys`.\n#\n",
        shipped.stem().string());
    write(file, head + read_whole(shipped));
    for (const fs::path& name : names) {
        own.beside.push_back(file.parent_path() / name);
        write(own.beside.back(), read_whole(shipped.parent_path() / name));
    }
    return own;
}

}  // namespace turbidite
