// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-bench-tight: contact problems of the paper's dry column at several times, each solved
// from zero impulses to a tight tolerance. Prints one line per problem, for the table of
// docs/contact-solvers.md.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "bench/siconos/dry_column.hpp"
#include "bench/timing/step_clock.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::bench {
namespace {

struct Options {
    DryColumn column;
    std::vector<double> compacities = {0.9069, 0.85, 0.7854};
    std::vector<double> times = {0.1, 0.5, 2.0, 9.0, 14.0};  // [t_c]
    std::string solver = "central-path";
    nscd::SolverSettings settings{.tolerance = 1e-8, .max_iterations = 1000000};
};

/// The problem of the step after the column's present state; the column itself is not advanced.
nscd::ContactProblem next_problem(const nscd::Engine& column, const DryColumn& settings) {
    nscd::Engine probe = dry_column(settings);
    probe.restore(column.save());
    probe.step(settings.step);
    return probe.problem();
}

/// Solves and prints one line; false if the solver did not converge.
bool solve(const nscd::ContactProblem& problem, const Options& options, double time) {
    const auto solver = nscd::make_solver(options.solver);
    const double start = processor_seconds();
    const nscd::SolverResult result =
        solver->solve(problem, nscd::Impulses(problem.contacts.size()), options.settings);
    const double seconds = processor_seconds() - start;
    std::printf("%9.4f  %6.2f  %8zu  %10lld  %9.2f  %8.1e  %s\n", options.column.compacity, time,
                problem.contacts.size(), static_cast<long long>(result.iterations), seconds,
                result.residual, result.converged ? "yes" : "no");
    std::fflush(stdout);
    return result.converged;
}

/// Runs all times for one compacity.
bool solve_column(const Options& options) {
    nscd::Engine column = dry_column(options.column);
    double now = 0.0;
    bool all = true;
    for (const double time : options.times) {
        play(column, time - now, options.column.step);
        now = time;
        all = solve(next_problem(column, options.column), options, time) && all;
    }
    return all;
}

bool run(Options options) {
    std::printf("compacity     t_c  contacts  iterations  seconds    residual  solved\n");
    bool all = true;
    for (const double compacity : options.compacities) {
        options.column.compacity = compacity;
        all = solve_column(options) && all;
    }
    return all;
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"Contact problems of the dry column to a tight tolerance",
                 "turbidite-bench-tight"};
    app.add_option("--width", options.column.width, "of the column [D]");
    app.add_option("--height", options.column.height, "of the column [D]");
    app.add_option("--compacities", options.compacities, "of its lattices");
    app.add_option("--times", options.times, "when the problems are taken, ascending [t_c]");
    app.add_option("--solver", options.solver, "by its name in contact.solver");
    app.add_option("--tolerance", options.settings.tolerance, "scaled natural map");
    app.add_option("--iterations", options.settings.max_iterations, "sweeps and factorisations");
    CLI11_PARSE(app, argc, argv);
    try {
        return turbidite::bench::run(options) ? 0 : 2;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-tight: %s\n", error.what());
        return 1;
    }
}
