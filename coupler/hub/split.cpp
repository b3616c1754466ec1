// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `split`: the paper's Marchuk-Yanenko splitting (Topin 2011, §2.1.2). Steps 1-3 and step 4 run at
// the same time in their own programs; step 5 corrects both.
#include "coupler/hub/step_five.hpp"

namespace turbidite {
namespace {

class Split final : public Scheme {
 public:
    WindowResult play(const Window& window, const Motion& before, Cast& cast) override {
        cast.fluid->send_all(Kind::window, window);  // steps 1-3 begin
        cast.grains.send_all(Kind::window, window);  // step 4 begins
        WindowResult result;
        result.motion = receive_motion(cast);
        cast.fluid->send_each(Kind::constraint, cast.plan.by_place(result.motion));
        finish_window(window, before, cast, result);
        return result;
    }
};

}  // namespace

std::unique_ptr<Scheme> make_split(const Settings&) {
    return std::make_unique<Split>();
}

}  // namespace turbidite
