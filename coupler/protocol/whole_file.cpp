// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/whole_file.hpp"

#include <fstream>
#include <system_error>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

bool write(const std::filesystem::path& file, const std::function<void(std::ostream&)>& content) {
    std::ofstream out(file);
    content(out);
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

}  // namespace

void write_whole(const std::filesystem::path& file,
                 const std::function<void(std::ostream&)>& content) {
    const Part part{file.string() + ".part"};
    if (!write(part.path, content))
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + file.string() + ": is the disk full?");
    std::error_code error;
    std::filesystem::rename(part.path, file, error);
    if (error)
        throw Failure(ExitCode::participant_failed,
                      "cannot write " + file.string() + ": " + error.message());
}

}  // namespace turbidite
