// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/own_case/own_case.hpp"

#include <fmt/format.h>

#include <fstream>
#include <set>

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

/// Values that are files in one of the folders, such as grains.file.
std::set<fs::path> files_named_by(const fs::path& file, const std::set<fs::path>& folders) {
    std::set<fs::path> found;
    for (const CaseEntry& entry : read_case_entries(file, {}).entries)
        for (const fs::path& folder : folders) {
            const fs::path name = entry.value;
            std::error_code ignored;
            if (name.is_relative() && fs::is_regular_file(folder / name, ignored))
                found.insert((folder / name).lexically_normal());
        }
    return found;
}

/// The files of a case; of a study its cases, and theirs. Relative to the folder of the file.
std::vector<fs::path> files_beside(const fs::path& shipped) {
    const fs::path home = shipped.parent_path();
    std::set<fs::path> files = files_named_by(shipped, {home}), folders{home};
    for (const fs::path& file : std::set<fs::path>(files))
        if (file.extension() == ".yaml") {
            folders.insert(file.parent_path());
            files.merge(files_named_by(file, {file.parent_path()}));
        }
    // A study may give its cases other files, which are in their folders.
    files.merge(files_named_by(shipped, folders));
    std::vector<fs::path> names;
    for (const fs::path& file : files) names.push_back(file.lexically_relative(home));
    return names;
}

void require_free(const fs::path& file, const std::string& remedy) {
    if (fs::exists(file))
        throw Failure(ExitCode::bad_input,
                      fmt::format("turbidite: {} exists already\n  {}", file.string(), remedy));
}

/// Or one of the two would be lost.
void require_other_names(const fs::path& file, const std::vector<fs::path>& names,
                         const std::string& shipped) {
    for (const fs::path& name : names)
        if (fs::absolute(file.parent_path() / name).lexically_normal() ==
            fs::absolute(file).lexically_normal())
            throw Failure(ExitCode::bad_input,
                          fmt::format("turbidite: {} is the name of a file that {} needs beside "
                                      "it\n  Choose another name. Nothing was written.",
                                      name.string(), shipped));
}

/// Nothing to copy: the same file, as another case has brought it along.
bool is_copied(const fs::path& shipped, const fs::path& file) {
    return fs::exists(file) && read_whole(file) == read_whole(shipped);
}

}  // namespace

OwnCase write_own_case(const fs::path& shipped, const fs::path& file) {
    OwnCase own{file, {}};
    std::vector<fs::path> names = files_beside(shipped);
    require_other_names(file, names, shipped.stem().string());
    std::erase_if(names, [&](const fs::path& name) {
        return is_copied(shipped.parent_path() / name, file.parent_path() / name);
    });
    require_free(file, "Choose another name, or remove it.");
    for (const fs::path& name : names)
        require_free(file.parent_path() / name,
                     fmt::format("{} names another file of this name. Write it to another folder.",
                                 shipped.stem().string()));
    const std::string head = fmt::format(
        "# Begun as a copy of {}. Every key, with unit, default and range: `turbidite keys`.\n#\n",
        shipped.stem().string());
    // The case last: with a full disk there is none, and the same command works later.
    for (const fs::path& name : names) {
        own.beside.push_back(file.parent_path() / name);
        write(own.beside.back(), read_whole(shipped.parent_path() / name));
    }
    write(file, head + read_whole(shipped));
    return own;
}

}  // namespace turbidite
