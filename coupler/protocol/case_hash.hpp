// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The fingerprint by which all programs of a job know that they were started on the same case.
/// Valid C++17.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>

namespace turbidite {

/// FNV-1a, 64 bits, as 16 hexadecimal digits, of the resolved case's text.
inline std::string case_hash(const std::string& text) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const unsigned char byte : text) hash = (hash ^ byte) * 0x100000001b3u;
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
    return digits;
}

}  // namespace turbidite
