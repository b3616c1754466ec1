// SPDX-License-Identifier: LGPL-2.1-or-later
//
// broken-grains FAULT RUN: grains that fall, with a floor but without contacts between each other,
// and with one fault that `turbidite adapter-test` must find.
#include <chrono>
#include <cstdlib>
#include <stdexcept>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"

namespace {

using namespace turbidite;

/// The second rank of the grains in a job of coupler, one fluid rank and two of grains.
bool is_second_rank() {
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    return rank && std::atoi(rank) == 3;
}

double noise() {
    return 1e-15 * static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count() %
                                       1000003);
}

class BrokenGrains final : public ScriptedGrains {
 public:
    explicit BrokenGrains(std::string fault) : ScriptedGrains("broken"), fault_(std::move(fault)) {
        lay_floor(0.0);
        hello_.capabilities.restores_within_window = fault_ == "never goes back";
    }

    Motion initialise(const Settings& settings, const ShapeTable& shapes,
                      const std::vector<GrainState>& grains) override {
        Settings own = settings;
        if (fault_ == "heavy") own.set("run.gravity", 1.00001 * settings.real("run.gravity"));
        return ScriptedGrains::initialise(own, shapes, grains);
    }

    Motion advance(const Window& window, const std::vector<FreeResponse>& responses) override {
        const bool deaf = fault_ == "own inertia" || fault_ == "never goes back";
        ScriptedGrains::advance(window, deaf ? std::vector<FreeResponse>() : responses);
        if (fault_ == "slow across")
            for (GrainState& grain : motion_.grains) grain.velocity[2] *= 1.0 - 1e-6;
        if (fault_ == "noisy")
            for (GrainState& grain : motion_.grains) grain.velocity[0] += noise();
        return motion_;
    }

    Motion apply_kick(const Window& window, const std::vector<Kick>& kicks) override {
        if (fault_ == "fails at the end" && window.index == 0)
            throw std::runtime_error("no more windows");
        const bool deaf = fault_ == "deaf" || (fault_ == "second rank is deaf" && is_second_rank());
        Motion state = ScriptedGrains::apply_kick(window, deaf ? std::vector<Kick>() : kicks);
        if (fault_ == "wrong impulse")
            for (GrainState& grain : state.grains) grain.contact_impulse[0] += 0.01;
        return state;
    }

    void restore(const SavedState& state) override {
        ScriptedGrains::restore(state);
        if (fault_ == "forgets digits")
            for (GrainState& grain : motion_.grains) grain.velocity[0] += 1e-8;
        if (fault_ == "forgets places")
            for (GrainState& grain : motion_.grains) grain.position[0] += 1e-6;
    }

 private:
    std::string fault_;
};

}  // namespace

int main(int argc, char** argv) {
    BrokenGrains grains(argv[1]);
    return run_grains(grains, {&argc, &argv, argv[argc - 1]});
}
