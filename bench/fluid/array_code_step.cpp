// SPDX-License-Identifier: GPL-2.0-or-later
//
// turbidite-bench-array-code: times the steps of the array code on a box given in D.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "bench/array_code/plane_flow.hpp"
#include "bench/fluid/start_flow.hpp"
#include "bench/timing/step_clock.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    int cells_per_diameter = 16, warm_up = 0, steps = 1;
    double width = 0.0, height = 0.0, reynolds = 36.0, step = 0.01;
    std::filesystem::path result;
};

void run(const Options& options) {
    array_code::FlowSetup setup;
    setup.spacing = 1.0 / options.cells_per_diameter;
    setup.nx = static_cast<int>(options.width * options.cells_per_diameter + 0.5);
    setup.ny = static_cast<int>(options.height * options.cells_per_diameter + 0.5);
    setup.viscosity = 1.0 / options.reynolds;
    setup.step = options.step;
    array_code::PlaneFlow flow(
        setup, [&](double x, double y) { return start_flow(options.width, options.height, x, y); });
    for (int n = 0; n < options.warm_up; ++n) flow.step();
    StepClock clock;
    for (int n = 0; n < options.steps; ++n) {
        clock.start();
        flow.step();
        clock.stop();
    }
    Sample sample;
    sample.processor = clock.processor();
    sample.wall = clock.wall();
    sample.resident = resident_bytes();
    sample.arrays = static_cast<double>(flow.bytes());
    write_sample(sample, options.result);
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"One contender of `turbidite bench fluid`", "turbidite-bench-array-code"};
    app.add_option("--width", options.width, "box [D]")->required();
    app.add_option("--height", options.height, "box [D]")->required();
    app.add_option("--cells-per-diameter", options.cells_per_diameter)->required();
    app.add_option("--reynolds", options.reynolds, "u_c D / nu")->required();
    app.add_option("--step", options.step, "dt [t_c]")->required();
    app.add_option("--warm-up", options.warm_up, "steps before the timed ones");
    app.add_option("--steps", options.steps, "timed steps");
    app.add_option("--result", options.result, "file to write")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        turbidite::bench::run(options);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-array-code: %s\n", error.what());
        return static_cast<int>(turbidite::ExitCode::participant_failed);
    }
    return 0;
}
