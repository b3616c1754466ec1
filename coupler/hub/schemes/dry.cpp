// SPDX-License-Identifier: LGPL-2.1-or-later
//
// No fluid: contact velocities are the final ones. The kick is empty and only triggers the motion.
//
//     grains   window → kick → state
#include "coupler/hub/schemes/exchanges.hpp"

namespace turbidite {
namespace {

class Dry final : public Scheme {
 public:
    WindowResult play(const Window& window, const Motion& before, SchemeContext context) override {
        context.grains.send_all(Kind::window, window);
        context.grains.send_all(Kind::kick, Kicks{});
        WindowResult result;
        receive_state(window, before, context, result);
        result.motion.report = result.state.report;
        result.motion.report.wall_seconds = 0.0;  // counted once, in the state
        result.grain_balance = context.kick_rule.balance(before, result.state, window.step);
        return result;
    }
};

}  // namespace

SchemeEntry dry_scheme() {
    return {
        .name = "dry",
        .help = "no fluid",
        .fluid = {},
        .grains = {{Kind::window, from_coupler},
                   {Kind::kick, from_coupler},
                   {Kind::state, to_coupler}},
        .slip_per_mismatch = 0.0,
        .make = [](const Settings&) -> std::unique_ptr<Scheme> { return std::make_unique<Dry>(); }};
}

}  // namespace turbidite
