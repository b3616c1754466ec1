// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// For programs that allocate and free arrays in every window, and those that start them. Valid
/// C++17.
#pragma once

#include <malloc.h>

#include <cstdlib>

namespace turbidite {

/// From now on freed memory stays with the process. Otherwise the system takes large blocks back
/// and clears the same pages again at the next request, which costs a considerable part of a
/// window.
inline void keep_freed_memory() {
    constexpr int most = 1 << 30;
    ::mallopt(M_MMAP_THRESHOLD, most);
    ::mallopt(M_TRIM_THRESHOLD, most);
}

/// Programs started from now on get pages of 2 MB for their arrays where the system gives such
/// pages on request (docs/decisions/job.md). A user's own GLIBC_TUNABLES stay.
inline void ask_for_large_pages() {
    ::setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", 0);
}

}  // namespace turbidite
