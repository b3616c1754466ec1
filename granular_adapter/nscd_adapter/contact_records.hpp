// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The engine's last contacts as records of the protocol.
#pragma once

#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite {

/// Every contact point that carries something, sorted by (wall, a, b, feature). Positions of the
/// bodies must still be those that the contacts were detected at: call it before the move. Walls
/// are named by their keys.
std::vector<ContactRecord> contact_records(const nscd::Engine& engine);

/// Without the contacts of grains that are gone.
void drop_contacts_of(const std::vector<GrainId>& gone, std::vector<ContactRecord>& contacts);

}  // namespace turbidite
