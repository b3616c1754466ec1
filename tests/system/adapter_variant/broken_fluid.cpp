// SPDX-License-Identifier: LGPL-2.1-or-later
//
// broken-fluid FAULT -case RUN/fluid [-parallel]: a linear drag on one rank or two, with one fault
// that `turbidite adapter-test --side fluid` must find.
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"

namespace {

using namespace turbidite;

/// The fluid's ranks follow that of the coupler.
int own_rank() {
    const char* rank = std::getenv("OMPI_COMM_WORLD_RANK");
    return rank ? std::atoi(rank) - 1 : 0;
}

double noise() {
    return 1e-15 * static_cast<double>(std::chrono::steady_clock::now().time_since_epoch().count() %
                                       1000003);
}

class BrokenFluid final : public ScriptedFluid {
 public:
    BrokenFluid(std::string fault, int ranks)
        : ScriptedFluid(0.3, own_rank(), ranks), fault_(std::move(fault)) {}

    void correct(const Window& window, const std::vector<GrainState>& grains) override {
        if (fault_ == "wants all grains" && grains.size() < most_)
            throw std::runtime_error("a grain is gone");
        most_ = grains.size();
        ScriptedFluid::correct(window, grains);
    }

    std::vector<FreeResponse> respond() override {
        std::vector<FreeResponse> responses = ScriptedFluid::respond();
        if (fault_ == "wrong response")
            for (FreeResponse& response : responses) response.velocity[1] *= 1.05;
        return responses;
    }

    Kicks impose(const Window& window) override {
        if (fault_ == "fails at the end" && window.index == 0)
            throw std::runtime_error("no more windows");
        Kicks kicks = ScriptedFluid::impose(window);
        ++windows_;
        for (Kick& kick : kicks.kicks) spoil(kick);
        return kicks;
    }

 private:
    void spoil(Kick& kick) const {
        if (fault_ == "wind") push(kick, 0.01);
        if (fault_ == "noisy") push(kick, noise());
        if (fault_ == "wrong impulse") kick.multiplier_impulse[1] *= 1.01;
        if (fault_ == "moves all") kick.velocity[0] *= 0.9;
        if (fault_ == "second rank is windy" && own_rank() == 1) push(kick, 0.01);
        if (fault_ == "forgets") push(kick, 1e-3 * windows_);
    }

    /// With the impulse that belongs to it: cM of a disc of diameter 1 and density ratio 1.5.
    static void push(Kick& kick, double change) {
        kick.velocity[0] += change;
        kick.multiplier_impulse[0] += 0.5 * std::acos(-1.0) / 4.0 * change;
    }

    std::string fault_;
    std::size_t most_ = 0;
    int windows_ = 0;  ///< of this process
};

}  // namespace

int main(int argc, char** argv) {
    const bool parallel = std::string(argv[argc - 1]) == "-parallel";
    const std::filesystem::path foam_case = argv[3];
    BrokenFluid fluid(argv[1], parallel ? 2 : 1);
    return run_fluid(fluid, {&argc, &argv, foam_case.parent_path().string()});
}
