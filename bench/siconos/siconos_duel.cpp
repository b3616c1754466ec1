// SPDX-License-Identifier: GPL-3.0-or-later
//
// turbidite-bench-siconos: Siconos' NSGS and our solvers on the same contact problems, the dry
// column at several times. All start from zero impulses and stop at the same error measure; at the
// end Siconos' own function evaluates all answers.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/siconos/dry_column.hpp"
#include "bench/siconos/same_measure.hpp"
#include "bench/siconos/siconos_problem.hpp"
#include "bench/timing/step_clock.hpp"
#include "granular_adapter/nscd/solvers/solver_list.hpp"

namespace turbidite::bench {
namespace {

constexpr int most_iterations = 200000;

struct Options {
    DryColumn column;
    std::vector<double> times = {2.0, 9.0, 14.0};  // [t_c]
    double tolerance = 1e-4;
    std::vector<std::string> solvers = {"nlgs"};
    int repeats = 5;
    std::string result;
};

/// Times of one contender, and its error by Siconos' function.
struct Contender {
    std::vector<double> seconds;
    std::int64_t iterations = 0;
    double error = 0.0;
    bool converged = true;

    nlohmann::ordered_json json() const {
        return {{"seconds", seconds},
                {"iterations", iterations},
                {"error", error},
                {"converged", converged}};
    }
};

void take(Contender& contender, const siconos::Problem& judge, double seconds,
          std::int64_t iterations, bool converged, const std::vector<double>& impulses) {
    contender.seconds.push_back(seconds);
    contender.iterations = iterations;
    contender.converged = contender.converged && converged;
    contender.error = judge.error(impulses);
}

void siconos_turn(Contender& contender, const siconos::Problem& judge, double tolerance) {
    const double start = processor_seconds();
    const siconos::Solution s = judge.solve("nsgs", tolerance, most_iterations);
    take(contender, judge, processor_seconds() - start, s.iterations, s.converged, s.impulses);
}

void our_turn(Contender& contender, const siconos::Problem& judge,
              const nscd::ContactSolver& solver, const nscd::ContactProblem& problem,
              double tolerance) {
    const double start = processor_seconds();
    const siconos::Stopped s =
        siconos::solve_to_measure(solver, problem, tolerance, most_iterations);
    take(contender, judge, processor_seconds() - start, s.iterations, s.converged,
         siconos::flat(s.impulses, judge.dimension()));
}

/// The contenders in turns, A B A B.
nlohmann::ordered_json duel(const nscd::ContactProblem& problem, const Options& options) {
    const siconos::Problem judge(problem, {});
    Contender siconos;
    std::vector<Contender> ours(options.solvers.size());
    for (int turn = 0; turn < options.repeats; ++turn) {
        siconos_turn(siconos, judge, options.tolerance);
        for (std::size_t i = 0; i < ours.size(); ++i)
            our_turn(ours[i], judge, *nscd::make_solver(options.solvers[i]), problem,
                     options.tolerance);
    }
    nlohmann::ordered_json json = {{"contacts", problem.contacts.size()},
                                   {"siconos-nsgs", siconos.json()}};
    for (std::size_t i = 0; i < ours.size(); ++i) json[options.solvers[i]] = ours[i].json();
    return json;
}

nlohmann::ordered_json run(const Options& options) {
    nscd::Engine engine = dry_column(options.column);
    const double mass = engine.bodies().mass.front();
    // Masses are scaled by that of a grain, velocities by h g.
    const siconos::Scale scale{mass, options.column.step};
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    double now = 0.0;
    for (const double time : options.times) {
        play(engine, time - now, options.column.step);
        now = time;
        // The original column is not advanced by this.
        nscd::Engine probe = dry_column(options.column);
        probe.restore(engine.save());
        probe.step(options.column.step);
        json.push_back(duel(siconos::dimensionless(probe.problem(), scale), options));
        json.back()["time"] = time;
    }
    return json;
}

}  // namespace
}  // namespace turbidite::bench

int main(int argc, char** argv) {
    turbidite::bench::Options options;
    CLI::App app{"Siconos' NSGS against ours on the dry column", "turbidite-bench-siconos"};
    app.add_option("--width", options.column.width, "of the column [D]");
    app.add_option("--height", options.column.height, "of the column [D]");
    app.add_option("--compacity", options.column.compacity, "of its lattice");
    app.add_option("--times", options.times, "when the problems are taken [t_c]");
    app.add_option("--tolerance", options.tolerance, "of Siconos' error measure");
    app.add_option("--solvers", options.solvers, "ours, by name");
    app.add_option("--repeats", options.repeats, "turns of each contender");
    app.add_option("--result", options.result, "JSON file to write")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        std::ofstream file(options.result);
        file << turbidite::bench::run(options).dump(2) << "\n";
        if (!file.flush()) throw std::runtime_error(options.result + " cannot be written");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-bench-siconos: %s\n", error.what());
        return 1;
    }
    return 0;
}
