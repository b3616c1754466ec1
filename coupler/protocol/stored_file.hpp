// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The files of a checkpoint: written whole, with a checksum, and on the disk before anybody relies
// on them. Valid C++17.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "coupler/protocol/wire.hpp"

namespace turbidite {

/// A file as it was written.
struct StoredFile {
    std::string name;  ///< in its folder
    std::int64_t bytes = 0;
    std::int64_t crc32 = 0;  ///< as of zlib, gzip, PNG
};

std::int64_t crc32_of(const Bytes& bytes);

/// Whether a file of this name lies in its folder, whoever has chosen it: no path, no control
/// characters.
bool is_file_name(const std::string& name);

/// Writes FOLDER/name and waits until the disk has it. Throws Failure (participant failed) naming
/// the file, the bytes and the system's reason.
StoredFile store(const std::filesystem::path& folder, const std::string& name, const Bytes& bytes);

/// Reads it again. Throws Failure (bad input) naming the file if it is missing or differs from what
/// was written, or if its name is none (is_file_name).
Bytes load(const std::filesystem::path& folder, const StoredFile& file);

/// The same in pieces, for a file whose content is not needed.
void verify(const std::filesystem::path& folder, const StoredFile& file);

/// Waits until the disk has a file, or the names in a folder. Throws like `store`.
void put_on_disk(const std::filesystem::path& file_or_folder);

}  // namespace turbidite
