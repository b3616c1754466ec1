// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The checkpoints of a run folder: checkpoints/w<windows done>, each with a manifest.
//
// A set is written in a temporary folder beside `checkpoints`, read back, every file and every
// folder put on the disk, and then renamed into it; an old one is renamed out of it before its
// files are removed. So whatever is in `checkpoints` is whole, at any moment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/checkpoint/manifest.hpp"

namespace turbidite {

class CheckpointSets {
 public:
    explicit CheckpointSets(std::filesystem::path run_folder) : run_(std::move(run_folder)) {}

    /// Makes the temporary folder of a set and returns its name in the run folder.
    std::string begin(std::int64_t windows) const;

    /// Writes the manifest, reads all files back, and puts the set in its place. Throws Failure
    /// that says what could not be done, or names the rank whose file is not what the manifest
    /// says.
    void commit(const Manifest& manifest) const;

    /// Removes temporary folders, of this process or an earlier one.
    void remove_unfinished() const;

    /// Removes all but the newest ones.
    void keep_newest(std::size_t count) const;
    void remove(const std::string& name) const;

    /// Names ("w00000480"), newest first.
    std::vector<std::string> names() const;

    /// Windows done in the newest one; 0 if there is none.
    std::int64_t newest_windows() const;

    /// The manifest of a set, all of whose files were compared with it. Throws Failure (bad input)
    /// naming what is missing or damaged, and whose it is.
    Manifest verified(const std::string& name) const;
    Manifest manifest(const std::string& name) const;  ///< the same without reading the files

    /// Relative to the run folder: "checkpoints/w00000480".
    static std::string folder(const std::string& name);

 private:
    std::filesystem::path run_;
};

}  // namespace turbidite
