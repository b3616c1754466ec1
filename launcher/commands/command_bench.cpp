// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench [NAME]: side-by-side timings (bench/).
#include <fmt/format.h>

#include <memory>

#include "bench/run_benchmark.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/commands/command.hpp"

namespace turbidite {
namespace {

struct BenchOptions {
    std::string name;
    bench::BenchOrder order;
    bool list = false;
};

int run_bench(BenchOptions options) {
    if (options.list) {
        fmt::print("{}", bench::benchmark_overview());
        return static_cast<int>(ExitCode::done);
    }
    if (!options.name.empty()) options.order.benchmarks = {options.name};
    const bool complete = bench::run_benchmarks(options.order);
    return static_cast<int>(complete ? ExitCode::done : ExitCode::tests_failed);
}

}  // namespace

CommandAction declare_bench(CLI::App& app) {
    const auto options = std::make_shared<BenchOptions>();
    app.add_option("NAME", options->name, "benchmark; all unless given");
    app.add_option("--figure", options->order.figures, "this figure only; may be repeated")
        ->allow_extra_args(false)
        ->type_name("NAME");
    app.add_option("--json", options->order.json,
                   "also write the figures to FILE: name -> {value, unit, command}")
        ->type_name("FILE");
    app.add_flag("--quick", options->order.quick,
                 "tiny meshes, one repeat: shows that everything works, measures nothing");
    app.add_flag("--list", options->list, "print the names of benchmarks and figures");
    return [options] { return run_bench(*options); };
}

}  // namespace turbidite
