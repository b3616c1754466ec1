// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the hub is compared with: three ranks of a world, of which rank 0 passes on to rank 1 what
// rank 2 sends, as it is, from one buffer, with blocking calls.
#pragma once

#include <cstdint>
#include <vector>

namespace turbidite::bench {

/// Collective. Sends `bytes` bytes `turns` times; on rank 1 the seconds of each turn, from the
/// moment that rank 2 begins to send to the moment that all has arrived, else nothing.
std::vector<double> relayed(std::int64_t bytes, int turns);

}  // namespace turbidite::bench
