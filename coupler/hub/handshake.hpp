// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The first exchange: every rank identifies itself; all mismatches with the case are reported
// together.
#pragma once

#include <vector>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/hub/watch.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// What the case requires of the participant in this role.
Expectation expectation(Role role, const Settings& settings, const ShapeTable& shapes,
                        const SchemeEntry& scheme);

/// Collects the hellos of all ranks of all links. Throws Failure (handshake refused) with every
/// mismatch.
void shake_hands(const std::vector<ParticipantLink*>& links, const Settings& settings,
                 const ShapeTable& shapes, const SchemeEntry& scheme, Watch& watch);

}  // namespace turbidite
