// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/whole_file.hpp"

#include <fstream>
#include <iterator>
#include <system_error>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/stored_file.hpp"

namespace turbidite {
namespace {

bool write(const std::filesystem::path& file, const std::function<void(std::ostream&)>& content) {
    std::ofstream out(file);
    content(out);
    // Before the state of the stream is asked for: the last bytes are written here.
    out.close();
    return out.good();
}

/// Removed at the end of its scope unless it has been renamed.
struct Part {
    std::filesystem::path path;

    ~Part() {
        std::error_code ignored;  // the original failure is already being thrown
        std::filesystem::remove(path, ignored);
    }
};

Part part_of(const std::filesystem::path& file) {
    return {file.string() + ".part"};
}

void fill(const Part& part, const std::filesystem::path& file,
          const std::function<void(std::ostream&)>& content) {
    if (!write(part.path, content))
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + file.string() + ": is the disk full?");
}

void rename(const Part& part, const std::filesystem::path& file) {
    std::error_code error;
    std::filesystem::rename(part.path, file, error);
    if (error)
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + file.string() + ": " + error.message());
}

}  // namespace

std::string read_whole(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void write_whole(const std::filesystem::path& file,
                 const std::function<void(std::ostream&)>& content) {
    // A rename replaces the old file at once: readers see the old one or the new one, never a part.
    const Part part = part_of(file);
    fill(part, file, content);
    rename(part, file);
}

void write_whole_on_disk(const std::filesystem::path& file,
                         const std::function<void(std::ostream&)>& content) {
    const Part part = part_of(file);
    fill(part, file, content);
    // The content before its name, the name before the caller goes on.
    put_on_disk(part.path);
    rename(part, file);
    put_on_disk(std::filesystem::absolute(file).parent_path());
}

}  // namespace turbidite
