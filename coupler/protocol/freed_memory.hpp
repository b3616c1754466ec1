// SPDX-License-Identifier: LGPL-2.1-or-later
//
// For programs whose arrays come and go in every window. Valid C++17.
#pragma once

#include <malloc.h>

namespace turbidite {

/// From now on freed memory stays with the process. Otherwise the system takes large pieces back
/// and clears the same pages again at the next request: a quarter of a window of OpenFOAM's
/// operators, a fifth of a contact step of a million grains.
inline void keep_freed_memory() {
    constexpr int most = 1 << 30;
    ::mallopt(M_MMAP_THRESHOLD, most);
    ::mallopt(M_TRIM_THRESHOLD, most);
}

}  // namespace turbidite
