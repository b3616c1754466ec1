// SPDX-License-Identifier: LGPL-2.1-or-later
//
// faulty_fluid -case RUN/fluid, in place of turbidite-fluid: a scripted fluid with the fault named
// by TURBIDITE_FAULT in window 5: nan, divergence, unsolved, exit, throw.
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"

namespace {

using namespace turbidite;

constexpr double drag = 0.3;
constexpr std::int64_t faulty_window = 5;

class FaultyFluid final : public ScriptedFluid {
 public:
    explicit FaultyFluid(std::string fault) : ScriptedFluid(drag), fault_(std::move(fault)) {}

    Kicks impose(const Window& window) override {
        Kicks kicks = ScriptedFluid::impose(window);
        if (window.index < faulty_window) return kicks;
        if (fault_ == "nan") kicks.kicks.at(0).velocity[0] = not_a_number;
        if (fault_ == "divergence") kicks.report.divergence = not_a_number;
        if (fault_ == "unsolved") kicks.report.multipliers_converged = false;
        if (fault_ == "exit") _exit(0);
        if (fault_ == "throw") throw std::runtime_error("scripted trouble");
        return kicks;
    }

 private:
    static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    std::string fault_;
};

}  // namespace

int main(int argc, char** argv) {
    const char* fault = std::getenv("TURBIDITE_FAULT");
    FaultyFluid fluid(fault ? fault : "");
    const std::filesystem::path foam_case = argv[2];
    return run_fluid(fluid, {&argc, &argv, foam_case.parent_path().string()});
}
