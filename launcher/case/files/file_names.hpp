// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether there is a file or folder of a name that a user has given. A name that no file system
// takes, such as one that is too long, is that of none.
#pragma once

#include <filesystem>
#include <system_error>

namespace turbidite {

inline bool is_file(const std::filesystem::path& name) {
    std::error_code fault;
    return std::filesystem::is_regular_file(name, fault);
}

inline bool is_folder(const std::filesystem::path& name) {
    std::error_code fault;
    return std::filesystem::is_directory(name, fault);
}

inline bool is_there(const std::filesystem::path& name) {
    std::error_code fault;
    return std::filesystem::exists(name, fault);
}

}  // namespace turbidite
