// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/requests.hpp"

#include <fstream>

#include "coupler/protocol/files/run_files.hpp"

namespace turbidite {
namespace {

/// Of the text of a STOP file, which is removed.
ExitCode stop_code(const std::filesystem::path& file) {
    // A text that is no number gives 0, and an empty file leaves the default: neither is
    // `terminated`.
    int code = static_cast<int>(ExitCode::interrupted);
    std::ifstream(file) >> code;
    std::error_code ignored;  // it is taken: under this name nobody looks for it
    std::filesystem::remove(file, ignored);
    return code == static_cast<int>(ExitCode::terminated) ? ExitCode::terminated
                                                          : ExitCode::interrupted;
}

}  // namespace

/// Whether the file was there; it is not any more.
bool RequestFiles::taken(const char* name) const {
    std::error_code none;
    return std::filesystem::remove(folder_ / name, none) && !none;
}

std::optional<ExitCode> RequestFiles::stop() const {
    // Renamed before it is read: one that appears between two looks at its name would be obeyed
    // with the default instead of its code.
    const auto own = folder_ / (std::string(stop_file) + ".taken");
    std::error_code none;
    std::filesystem::rename(folder_ / stop_file, own, none);
    if (!none) return stop_code(own);
    if (signal_ && *signal_ != 0) return ExitCode::terminated;
    return std::nullopt;
}

Requests RequestFiles::take() const {
    // A file that appears after this look is taken before the next window.
    return {stop(), taken(write_file), taken(checkpoint_file)};
}

}  // namespace turbidite
