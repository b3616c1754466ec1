// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How fast one core of this machine moves memory: a = b + s c over arrays far larger than caches,
// 24 bytes per element as in STREAM, whose count leaves out that `a` is read before it is written.
#pragma once

namespace turbidite::bench {

double memory_triad();  ///< [bytes/s], best of a few passes

}  // namespace turbidite::bench
