// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a restart needs of the fluid: time, u, p (the first guess of the next projection) and what
// the faces know beyond u. phi follows from these, and the multipliers start from zero in every
// window.
#pragma once

#include "coupler/participant/adapter.hpp"
#include "fluid_adapter/foam_app/createFields.hpp"

namespace turbidite {

SavedState save_fields(const FluidFields& fields);

/// Throws Failure when the bytes belong to a mesh of another size.
void restore_fields(const SavedState& state, FluidFields& fields);

}  // namespace turbidite
