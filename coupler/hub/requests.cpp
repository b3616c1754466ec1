// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/requests.hpp"

#include <fstream>

#include "coupler/protocol/files/run_files.hpp"

namespace turbidite {

/// Whether the file was there; it is not any more.
bool RequestFiles::taken(const char* name) const {
    std::error_code none;
    return std::filesystem::remove(folder_ / name, none) && !none;
}

std::optional<ExitCode> RequestFiles::stop() const {
    int code = static_cast<int>(ExitCode::interrupted);
    {
        // A text that is no number gives 0, and an empty file leaves the default: neither is
        // `terminated`.
        std::ifstream file(folder_ / stop_file);
        if (file) file >> code;
    }
    if (taken(stop_file))
        return code == static_cast<int>(ExitCode::terminated) ? ExitCode::terminated
                                                              : ExitCode::interrupted;
    if (signal_ && *signal_ != 0) return ExitCode::terminated;
    return std::nullopt;
}

Requests RequestFiles::take() const {
    // A file that appears after this look is taken before the next window.
    return {stop(), taken(write_file), taken(checkpoint_file)};
}

}  // namespace turbidite
