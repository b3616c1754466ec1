// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Exchanges shared by the schemes. Every message is checked here, once, before it is used: its
// numbers (hub/checks/arrival.hpp), its grains (hub/checks/grain_roster.hpp), its contacts
// (hub/checks/contact_check.hpp), and where it says that the grains are
// (hub/checks/motion_rule.hpp).
#pragma once

#include "coupler/hub/schemes/scheme.hpp"

namespace turbidite {

/// Waits for the grains' state at t = 0.
Motion receive_start(SchemeContext& context);

/// Waits for the contact velocities of all grains. `before` is the state at t^n, here and below.
Motion receive_motion(const Window& window, const Motion& before, SchemeContext& context);

/// Waits for the state at t^{n+1}. Fills state and motion defect of `result`, whose motion is that
/// of the window; it has no grains without a fluid.
void receive_state(const Window& window, const Motion& before, SchemeContext& context,
                   WindowResult& result);

/// Waits for the responses of all grains to contact impulses.
std::vector<FreeResponse> receive_responses(const Window& window, SchemeContext& context);

/// One round of a scheme that repeats its contact solves: `inputs` to the grains, by rank, their
/// motion to the fluid. Fills the motion of `result`, whose iterations and times add up, and counts
/// the round in its `joint`; returns the responses.
std::vector<FreeResponse> play_contact_round(const Window& window, const Motion& before,
                                             const std::vector<std::vector<FreeResponse>>& inputs,
                                             SchemeContext& context, WindowResult& result);

/// The last constraint is final: the fluid ends its window.
void send_accept(SchemeContext& context);

/// After send_accept: sends corrected velocities to the grains, which move. Fills kicks, balance
/// and state.
void finish_window(const Window& window, const Motion& before, SchemeContext& context,
                   WindowResult& result);

}  // namespace turbidite
