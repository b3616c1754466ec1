// SPDX-License-Identifier: GPL-3.0-or-later
//
// turbidite-bench-fluid RUN: times windows of our fluid on a prepared run folder, with --parallel
// under mpirun. With --discs the grains of the folder are moved by the contact engine and the
// fluid, under the case's scheme (`split` or `joint`), and only the fluid's work is timed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>

#include "bench/fluid/fluid_ranks.hpp"
#include "bench/timing/step_clock.hpp"
#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/protocol/failure.hpp"
#include "fluid_adapter/foam_app/foamAdapter.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/files/run_folder.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    std::filesystem::path run;
    std::filesystem::path result;
    int warm_up = 0, steps = 1;
    bool discs = false, parallel = false;
};

/// The contact engine for the grains; without --discs there are no grains.
class MovingGrains {
 public:
    MovingGrains(const ResolvedCase& resolved, bool discs) {
        if (!discs) return;
        contact_ = std::make_unique<NscdAdapter>();
        grains_ =
            contact_->initialise(resolved.settings, resolved.shapes, resolved.population).grains;
    }
    /// The grains at the start of the window.
    const std::vector<GrainState>& now() const { return grains_; }
    /// The grains after the contact solve.
    std::vector<GrainState> advance(const Window& window,
                                    const std::vector<FreeResponse>& responses) {
        if (!contact_) return {};
        const Motion motion = contact_->advance(window, responses);
        contacts_ = motion.report.contacts;
        return motion.grains;
    }
    void move(const Window& window, const std::vector<Kick>& kicks) {
        if (contact_) grains_ = contact_->apply_kick(window, kicks).grains;
    }
    std::int64_t contacts() const { return contacts_; }

 private:
    std::unique_ptr<NscdAdapter> contact_;
    std::vector<GrainState> grains_;
    std::int64_t contacts_ = 0;
};

/// Runs windows in the order of messages that the scheme of the case gives the fluid; only the
/// fluid is timed.
class Player {
 public:
    Player(const Options& options, const ResolvedCase& resolved, FoamAdapter& fluid,
           FluidRanks& ranks)
        : order_(find_scheme(resolved.settings.text("run.scheme")).fluid),
          fluid_(fluid),
          ranks_(ranks),
          grains_(resolved, options.discs),
          tolerance_(resolved.settings.real("coupling.tolerance") *
                     resolved.settings.real("run.velocity_scale")),
          most_rounds_(resolved.settings.integer("coupling.iterations")) {}

    FluidReport play(const Window& window, StepClock& clock) {
        clock.start();
        clock.pause();
        window_ = window;
        clock_ = &clock;
        const auto in_round = [](const Step& step) { return step.times == Times::per_round; };
        const auto first = std::find_if(order_.begin(), order_.end(), in_round);
        const auto after = std::find_if_not(first, order_.end(), in_round);
        play_steps(order_.begin(), first);
        for (int round = 0; first != after && round < most_rounds_; ++round) {
            play_steps(first, after);
            if (largest_mismatch() <= tolerance_) break;
        }
        play_steps(after, order_.end());
        stop_clock();
        clock.stop();
        grains_.move(window, ranks_.all(answer_.kicks));
        return answer_.report;
    }

    std::int64_t contacts() const { return grains_.contacts(); }

 private:
    void play_steps(Order::const_iterator first, Order::const_iterator last) {
        for (; first != last; ++first) play_step(first->kind);
    }

    /// What the fluid does with a message, or what it sends.
    void play_step(Kind kind) {
        if (kind == Kind::window) timed([&] { fluid_.advance(window_); });
        if (kind == Kind::bodies) {
            const std::vector<GrainState> grains = ranks_.here(grains_.now());
            timed([&] { fluid_.let_fall(window_, grains); });
        }
        if (kind == Kind::response) {
            std::vector<FreeResponse> here;
            timed([&] { here = fluid_.respond(); });
            stop_clock();
            responses_ = ranks_.all(here);
        }
        if (kind == Kind::constraint) {
            stop_clock();
            const std::vector<GrainState> grains =
                ranks_.here(grains_.advance(window_, responses_));
            timed([&] { fluid_.correct(window_, grains); });
        }
        if (kind == Kind::kicks) timed([&] { answer_ = fluid_.impose(window_); });
    }

    double largest_mismatch() const {
        double result = 0.0;
        for (const FreeResponse& response : responses_)
            result = std::max(result, response.mismatch);
        return result;
    }

    template <class Work>
    void timed(Work work) {
        if (!timing_) {
            ranks_.meet();
            clock_->resume();
        }
        timing_ = true;
        work();
    }

    void stop_clock() {
        if (!timing_) return;
        ranks_.meet();
        clock_->pause();
        timing_ = false;
    }

    const Order order_;
    FoamAdapter& fluid_;
    FluidRanks& ranks_;
    MovingGrains grains_;
    double tolerance_;  ///< [m/s]
    std::int64_t most_rounds_;
    Window window_;
    StepClock* clock_ = nullptr;
    bool timing_ = false;
    std::vector<FreeResponse> responses_;
    Kicks answer_;
};

/// Times of every part of every timed window [s].
class Profile {
 public:
    void add(const FluidTimings& t) {
        seconds_["1 projection"].push_back(t.projection);
        seconds_["2 transport"].push_back(t.transport);
        seconds_["3 viscosity"].push_back(t.viscosity);
        seconds_["5 points"].push_back(t.points);
        seconds_["5 multipliers"].push_back(t.multipliers);
        seconds_["5 correction"].push_back(t.correction);
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
    const ResolvedCase resolved = load_run_folder(options.run, {}, Machine::this_one);
    FoamAdapter fluid(RunFolder{options.run}.fluid());
    ranks.initialise(fluid, resolved.settings, resolved.shapes);
    Player player(options, resolved, fluid, ranks);
    const double dt = resolved.settings.real("run.step");
    StepClock warm_up, clock;
    Profile profile;
    std::vector<double> iterations;
    for (int n = 0; n < options.warm_up + options.steps; ++n) {
        const Window window{n, n * dt, dt, false};
        const bool timed = n >= options.warm_up;
        const FluidReport report = player.play(window, timed ? clock : warm_up);
        if (!timed) continue;
        profile.add(fluid.timings());
        iterations.push_back(static_cast<double>(report.multiplier_iterations));
    }
    Sample sample;
    sample.counts = {{"multiplier iterations", median(iterations)},
                     {"contacts", static_cast<double>(player.contacts())}};
    sample.processor = clock.processor();
    sample.wall = clock.wall();
    sample.resident = resident_bytes();
    sample.parts = profile.medians();
    return sample;
}

/// Exits without MPI_Finalize, which would wait for the other ranks: mpirun ends them.
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
