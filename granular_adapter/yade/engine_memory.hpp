// SPDX-License-Identifier: GPL-3.0-or-later
//
// The contact memory of an engine without its walls: these are bodies of YADE, and their number may
// change while contacts persist.
#pragma once

#include <vector>

#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite::yade {

/// `names`: under which its contacts are kept; null: their own.
std::vector<char> contact_memory(nscd::Engine& engine, const nscd::KeyNames* names = nullptr);

/// Throws std::invalid_argument for anything not written by contact_memory.
void restore_contact_memory(nscd::Engine& engine, const std::vector<char>& bytes);

}  // namespace turbidite::yade
