// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Memory bandwidth of one core: a = b + s c over arrays far larger than the caches, counted as 24
// bytes per element as in STREAM, which does not count that `a` is read before it is written.
#pragma once

namespace turbidite::bench {

double memory_triad();  ///< [bytes/s], best of a few passes

}  // namespace turbidite::bench
