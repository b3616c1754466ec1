// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cells of grains lie in short rows far apart in memory, where the processor does not look ahead by
// itself: asking early hides most of the waiting. Changes no value. Valid C++17.
#pragma once

namespace turbidite {

inline void ask_for([[maybe_unused]] const void* address) {
#ifdef __GNUC__
    __builtin_prefetch(address);
#endif
}

}  // namespace turbidite
