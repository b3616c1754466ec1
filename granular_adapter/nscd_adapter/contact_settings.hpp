// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The keys contact.* as settings of the contact engine: one reading for every host.
//
// Forces are physical ones in weights of a grain in air (run.grain_weight). The contact problem of
// a coupled run has inertia cM and weight cMg with physical contact forces, so they enter as they
// are.
//
// Material 0 has the coefficients of contact.*; those of run.materials follow, each with what
// contact.materials.NAME says otherwise. A pair has the smaller of both, or what
// contact.pairs.A-B says; the first material is called "default" there.
#pragma once

#include "coupler/protocol/settings.hpp"
#include "granular_adapter/nscd/engine/engine.hpp"

namespace turbidite {

/// Reads contact.*, run.velocity_scale and, where something adheres, run.diameter and
/// run.grain_weight. Keys of laws that are not there keep the engine's defaults. Gravity and
/// periodic box are the host's to set. Throws std::out_of_range or std::invalid_argument naming a
/// key that is missing or of another type.
nscd::EngineSettings contact_settings(const Settings& settings);

}  // namespace turbidite
