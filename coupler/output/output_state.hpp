// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the output of a run passes from one window to the next, for checkpoints. Files are not
// copied into a checkpoint: their lengths are, and a resumed run cuts off what was written later.
#pragma once

#include <cstdint>
#include <filesystem>

#include "coupler/output/measures/run_statistics.hpp"
#include "coupler/protocol/wire.hpp"

namespace turbidite {

/// In bytes; -1: the file did not exist.
struct OutputLengths {
    std::int64_t history = -1, probes = -1;
    std::int64_t grains = -1, contacts = -1;  ///< of the series files, without their end tags
};

struct OutputState {
    Motion state;  ///< where the last window ended
    RunStatistics statistics;
    SinceRow since_row;
    OutputLengths lengths;
    /// Where no window follows: with the row that an end out of turn adds.
    OutputLengths lengths_at_end;
};

Bytes encode(const OutputState& state);
/// Throws MalformedPayload.
template <>
OutputState decode(View bytes);

/// Throws Failure (bad input) if a file is missing or shorter than `length` bytes: it was changed
/// since the checkpoint, and rows of it are lost.
void require_length(const std::filesystem::path& file, std::int64_t length);

/// Cuts it to `length` bytes. Throws as above.
void cut_to(const std::filesystem::path& file, std::int64_t length);

}  // namespace turbidite
