// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-bench-sphere-ranks: times whole windows of the contact engine with a dense column of
// spheres on the ranks that mpirun has started, and what it costs to exchange once.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "bench/contact/dense_packing.hpp"
#include "bench/timing/step_clock.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "coupler/transport/world.hpp"
#include "granular_adapter/nscd_ranks/mpi_exchange.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    SphereColumn column;
    double step = 0.01;
    int warm_up = 0, steps = 1;
    nscd::SolverSettings solver;
    std::filesystem::path result;
};

/// Every rank begins with an equal number of the bodies, whichever.
nscd::Engine column_of(const Options& options, nscd::RankExchange& ranks) {
    nscd::Engine engine = dense_spheres(options.column, options.solver);
    if (ranks.size() == 1) return engine;
    std::vector<std::uint8_t> mine;
    for (const GrainId id : engine.bodies().id) mine.push_back(id % ranks.size() == ranks.rank());
    engine.bodies().keep(mine);
    engine.share_with(ranks);
    return engine;
}

/// One window as the adapter plays it.
nscd::StepReport play(nscd::Engine& engine, double step) {
    const nscd::StepReport report = engine.step(step);
    engine.contact_violation();
    engine.move(step);
    engine.max_penetration_after_move();
    return report;
}

/// Wall time of a phase in which every rank gives every other one a thousand doubles [s].
double time_of_a_phase(nscd::RankExchange& ranks) {
    constexpr int turns = 2000;
    std::vector<std::size_t> doubles(static_cast<std::size_t>(ranks.size()), 1000);
    doubles[static_cast<std::size_t>(ranks.rank())] = 0;
    ranks.prepare(std::vector<nscd::RankExchange::Traffic>(8, {doubles, doubles}));
    const double start = wall_seconds();
    for (int turn = 0; turn < turns; ++turn) {
        const auto phase = static_cast<std::size_t>(turn % 8);
        ranks.post(phase);
        ranks.await(phase);
    }
    return (wall_seconds() - start) / turns;
}

Sample run(const Options& options, nscd::RankExchange& ranks) {
    Sample sample;
    sample.parts = {{"phase", time_of_a_phase(ranks)}};
    nscd::Engine engine = column_of(options, ranks);
    engine.max_penetration();
    StepClock whole;
    double sweeps = 0.0;
    for (int n = 0; n < options.warm_up + options.steps; ++n) {
        const bool timed = n >= options.warm_up;
        if (timed) whole.start();
        const nscd::StepReport report = play(engine, options.step);
        if (!timed) continue;
        whole.stop();
        sweeps += static_cast<double>(report.iterations);
    }
    sample.processor = whole.processor();
    sample.wall = whole.wall();
    sample.resident = resident_bytes();
    sample.counts = {{"grains", static_cast<double>(engine.bodies().size())},
                     {"sweeps", sweeps / options.steps}};
    return sample;
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    const turbidite::MpiEnvironment mpi(&argc, &argv);
    turbidite::bench::Options options;
    CLI::App app{"A worker of `turbidite bench contact`", "turbidite-bench-sphere-ranks"};
    app.add_option("--width", options.column.width, "of the column [D]");
    app.add_option("--agitation", options.column.agitation, "of velocities [sqrt(D g)]");
    app.add_option("--step", options.step, "dt [sqrt(D/g)]");
    app.add_option("--warm-up", options.warm_up, "steps before the timed ones");
    app.add_option("--steps", options.steps, "timed steps")->check(CLI::PositiveNumber);
    app.add_option("--sweeps", options.solver.max_iterations, "at most, per step");
    app.add_option("--result", options.result, "file to write")->required();
    CLI11_PARSE(app, argc, argv);
    turbidite::keep_freed_memory();  // as the adapters do
    try {
        turbidite::nscd::MpiExchange ranks(MPI_COMM_WORLD);
        const turbidite::bench::Sample sample = turbidite::bench::run(options, ranks);
        if (ranks.rank() == 0) write_sample(sample, options.result);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-sphere-ranks: %s\n", error.what());
        PMPI_Abort(MPI_COMM_WORLD, static_cast<int>(turbidite::ExitCode::participant_failed));
    }
    return 0;
}
