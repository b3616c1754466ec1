// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/stored_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <boost/crc.hpp>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

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

    bool write_all(const void* from, std::size_t bytes) const {
        std::size_t done = 0;
        while (done < bytes) {
            const ssize_t more =
                ::write(number_, static_cast<const char*>(from) + done, bytes - done);
            // A signal may interrupt a write, and a write may take only a part.
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
    if (missing) throw damaged(path, "is missing");
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) throw damaged(path, std::string("cannot be opened: ") + std::strerror(errno));
    // Cheaper than the checksum, and says more about a file that was cut off.
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

struct PieceWriter::Open {
    std::filesystem::path path;
    StoredFile file;  // so far, without its checksum
    std::optional<Descriptor> out{};
    boost::crc_32_type crc{};

    Descriptor& opened() {
        if (!out) out.emplace(path, O_WRONLY | O_CREAT | O_TRUNC);
        if (!out->open()) throw failure();
        return *out;
    }

    /// Bytes that were to be written, at the least.
    Failure failure(std::size_t more = 0) const {
        return cannot_store(path, " (" + std::to_string(file.bytes + more) + " bytes)");
    }
};

PieceWriter::PieceWriter(const std::filesystem::path& folder, const std::string& name)
    : open_(new Open{folder / name, {name}}) {}

PieceWriter::~PieceWriter() = default;

void PieceWriter::write(const void* from, std::size_t bytes) {
    if (!open_->opened().write_all(from, bytes)) throw open_->failure(bytes);
    open_->crc.process_bytes(from, bytes);
    open_->file.bytes += static_cast<std::int64_t>(bytes);
}

StoredFile PieceWriter::finish() {
    // An error of the disk may show only here, after all writes have succeeded.
    if (!open_->opened().sync()) throw open_->failure();
    open_->file.crc32 = static_cast<std::int64_t>(open_->crc.checksum());
    return open_->file;
}

StoredFile store(const std::filesystem::path& folder, const std::string& name, const Bytes& bytes) {
    PieceWriter file(folder, name);
    file.write(bytes.data(), bytes.size());
    return file.finish();
}

struct PieceReader::Open {
    std::filesystem::path path;
    std::size_t bytes;
    std::ifstream in;
};

// All of it is compared before the first piece is handed out: a reader would else act on a part of
// a damaged state.
PieceReader::PieceReader(const std::filesystem::path& folder, const StoredFile& file) {
    verify(folder, file);
    open_.reset(
        new Open{folder / file.name, static_cast<std::size_t>(file.bytes), opened(folder, file)});
}

PieceReader::~PieceReader() = default;
PieceReader::PieceReader(PieceReader&&) noexcept = default;

std::size_t PieceReader::size() const {
    return open_->bytes;
}

void PieceReader::read(std::size_t begin, void* to, std::size_t bytes) {
    // After a read that was refused the stream would refuse all others.
    open_->in.clear();
    open_->in.seekg(static_cast<std::streamoff>(begin));
    open_->in.read(static_cast<char*>(to), static_cast<std::streamsize>(bytes));
    if (!open_->in)
        throw damaged(open_->path, "has no bytes " + std::to_string(begin) + " to " +
                                       std::to_string(begin + bytes));
}

Bytes PieceReader::all() {
    Bytes bytes(open_->bytes);
    read(0, bytes.data(), bytes.size());
    return bytes;
}

Bytes load(const std::filesystem::path& folder, const StoredFile& file) {
    std::ifstream in = opened(folder, file);
    Bytes bytes(static_cast<std::size_t>(file.bytes));
    in.read(bytes.data(), static_cast<std::streamsize>(file.bytes));
    if (!in || crc32_of(bytes) != file.crc32) throw other_checksum(folder, file);
    return bytes;
}

void verify(const std::filesystem::path& folder, const StoredFile& file) {
    // 1 MB in memory, however large the state of a fluid rank is.
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
    // fsync of a folder puts the names in it on the disk: without it a renamed file may be lost.
    const Descriptor open_one(file_or_folder, O_RDONLY);
    if (!open_one.open() || !open_one.sync()) throw cannot_store(file_or_folder, "");
}

}  // namespace turbidite
