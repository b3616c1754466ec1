// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `joint`: the fluid answers for free grains with velocities and effective inertia, one contact
// solve uses them, the fluid imposes the result.
#include "coupler/hub/step_five.hpp"

namespace turbidite {
namespace {

class Joint final : public Scheme {
 public:
    WindowResult play(const Window& window, const Motion& before, Cast& cast) override {
        cast.fluid->send_all(Kind::window, window);
        cast.grains.send_all(Kind::window, window);
        cast.fluid->send_each(Kind::bodies, cast.plan.by_place(before));
        cast.watch.wait_for(*cast.fluid, Kind::response);

        std::vector<FreeResponse> responses;
        for (auto& share : cast.fluid->take<std::vector<FreeResponse>>(Kind::response))
            responses.insert(responses.end(), share.begin(), share.end());
        cast.grains.send_each(Kind::contact_input, cast.plan.by_owner(responses));
        return play_step_five(window, before, cast);
    }
};

}  // namespace

std::unique_ptr<Scheme> make_joint() {
    return std::make_unique<Joint>();
}

}  // namespace turbidite
