// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/doctor/loaded_libraries.hpp"

#include <sstream>

#include "launcher/doctor/command_output.hpp"

namespace turbidite {

// A line is "libmpi.so.40 => /lib/x86_64-linux-gnu/libmpi.so.40 (0x…)" or "libx.so => not found".
LoadedLibraries read_ldd(const std::string& text) {
    LoadedLibraries libraries;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        std::string name, arrow, place;
        std::istringstream(line) >> name >> arrow >> place;
        if (arrow != "=>") continue;
        if (place == "not" && libraries.absent.empty()) libraries.absent = name;
        if (place[0] == '/' && name.rfind("libmpi.so", 0) == 0)
            libraries.mpi = std::filesystem::weakly_canonical(place);
    }
    return libraries;
}

LoadedLibraries loaded_libraries(const std::filesystem::path& file) {
    return read_ldd(output_of({"ldd", file}).text);
}

}  // namespace turbidite
