// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When messages passed a channel, on the monotonic clock of the machine, which all programs of a
// benchmark share; and what follows from it.
#pragma once

#include <filesystem>
#include <vector>

#include "coupler/protocol/message.hpp"

namespace turbidite::bench {

/// A frame that passed the channel of one program.
struct Stamp {
    Kind kind = Kind::hello;
    std::int64_t window = -1;
    bool sent = false;   ///< or received
    double begin = 0.0;  ///< sent: handed to the channel. Received: as `end` [s]
    double end = 0.0;  ///< sent: the channel has taken all of it. Received: its last byte is there
    std::int64_t bytes = 0;
    double processor = 0.0;  ///< processor time of the program so far [s]; not in files
};

/// One file per program. Throw Failure naming the file.
void write_stamps(const std::vector<Stamp>& stamps, const std::filesystem::path& file);
std::vector<Stamp> read_stamps(const std::filesystem::path& file);

/// How long a message takes from the program that stamped `from`, as its frames of kind `in`, to
/// the one that stamped `to`, as frames of kind `out`; one value per window from `first` on that
/// both have [s]. Time begins when the first frame is handed to a channel that sends it, or when
/// the last frame has been received. It ends with the last frame of `out`.
///
///     delays(hub, Kind::motion, hub, Kind::constraint, 1)       last byte in to last byte out
///     delays(grains, Kind::motion, fluid, Kind::constraint, 1)  over both hops
std::vector<double> delays(const std::vector<Stamp>& from, Kind in, const std::vector<Stamp>& to,
                           Kind out, std::int64_t first);

/// Length of all frames of a kind in a window.
std::int64_t bytes_of(const std::vector<Stamp>& stamps, Kind kind, std::int64_t window);

}  // namespace turbidite::bench
