// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/hub/scheme.hpp"

namespace turbidite {

/// The part that `split` and `joint` share: contact velocities from the grains to the fluid,
/// corrected velocities back, grains move.
WindowResult play_step_five(const Window& window, const Motion& before, Cast& cast);

}  // namespace turbidite
