// SPDX-License-Identifier: GPL-3.0-or-later
//
// What contacts remember, without the engine's walls: those are YADE's bodies, and their number may
// change while contacts live on.
#pragma once

#include <vector>

#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite::yade {

std::vector<char> contact_memory(nscd::Engine& engine);

/// Throws std::invalid_argument on anything but what contact_memory gave.
void restore_contact_memory(nscd::Engine& engine, const std::vector<char>& bytes);

}  // namespace turbidite::yade
