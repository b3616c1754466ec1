// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contacts of the engine's last step as records of the protocol.
#pragma once

#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite {

/// Every contact point with an impulse, sorted by (wall, a, b, feature). The bodies must still be
/// at the positions at which the contacts were detected: to be called before the move. Walls are
/// identified by their keys.
std::vector<ContactRecord> contact_records(const nscd::Engine& engine);

/// Removes the contacts of grains that no longer exist.
void drop_contacts_of(const std::vector<GrainId>& gone, std::vector<ContactRecord>& contacts);

}  // namespace turbidite
