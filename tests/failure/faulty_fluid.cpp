// SPDX-License-Identifier: LGPL-2.1-or-later
//
// faulty_fluid -case RUN/fluid, in place of turbidite-fluid: a scripted fluid with the fault named
// by TURBIDITE_FAULT in window 5: nan, divergence, unsolved, throw, or an end: _exit-0, _exit-3,
// exit-0, segfault, mpi-abort, terminate, finalize, loop, own-loop-throws, own-loop-returns; what
// it has to say before such an end goes to its log. late-twice answers the contact impulses of that
// window late, and sends its kicks late. Before MPI_Init: early-0, early-3, early-hang; after it:
// joined-throws.
#include <mpi.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>

#include "coupler/participant/participant.hpp"
#include "coupler/participant/scripted.hpp"

namespace {

using namespace turbidite;

constexpr double drag = 0.3;
constexpr std::int64_t faulty_window = 5;

class FaultyFluid final : public ScriptedFluid {
 public:
    explicit FaultyFluid(std::string fault) : ScriptedFluid(drag), fault_(std::move(fault)) {}

    void correct(const Window& window, const std::vector<GrainState>& solved) override {
        be_late(window);
        ScriptedFluid::correct(window, solved);
    }

    Kicks impose(const Window& window) override {
        be_late(window);
        Kicks kicks = ScriptedFluid::impose(window);
        if (window.index < faulty_window) return kicks;
        if (fault_ == "nan") kicks.kicks.at(0).velocity[0] = not_a_number;
        if (fault_ == "divergence") kicks.report.divergence = 1.0;
        if (fault_ == "unsolved") kicks.report.multipliers_converged = false;
        if (window.index == faulty_window) std::fprintf(stderr, "now comes %s\n", fault_.c_str());
        if (fault_ == "mpi-abort") PMPI_Abort(MPI_COMM_WORLD, 77);
        if (fault_ == "terminate") std::terminate();
        if (fault_ == "finalize") PMPI_Finalize();
        if (fault_ == "loop") spin();
        if (fault_ == "_exit-0") _exit(0);
        if (fault_ == "_exit-3") _exit(3);
        if (fault_ == "exit-0") std::exit(0);
        if (fault_ == "segfault") raise(SIGSEGV);
        if (fault_ == "throw") throw std::runtime_error("scripted trouble");
        return kicks;
    }

 private:
    /// Within limits.stall_hard = 3 s, and two times not within one and a half of it.
    void be_late(const Window& window) const {
        if (fault_ == "late-twice" && window.index == faulty_window)
            std::this_thread::sleep_for(std::chrono::milliseconds(2400));
    }

    [[noreturn]] static void spin() {
        for (volatile bool more = true; more;) {
        }
        std::abort();
    }

    static constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
    std::string fault_;
};

/// What a missing library or a wrong argument may do to a program.
void end_early(const std::string& fault) {
    if (fault.rfind("early", 0) != 0) return;
    std::fprintf(stderr, "cannot find my libraries\n");
    if (fault == "early-hang") pause();
    std::exit(fault == "early-3" ? 3 : 0);
}

/// A host with its own loop, in which something of its own goes wrong.
int play_in_own_loop(FaultyFluid& fluid, const Launch& launch, const std::string& fault) {
    Membership membership(Role::fluid, launch);
    const auto session = make_session(fluid, membership.channel(), membership.identity());
    session->start();
    for (std::int64_t window = 0; window < faulty_window; ++window) session->step();
    std::fprintf(stderr, "now comes %s\n", fault.c_str());
    if (fault == "own-loop-throws") throw std::runtime_error("scripted trouble");
    return 0;
}

int play(FaultyFluid& fluid, const Launch& launch, const std::string& fault) {
    try {
        return play_in_own_loop(fluid, launch, fault);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "in my own words: %s\n", error.what());
        return 3;
    }
}

}  // namespace

int main(int argc, char** argv) {
    const char* variable = std::getenv("TURBIDITE_FAULT");
    const std::string fault = variable ? variable : "";
    end_early(fault);
    FaultyFluid fluid(fault);
    const std::filesystem::path foam_case = argv[2];
    Launch launch{&argc, &argv, foam_case.parent_path().string()};
    if (fault.rfind("own-loop", 0) == 0) return play(fluid, launch, fault);
    if (fault == "joined-throws")
        launch.joined = [](int) { throw std::runtime_error("scripted trouble"); };
    return run_fluid(fluid, launch);
}
