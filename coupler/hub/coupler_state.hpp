// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's own part of a checkpoint.
#pragma once

#include <cstdint>
#include <vector>

#include "coupler/hub/checks/ledger.hpp"
#include "coupler/output/output_state.hpp"

namespace turbidite {

struct CouplerState {
    std::int64_t windows = 0;   ///< done
    double wall_seconds = 0.0;  ///< of the run up to here, without the time between its parts
    LedgerState ledger;
    std::vector<std::int64_t> owners;  ///< rank of each grain of output.state
    OutputState output;
};

Bytes encode(const CouplerState& state);
/// Throws MalformedPayload.
template <>
CouplerState decode(View bytes);

/// Shares the grains out among another number of ranks (protocol/even_shares.hpp).
void share_out(CouplerState& state, int ranks);

/// The grains of `state` by the ranks that own them.
std::vector<Motion> shares_of(const CouplerState& state, int ranks);

}  // namespace turbidite
