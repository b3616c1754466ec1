// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The partner that `turbidite adapter-test` scripts:
//
//     turbidite-partner -case RUN/fluid    in the place of turbidite-fluid: a linear drag
//     turbidite-partner grains RUN         grains that fall freely, touch nothing, and leave
//                                          through free sides
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/adapter_test/partner.hpp"

namespace {

using namespace turbidite;

/// Grains whose centre is beyond a free side are no longer sent.
class LeavingGrains final : public ScriptedGrains {
 public:
    LeavingGrains() : ScriptedGrains("scripted-grains") {}

    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        run_ = run_values(settings);
        types_ = side_types(settings);
        return ScriptedGrains::initialise(settings, shapes, grains);
    }

    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        Motion state = ScriptedGrains::apply_kick(window, kicks);
        auto& grains = motion_.grains;
        const auto end = std::remove_if(grains.begin(), grains.end(),
                                        [this](const GrainState& g) { return has_left(g); });
        state.report.removed = grains.end() - end;
        grains.erase(end, grains.end());
        state.grains = grains;
        return state;
    }

 private:
    bool has_left(const GrainState& grain) const {
        for (std::size_t side = 0; side < side_count(run_.dimension); ++side)
            if (types_[side] == "free" && box_sides[side].distance(grain.position, run_.size) < 0.0)
                return true;
        return false;
    }

    RunValues run_;
    SideTypes types_;
};

}  // namespace

int main(int argc, char** argv) {
    const std::string what = argc < 3 ? "" : argv[1];
    if (what == "grains") {
        LeavingGrains grains;
        return run_grains(grains, {&argc, &argv, argv[2]});
    }
    if (what == "-case") {
        ScriptedFluid fluid(partner_drag);
        const std::filesystem::path foam_case = argv[2];
        return run_fluid(fluid, {&argc, &argv, foam_case.parent_path().string()});
    }
    std::fprintf(stderr, "usage: turbidite-partner -case RUN/fluid | grains RUN\n");
    return static_cast<int>(ExitCode::bad_input);
}
