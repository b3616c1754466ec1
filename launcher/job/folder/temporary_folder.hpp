// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A folder for runs that nobody keeps, removed with the object.
#pragma once

#include <filesystem>
#include <string>

namespace turbidite {

class TemporaryFolder {
 public:
    /// TMPDIR/turbidite-<purpose>-XXXXXX. Throws Failure (exit code 4) if it cannot be created.
    explicit TemporaryFolder(const std::string& purpose);
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

 private:
    std::filesystem::path path_;
};

}  // namespace turbidite
