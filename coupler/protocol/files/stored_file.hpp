// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The files of a checkpoint: written whole, with a checksum, and on the disk before anybody relies
/// on them. Valid C++17.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <memory>

#include "coupler/protocol/wire.hpp"

namespace turbidite {

/// A file as it was written.
struct StoredFile {
    std::string name;  ///< in its folder
    std::int64_t bytes = 0;
    std::int64_t crc32 = 0;  ///< as of zlib, gzip, PNG
};

/// As of StoredFile.
std::int64_t crc32_of(const Bytes& bytes);

/// Whether a file of this name lies in its folder, whoever has chosen it: no path, no control
/// characters.
bool is_file_name(const std::string& name);

/// Writes FOLDER/name and waits until the disk has it. Throws Failure (participant failed) naming
/// the file, the bytes and the system's reason.
StoredFile store(const std::filesystem::path& folder, const std::string& name, const Bytes& bytes);

/// A file that is written in pieces, for content that is not to be in memory a second time.
class PieceWriter {
 public:
    /// FOLDER/name, made by the first call below: whatever all ranks do together before they write
    /// is done by all, also where one of them cannot open its file.
    PieceWriter(const std::filesystem::path& folder, const std::string& name);
    ~PieceWriter();

    /// Appends bytes. Throws as `store`.
    void write(const void* from, std::size_t bytes);

    /// Waits until the disk has it; nothing is written afterwards. Throws as `store`.
    StoredFile finish();

 private:
    struct Open;
    std::unique_ptr<Open> open_;
};

/// Reads such a file in pieces, in any order, after all of it has been compared with its checksum.
class PieceReader {
 public:
    /// Throws as `load`.
    PieceReader(const std::filesystem::path& folder, const StoredFile& file);
    ~PieceReader();
    PieceReader(PieceReader&&) noexcept;

    std::size_t size() const;  ///< [bytes]

    /// Bytes from `begin` on. Throws Failure (bad input) naming the file if it does not have them.
    void read(std::size_t begin, void* to, std::size_t bytes);

    Bytes all();  ///< the whole content

 private:
    struct Open;
    std::unique_ptr<Open> open_;
};

/// Reads it again. Throws Failure (bad input) naming the file if it is missing or differs from what
/// was written, or if its name is none (is_file_name).
Bytes load(const std::filesystem::path& folder, const StoredFile& file);

/// The same in pieces, for a file whose content is not needed.
void verify(const std::filesystem::path& folder, const StoredFile& file);

/// Waits until the disk has a file, or the names in a folder. Throws like `store`.
void put_on_disk(const std::filesystem::path& file_or_folder);

}  // namespace turbidite
