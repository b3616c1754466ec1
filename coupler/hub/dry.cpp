// SPDX-License-Identifier: LGPL-2.1-or-later
//
// No fluid: contact velocities are the final ones.
#include "coupler/hub/scheme.hpp"

namespace turbidite {
namespace {

class Dry final : public Scheme {
 public:
    WindowResult play(const Window& window, const Motion&, Cast& cast) override {
        cast.grains.send_all(Kind::window, window);
        cast.grains.send_all(Kind::kick, Kicks{});
        WindowResult result;
        cast.watch.wait_for(cast.grains, Kind::state);
        result.state = cast.plan.gather(cast.grains.take<Motion>(Kind::state));
        result.motion.grains = result.state.grains;
        result.motion.report = result.state.report;
        result.motion.report.wall_seconds = 0.0;  // counted once, in the state
        return result;
    }
};

}  // namespace

std::unique_ptr<Scheme> make_dry(const Settings&) {
    return std::make_unique<Dry>();
}

}  // namespace turbidite
