// SPDX-License-Identifier: GPL-3.0-or-later
//
// The restart state of the fluid: time, u, p (the first guess of the next projection) and the
// steps' state beyond them. phi follows from these, and the multipliers start from zero in every
// window.
#pragma once

#include "coupler/participant/adapter.hpp"
#include "fluid_adapter/foam_app/fluidStep.hpp"

namespace turbidite {

/// The restart state of this rank as bytes.
SavedState save_fields(FluidFields& fields, FluidStep& step);

/// Throws Failure if the bytes belong to another mesh or decomposition.
void restore_fields(const SavedState& state, FluidFields& fields, FluidStep& step);

}  // namespace turbidite
