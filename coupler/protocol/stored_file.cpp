// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/stored_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/received.hpp"

namespace turbidite {
namespace {

/// An open file, closed at the end of its scope.
class Descriptor {
 public:
    Descriptor(const std::filesystem::path& path, int flags)
        : number_(::open(path.c_str(), flags | O_CLOEXEC, 0644)) {}
    ~Descriptor() {
        if (number_ >= 0) ::close(number_);
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    bool open() const { return number_ >= 0; }

    bool write_all(const Bytes& bytes) const {
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t more = ::write(number_, bytes.data() + done, bytes.size() - done);
            if (more < 0 && errno == EINTR) continue;
            if (more <= 0) return false;
            done += static_cast<std::size_t>(more);
        }
        return true;
    }

    bool sync() const { return ::fsync(number_) == 0; }

 private:
    int number_;
};

Failure cannot_store(const std::filesystem::path& file, const std::string& what) {
    return Failure(ExitCode::participant_failed,
                   "cannot write " + file.string() + what + ": " + std::strerror(errno));
}

Failure damaged(const std::filesystem::path& file, const std::string& fault) {
    return Failure(ExitCode::bad_input, file.string() + " " + fault);
}

/// Of the size that it is to have.
std::ifstream opened(const std::filesystem::path& folder, const StoredFile& file) {
    if (!is_file_name(file.name))
        throw damaged(folder, "is said to have the file \"" + received_line(file.name) +
                                  "\", which is no name of a file in its folder");
    const std::filesystem::path path = folder / file.name;
    std::error_code missing;
    const std::uintmax_t bytes = std::filesystem::file_size(path, missing);
    std::ifstream in(path, std::ios::binary);
    if (missing || !in) throw damaged(path, "is missing");
    if (static_cast<std::int64_t>(bytes) != file.bytes)
        throw damaged(path, "has " + std::to_string(bytes) + " bytes instead of " +
                                std::to_string(file.bytes));
    return in;
}

Failure other_checksum(const std::filesystem::path& folder, const StoredFile& file) {
    return damaged(folder / file.name, "is damaged: its checksum differs");
}

}  // namespace

bool is_file_name(const std::string& name) {
    return !name.empty() && name != "." && name != ".." && name.find('/') == std::string::npos &&
           name == received_line(name);
}

std::int64_t crc32_of(const Bytes& bytes) {
    boost::crc_32_type crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return static_cast<std::int64_t>(crc.checksum());
}

StoredFile store(const std::filesystem::path& folder, const std::string& name, const Bytes& bytes) {
    const std::filesystem::path file = folder / name;
    const Descriptor out(file, O_WRONLY | O_CREAT | O_TRUNC);
    const std::string size = " (" + std::to_string(bytes.size()) + " bytes)";
    if (!out.open() || !out.write_all(bytes) || !out.sync()) throw cannot_store(file, size);
    return {name, static_cast<std::int64_t>(bytes.size()), crc32_of(bytes)};
}

Bytes load(const std::filesystem::path& folder, const StoredFile& file) {
    std::ifstream in = opened(folder, file);
    Bytes bytes(static_cast<std::size_t>(file.bytes));
    in.read(bytes.data(), static_cast<std::streamsize>(file.bytes));
    if (!in || crc32_of(bytes) != file.crc32) throw other_checksum(folder, file);
    return bytes;
}

void verify(const std::filesystem::path& folder, const StoredFile& file) {
    constexpr std::int64_t at_once = 1 << 20;
    std::ifstream in = opened(folder, file);
    boost::crc_32_type crc;
    Bytes piece(static_cast<std::size_t>(std::min(at_once, file.bytes)));
    for (std::int64_t left = file.bytes; left > 0;) {
        const std::int64_t now = std::min(at_once, left);
        if (!in.read(piece.data(), now)) throw other_checksum(folder, file);
        crc.process_bytes(piece.data(), static_cast<std::size_t>(now));
        left -= now;
    }
    if (static_cast<std::int64_t>(crc.checksum()) != file.crc32) throw other_checksum(folder, file);
}

void put_on_disk(const std::filesystem::path& file_or_folder) {
    const Descriptor open_one(file_or_folder, O_RDONLY);
    if (!open_one.open() || !open_one.sync()) throw cannot_store(file_or_folder, "");
}

}  // namespace turbidite
