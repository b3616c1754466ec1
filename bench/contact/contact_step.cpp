// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-bench-contact: times the contact solver on the steps of a dense column of discs, or of
// spheres.
//
// Every step is done by the engine (with warm start and detection). Then its problem is solved once
// more from the same initial guess, and only this solve is timed. Counted are updates of contacts
// that have an impulse at the end: the sweeps times their number.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "bench/contact/dense_packing.hpp"
#include "bench/timing/step_clock.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    Column column;
    bool spheres = false;
    double step = 0.01;
    int warm_up = 0, steps = 1;
    nscd::SolverSettings solver;
    std::filesystem::path result;
};

/// Sums over the timed steps.
struct Totals {
    double candidates = 0.0, contacts = 0.0, sweeps = 0.0, updates = 0.0, converged = 0.0;

    void add(const nscd::SolverResult& result) {
        const auto loaded = static_cast<double>(
            std::count_if(result.impulses.begin(), result.impulses.end(),
                          [](const nscd::ContactVector& r) { return r.n > 0.0; }));
        candidates += static_cast<double>(result.impulses.size());
        contacts += loaded;
        sweeps += static_cast<double>(result.iterations);
        updates += loaded * static_cast<double>(result.iterations);
        converged += result.converged ? 1.0 : 0.0;
    }
};

nscd::Engine column_of(const Options& options) {
    if (options.spheres)
        return dense_spheres({.width = options.column.width, .agitation = options.column.agitation},
                             options.solver);
    return dense_column(options.column, options.solver);
}

Sample run(const Options& options) {
    nscd::Engine engine = column_of(options);
    const auto solver = nscd::make_solver("nlgs");
    StepClock whole, solve;
    Totals totals;
    for (int n = 0; n < options.warm_up + options.steps; ++n) {
        whole.start();
        engine.step(options.step);
        if (n >= options.warm_up) {
            whole.stop();
            solve.start();
            const nscd::SolverResult result =
                solver->solve(engine.problem(), engine.guess(), options.solver);
            solve.stop();
            totals.add(result);
        }
        engine.move(options.step);
    }
    const double steps = options.steps;
    Sample sample;
    sample.processor = solve.processor();
    sample.wall = solve.wall();
    sample.resident = resident_bytes();
    sample.parts = {{"step", whole.processor()}, {"solve", solve.processor()}};
    sample.counts = {{"grains", static_cast<double>(engine.bodies().size())},
                     {"candidates", totals.candidates / steps},
                     {"contacts", totals.contacts / steps},
                     {"sweeps", totals.sweeps / steps},
                     {"converged", totals.converged / steps},
                     {"rate", totals.updates / solve.processor_sum()},
                     {"wall rate", totals.updates / solve.wall_sum()}};
    return sample;
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"The worker of `turbidite bench contact`", "turbidite-bench-contact"};
    app.add_option("--width", options.column.width, "of the column [D]");
    app.add_flag("--spheres", options.spheres, "instead of discs");
    app.add_option("--shrink", options.column.shrink, "radii in [1 - shrink, 1] D/2");
    app.add_option("--agitation", options.column.agitation, "of velocities [sqrt(D g)]");
    app.add_option("--threads", options.solver.threads, "of the solver");
    app.add_option("--step", options.step, "dt [sqrt(D/g)]");
    app.add_option("--warm-up", options.warm_up, "steps before the timed ones");
    app.add_option("--steps", options.steps, "timed steps")->check(CLI::PositiveNumber);
    app.add_option("--tolerance", options.solver.tolerance, "of the natural map");
    app.add_option("--sweeps", options.solver.max_iterations, "at most, per step");
    app.add_option("--result", options.result, "file to write")->required();
    CLI11_PARSE(app, argc, argv);
    turbidite::keep_freed_memory();  // as the adapters do
    try {
        write_sample(turbidite::bench::run(options), options.result);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-contact: %s\n", error.what());
        return static_cast<int>(turbidite::ExitCode::participant_failed);
    }
    return 0;
}
