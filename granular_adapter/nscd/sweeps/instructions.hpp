// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Instruction sets for which the sweeps are compiled; the results are bitwise the same.
#pragma once

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define TURBIDITE_AVX2  // the compiler makes it for single functions
#endif

namespace turbidite::nscd {

enum class Instructions { portable, avx2 };

inline bool available(Instructions instructions) {
#ifdef TURBIDITE_AVX2
    return instructions == Instructions::portable || __builtin_cpu_supports("avx2");
#else
    return instructions == Instructions::portable;
#endif
}

inline Instructions best_instructions() {
    return available(Instructions::avx2) ? Instructions::avx2 : Instructions::portable;
}

}  // namespace turbidite::nscd
