// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The numbers in the files of a fluid, for tests of whole runs.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace turbidite {

/// A field of all cells as OpenFOAM wrote it; empty if it has fewer numbers.
inline std::vector<double> openfoam_field(const std::string& written, std::size_t count) {
    const std::size_t open = written.find('(', written.find("nonuniform"));
    std::vector<double> values(count);
    if (open == std::string::npos || written.size() < open + 1 + 8 * count) return {};
    std::memcpy(values.data(), written.data() + open + 1, 8 * count);
    return values;
}

/// An array of a .vtr file, raw float32 after the header; empty if it has none of that name.
inline std::vector<float> slice_array(const std::string& file, const std::string& name) {
    const std::string mark = "encoding=\"raw\">\n_";
    const std::size_t begin = file.find(mark), at = file.find("Name=\"" + name + "\"");
    if (begin == std::string::npos || at == std::string::npos) return {};
    const std::size_t word = file.find("offset=\"", at) + 8;
    const char* data = file.data() + begin + mark.size() + std::stoul(file.substr(word));
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, data, sizeof bytes);
    std::vector<float> values(bytes / sizeof(float));
    std::memcpy(values.data(), data + sizeof bytes, bytes);
    return values;
}

}  // namespace turbidite
