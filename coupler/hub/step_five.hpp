// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The exchanges that `split` and `joint` share.
#pragma once

#include "coupler/hub/scheme.hpp"

namespace turbidite {

/// Waits for the contact velocities of all grains.
Motion receive_motion(Cast& cast);

/// The fluid has been told the motion of `result` and ends step 5: corrected velocities to the
/// grains, which move. Fills kicks and state.
void finish_window(const Window& window, const Motion& before, Cast& cast, WindowResult& result);

}  // namespace turbidite
