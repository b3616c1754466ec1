// SPDX-License-Identifier: GPL-3.0-or-later
//
// turbidite-bench-fluid RUN: times windows of our fluid on a prepared run folder, with --parallel
// under mpirun. With --discs the grains of the folder move as the contact engine and the fluid make
// them (scheme `split`), and only the fluid's work is timed.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "bench/fluid_ranks.hpp"
#include "bench/step_clock.hpp"
#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/foam_app/foamAdapter.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/run_folder.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    std::filesystem::path run;
    std::filesystem::path result;
    int warm_up = 0, steps = 1;
    bool discs = false, parallel = false;
};

/// The grains between two windows of the fluid; none at all without --discs.
class MovingGrains {
 public:
    MovingGrains(const ResolvedCase& resolved, bool discs) {
        if (!discs) return;
        contact_ = std::make_unique<NscdAdapter>();
        contact_->initialise(resolved.settings, resolved.shapes, resolved.population);
    }
    std::vector<GrainState> advance(const Window& window) {
        if (!contact_) return {};
        return contact_->advance(window, {}).grains;
    }
    void move(const Window& window, const std::vector<Kick>& kicks) {
        if (contact_) contact_->apply_kick(window, kicks);
    }

 private:
    std::unique_ptr<NscdAdapter> contact_;
};

/// Seconds of every part of every timed window.
class Profile {
 public:
    void add(const FluidTimings& t) {
        seconds_["1 projection"].push_back(t.projection);
        seconds_["2 transport"].push_back(t.transport);
        seconds_["3 viscosity"].push_back(t.viscosity);
        seconds_["5 points"].push_back(t.points);
        seconds_["5 multipliers"].push_back(t.multipliers);
    }
    std::map<std::string, double> medians() const {
        std::map<std::string, double> result;
        for (const auto& [part, values] : seconds_) result[part] = median(values);
        return result;
    }

 private:
    std::map<std::string, std::vector<double>> seconds_;
};

Sample run(const Options& options, FluidRanks& ranks) {
    const ResolvedCase resolved = load_run_folder(options.run);
    FoamAdapter fluid(RunFolder{options.run}.fluid());
    ranks.initialise(fluid, resolved.settings, resolved.shapes);
    MovingGrains grains(resolved, options.discs);
    const double dt = resolved.settings.real("run.step");
    StepClock clock;
    Profile profile;
    for (int n = 0; n < options.warm_up + options.steps; ++n) {
        const Window window{n, n * dt, dt, false, false};
        const std::vector<GrainState> moving = ranks.here(grains.advance(window));
        ranks.meet();
        clock.start();
        fluid.advance(window);
        fluid.correct(window, moving);
        const Kicks answer = fluid.impose(window);
        ranks.meet();
        if (n >= options.warm_up) {
            clock.stop();
            profile.add(fluid.timings());
        }
        grains.move(window, ranks.all(answer.kicks));
    }
    Sample sample;
    sample.processor = clock.processor();
    sample.wall = clock.wall();
    sample.resident = resident_bytes();
    sample.parts = profile.medians();
    return sample;
}

/// Without the end of MPI, which would wait for the other ranks: mpirun ends them.
[[noreturn]] void leave(int code, const char* why) {
    std::fprintf(stderr, "turbidite-bench-fluid: %s\n", why);
    std::fflush(nullptr);
    std::_Exit(code);
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"One contender of `turbidite bench fluid`", "turbidite-bench-fluid"};
    app.add_option("RUN", options.run, "run folder, prepared")->required();
    app.add_flag("--discs", options.discs, "with the grains of the folder");
    app.add_flag("--parallel", options.parallel, "on the ranks of mpirun");
    app.add_option("--warm-up", options.warm_up, "windows before the timed ones");
    app.add_option("--steps", options.steps, "timed windows");
    app.add_option("--result", options.result, "file to write")->required();
    CLI11_PARSE(app, argc, argv);
    turbidite::bench::FluidRanks ranks(options.parallel, &argc, &argv);
    try {
        const turbidite::bench::Sample sample = turbidite::bench::run(options, ranks);
        if (ranks.first()) write_sample(sample, options.result);
    } catch (const turbidite::Failure& failure) {
        turbidite::bench::leave(static_cast<int>(failure.code()), failure.what());
    } catch (const std::exception& error) {
        turbidite::bench::leave(static_cast<int>(turbidite::ExitCode::participant_failed),
                                error.what());
    }
    return 0;
}
