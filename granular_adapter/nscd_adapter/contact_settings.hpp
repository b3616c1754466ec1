// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys contact.* as settings of the contact engine, read in one place for every host.
//
// Forces are physical forces, in weights of a grain in air (run.grain_weight). The contact problem
// of a coupled run has inertia cM, weight cMg and physical contact forces, so they are used
// unchanged.
//
// Material 0 has the coefficients of contact.*; those of run.materials follow, with the values that
// contact.materials.NAME specifies. A pair has the smaller value of both, unless contact.pairs.A-B
// specifies one; the first material is called "default" there.
#pragma once

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite {

/// Reads contact.*, run.velocity_scale and, if a surface is adhesive, run.diameter and
/// run.grain_weight. Missing keys of laws keep the engine's defaults. The host sets gravity and the
/// periodic box. Throws std::out_of_range or std::invalid_argument naming a key that is missing or
/// of another type.
nscd::EngineSettings contact_settings(const Settings& settings);

}  // namespace turbidite
