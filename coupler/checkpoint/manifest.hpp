// SPDX-License-Identifier: LGPL-2.1-or-later
//
// manifest.json: what a checkpoint consists of, and the settings of its run. (Random numbers are
// drawn for the population only, from random.seed, so there is no state of a generator.) It is
// written last, so a set that has one is complete as far as its writers knew; the checksums tell
// whether it still is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/protocol/files/stored_file.hpp"
#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct Manifest {
    std::string case_hash;     ///< of the resolved case it was written with
    std::int64_t windows = 0;  ///< done
    double time = 0.0;         ///< [t_c]
    Settings settings;         ///< of that case
    StoredFile coupler;
    std::vector<StoredFile> fluid, grains;  ///< by rank

    const std::vector<StoredFile>& parts(Role role) const {
        return role == Role::fluid ? fluid : grains;
    }
    /// All of them.
    std::vector<StoredFile> files() const;
};

inline constexpr const char* manifest_name = "manifest.json";

/// The text of manifest.json, and back. `parse_manifest` throws std::runtime_error saying what is
/// wrong, another version of the format included.
std::string manifest_text(const Manifest& manifest);
Manifest parse_manifest(const std::string& text);

}  // namespace turbidite
