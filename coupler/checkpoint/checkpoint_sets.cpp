// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/checkpoint/checkpoint_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/run_files.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

constexpr auto sets_folder = "checkpoints";
const std::string unfinished = ".checkpoint-";  // begins the names of temporary folders

std::string name_of(std::int64_t windows) {
    return fmt::format("w{:08d}", windows);
}

bool is_set(const fs::path& folder) {
    // "w" and at least eight digits: other folders in there are not sets.
    const std::string name = folder.filename();
    return name.size() >= 9 && name[0] == 'w' &&
           name.find_first_not_of("0123456789", 1) == std::string::npos;
}

std::string temporary(const std::string& name) {
    return unfinished + name + ".tmp";
}

void rename_or_throw(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (error)
        throw Failure(
            ExitCode::participant_failed,
            fmt::format("cannot rename {} to {}: {}", from.string(), to.string(), error.message()));
}

/// Compares the parts of a set with its manifest. Whoever wrote one may have been wrong about its
/// name, its size, its content, and whether the disk has it.
class ReadBack {
 public:
    explicit ReadBack(fs::path folder) : folder_(std::move(folder)) {}

    void all(const Manifest& manifest) {
        one("coupler", manifest.coupler);
        for (const Role role : {Role::fluid, Role::grains}) {
            int rank = 0;
            for (const StoredFile& file : manifest.parts(role)) one(rank_name(role, rank++), file);
        }
    }

 private:
    void one(const std::string& who, const StoredFile& file) {
        try {
            verify(folder_, file);
        } catch (const Failure& failure) {
            throw Failure(failure.code(), who + ": " + failure.what());
        }
        // Two ranks that named the same file would each read the other's state, with the right
        // checksum.
        if (!names_.insert(file.name).second)
            throw Failure(ExitCode::bad_input,
                          fmt::format("{}: {} is the file of another rank, too", who,
                                      (folder_ / file.name).string()));
    }

    fs::path folder_;
    std::set<std::string> names_;
};

}  // namespace

std::string CheckpointSets::folder(const std::string& name) {
    return std::string(sets_folder) + "/" + name;
}

std::string CheckpointSets::begin(std::int64_t windows) const {
    const std::string name = temporary(name_of(windows));
    std::error_code error;
    // What an interrupted attempt at the same window has left.
    fs::remove_all(run_ / name, error);
    if (!error) fs::create_directory(run_ / name, error);
    if (error)
        throw Failure(ExitCode::participant_failed,
                      fmt::format("cannot make {}: {}", (run_ / name).string(), error.message()));
    return name;
}

void CheckpointSets::commit(const Manifest& manifest) const {
    const std::string name = name_of(manifest.windows), text = manifest_text(manifest);
    const fs::path from = run_ / temporary(name), sets = run_ / sets_folder, to = sets / name;
    // Everything below happens to the temporary folder. What `resume` looks at appears by one
    // rename, after the disk has all files, the names in the folder, and the manifest.
    store(from, manifest_name, Bytes(text.begin(), text.end()));
    ReadBack(from).all(manifest);
    for (const StoredFile& file : manifest.files()) put_on_disk(from / file.name);
    put_on_disk(from);
    std::error_code error;
    fs::create_directory(sets, error);
    if (fs::exists(to)) remove(name);  // a damaged one, since this run began before it
    rename_or_throw(from, to);
    // The rename itself: the names in `checkpoints`, and the name of that folder.
    put_on_disk(sets);
    put_on_disk(run_);
}

void CheckpointSets::remove(const std::string& name) const {
    const fs::path aside = run_ / temporary("old-" + name);
    // Out of `checkpoints` first: a set that is half removed would look like one.
    rename_or_throw(run_ / folder(name), aside);
    std::error_code ignored;  // what remains of it is removed at the next start
    fs::remove_all(aside, ignored);
}

void CheckpointSets::remove_unfinished() const {
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(run_, ignored))
        if (entry.path().filename().string().rfind(unfinished, 0) == 0)
            fs::remove_all(entry.path(), ignored);
}

std::vector<std::string> CheckpointSets::names() const {
    std::vector<std::string> names;
    std::error_code none;  // no checkpoint yet
    for (const auto& entry : fs::directory_iterator(run_ / sets_folder, none))
        if (is_set(entry.path())) names.push_back(entry.path().filename());
    const auto newer = [](const std::string& a, const std::string& b) {
        // More digits are a larger number; of equally many the order of the texts is that of the
        // numbers.
        return a.size() != b.size() ? a.size() > b.size() : a > b;
    };
    std::sort(names.begin(), names.end(), newer);
    return names;
}

std::int64_t CheckpointSets::newest_windows() const {
    const auto sets = names();
    return sets.empty() ? 0 : std::strtoll(sets.front().c_str() + 1, nullptr, 10);
}

void CheckpointSets::keep_newest(std::size_t count) const {
    const std::vector<std::string> all = names();
    for (std::size_t k = count; k < all.size(); ++k) remove(all[k]);
}

Manifest CheckpointSets::manifest(const std::string& name) const {
    const fs::path file = run_ / folder(name) / manifest_name;
    std::ifstream in(file);
    try {
        return parse_manifest({std::istreambuf_iterator<char>(in), {}});
    } catch (const std::runtime_error& error) {
        throw Failure(ExitCode::bad_input, fmt::format("{}: {}", file.string(), error.what()));
    }
}

Manifest CheckpointSets::verified(const std::string& name) const {
    const Manifest result = manifest(name);
    ReadBack(run_ / folder(name)).all(result);
    return result;
}

}  // namespace turbidite
