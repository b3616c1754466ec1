// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contacts that come with a state: all ranks report them or none does, every one is of grains
// of the run, and occurs once. Their numbers are checked where they arrive (hub/checks/arrival).
#pragma once

#include <vector>

#include "coupler/hub/checks/grain_roster.hpp"

namespace turbidite {

/// Throws PhysicsRefused naming the sender and the contact. `roster` has checked the grains of the
/// same message.
void check_contacts(const std::vector<Motion>& shares, const GrainRoster& roster,
                    const Arrival& arrival);

}  // namespace turbidite
