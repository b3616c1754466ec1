// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `split`: the paper's Marchuk-Yanenko splitting (Topin 2011, §2.1.2). Steps 1-3 and step 4 run at
// the same time in their own programs; step 5 corrects both.
//
//     fluid    window → constraint → accept → kicks      steps 1-3 after `window`, then 5
//     grains   window → motion → kick → state            step 4 after `window`
#include "coupler/hub/schemes/exchanges.hpp"

namespace turbidite {
namespace {

class Split final : public Scheme {
 public:
    WindowResult play(const Window& window, const Motion& before, SchemeContext context) override {
        context.fluid->send_all(Kind::window, window);  // steps 1-3 begin
        context.grains.send_all(Kind::window, window);  // step 4 begins
        WindowResult result;
        result.motion = receive_motion(window, before, context);
        context.fluid->send_each(Kind::constraint, context.plan.by_place(result.motion));
        send_accept(context);
        finish_window(window, before, context, result);
        return result;
    }
};

}  // namespace

SchemeEntry split_scheme() {
    return {.name = "split",
            .help = "contacts, then fluid, as in Topin et al. 2011",
            .fluid = {{Kind::window, from_coupler},
                      {Kind::constraint, from_coupler},
                      {Kind::accept, from_coupler},
                      {Kind::kicks, to_coupler}},
            .grains = {{Kind::window, from_coupler},
                       {Kind::motion, to_coupler},
                       {Kind::kick, from_coupler},
                       {Kind::state, to_coupler}},
            .slip_per_mismatch = 0.0,
            .make = [](const Settings&) -> std::unique_ptr<Scheme> {
                return std::make_unique<Split>();
            }};
}

}  // namespace turbidite
