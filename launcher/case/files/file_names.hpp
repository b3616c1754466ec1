// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Whether there is a file or folder of a name that a user has given. A name that no file system
// takes, such as one that is too long, is that of none.
#pragma once

#include <filesystem>
#include <fstream>
#include <system_error>

namespace turbidite {

inline bool is_file(const std::filesystem::path& name) {
    std::error_code fault;
    return std::filesystem::is_regular_file(name, fault);
}

/// Also by this user.
inline bool can_be_read(const std::filesystem::path& name) {
    return is_file(name) && std::ifstream(name).good();
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
