// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A file system of 1 MB, `disk` in the scratch folder, in a mount namespace of its own that ends
// with the shell that created it.
#pragma once

#include <string>

#include "tests/system/shell_test.hpp"

namespace turbidite {

/// A line for the shell, in the scratch folder, that plays `line` with such a disk.
inline std::string on_small_disk(const std::string& line) {
    const std::string unshare = geteuid() == 0 ? "unshare -m" : "unshare -rm";
    return "mkdir -p disk && " + unshare + " sh -c 'mount -t tmpfs -o size=1m tmpfs disk && { " +
           line + "; }'";
}

/// For tests that cannot be played without the right to mount.
inline constexpr auto no_small_disk =
    "NOT TESTED HERE: what a run does when the disk becomes full, and that it goes on when there "
    "is "
    "room again. Mounting a small disk needs root, or user namespaces (unshare -rm).";

}  // namespace turbidite
