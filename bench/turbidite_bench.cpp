// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-bench [NAME]: runs the benchmarks; started by `turbidite bench`.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/timing/run_benchmark.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    std::string name;
    BenchOrder order;
    bool list = false;
};

void declare(CLI::App& app, Options& options) {
    app.add_option("NAME", options.name, "benchmark; all unless given");
    app.add_option("--figure", options.order.figures, "this figure only; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME");
    app.add_option("--json", options.order.json,
                   "also write the figures to FILE: name -> {value, unit, command}")
        ->type_name("FILE");
    app.add_flag("--quick", options.order.quick,
                 "tiny meshes, one repeat: tests that everything works; the figures mean nothing");
    app.add_flag("--list", options.list, "print the names of benchmarks and figures");
}

ExitCode run(Options options) {
    if (options.list) {
        fmt::print("{}", benchmark_overview());
        return ExitCode::done;
    }
    if (!options.name.empty()) options.order.benchmarks = {options.name};
    return run_benchmarks(options.order) ? ExitCode::done : ExitCode::tests_failed;
}

ExitCode bench_main(int argc, char** argv) {
    Options options;
    CLI::App app{"compare the speed of this software with others", "turbidite bench"};
    declare(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked_for = error.get_exit_code() == 0;  // --help
        app.exit(error);
        return asked_for ? ExitCode::done : ExitCode::bad_input;
    }
    return run(options);
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    using turbidite::ExitCode;
    try {
        return static_cast<int>(turbidite::bench::bench_main(argc, argv));
    } catch (const turbidite::Failure& failure) {
        std::fprintf(stderr, "%s\n", failure.what());
        return static_cast<int>(failure.code());
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite bench: %s\n", error.what());
        return static_cast<int>(ExitCode::participant_failed);
    }
}
