// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/hub/scheme.hpp"

namespace turbidite {

/// The part that `split` and `joint` share: contact velocities to the fluid, corrected velocities back, grains move.
void play_step_five(const Window& window, const Motion& before, Cast& cast, WindowResult& result);

}  // namespace turbidite
