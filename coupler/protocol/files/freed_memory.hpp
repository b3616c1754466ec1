// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// For programs that allocate and free arrays in every window. Valid C++17.
#pragma once

#include <malloc.h>

namespace turbidite {

/// From now on freed memory stays with the process. Otherwise the system takes large blocks back
/// and clears the same pages again at the next request, which costs a considerable part of a
/// window.
inline void keep_freed_memory() {
    constexpr int most = 1 << 30;
    ::mallopt(M_MMAP_THRESHOLD, most);
    ::mallopt(M_TRIM_THRESHOLD, most);
}

}  // namespace turbidite
