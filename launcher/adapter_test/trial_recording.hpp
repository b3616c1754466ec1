// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the recording (coupler/transport/recording.hpp) of a trial tells about the program under
// test: its own words and its own numbers, where the coupler's record has sums and maxima.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/hello.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

/// What rank 0 said of itself; without a capability if it said nothing.
Capabilities capabilities_of(const std::filesystem::path& recording);

/// The text with which the program ended the run; empty if it did not: it crashed or left.
std::optional<std::string> failure_told(const std::filesystem::path& recording);

/// The first fault of a state that the program was to save; empty if there is none.
std::string save_fault(const std::filesystem::path& recording);

/// The grains at t = 0 and after every window, those of all ranks together in the order of their
/// ids, with the reports and contacts of all ranks. Throws MalformedPayload.
std::vector<Motion> states_of(const std::filesystem::path& recording);

}  // namespace turbidite
