// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/temporary_folder.hpp"

#include <cstdlib>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

TemporaryFolder::TemporaryFolder(const std::string& purpose) {
    std::string pattern =
        std::filesystem::temp_directory_path() / ("turbidite-" + purpose + "-XXXXXX");
    if (mkdtemp(pattern.data()) == nullptr)
        throw Failure(ExitCode::participant_failed,
                      "cannot create a folder like " + pattern +
                          "\n  Set TMPDIR to a folder you may write to.");
    path_ = pattern;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace turbidite
