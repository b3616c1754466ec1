// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the dynamic linker finds for a program or module, as `ldd` prints it.
#pragma once

#include <filesystem>
#include <string>

namespace turbidite {

struct LoadedLibraries {
    std::string absent;  ///< the first library that is not found; empty: all are
    std::string mpi;     ///< libmpi, with links resolved; empty: it loads none
};

/// Both empty for a file that is no binary.
LoadedLibraries loaded_libraries(const std::filesystem::path& file);

/// The same from the text that ldd printed.
LoadedLibraries read_ldd(const std::string& text);

}  // namespace turbidite
