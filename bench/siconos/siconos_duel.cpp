// SPDX-License-Identifier: GPL-3.0-or-later
//
// turbidite-bench-siconos: solvers of Siconos and ours on the same contact problems, a column of
// discs or of spheres at several times. All start from zero impulses and stop at the same error
// measure; at the end Siconos' own function evaluates all answers.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/contact/dense_packing.hpp"
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
    bool in_space = false;
    double shrink = 1e-3;  // of spheres
    std::vector<std::string> siconos = {"nsgs"};
    std::vector<double> times = {2.0, 9.0, 14.0};  // [t_c]
    double tolerance = 1e-4;
    std::vector<std::string> solvers = {"nlgs"};
    int repeats = 5;
    std::string told = "neither";
    std::string result;

    bool siconos_is_told() const { return told != "neither"; }
    bool ours_are_told() const { return told == "both"; }
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

/// The fewest iterations that are enough, by bisection; `most_iterations` or more if none are.
template <class Enough>
int fewest(const Enough& enough) {
    int many = 1;
    while (many < most_iterations && !enough(many)) many *= 2;
    for (int few = many / 2; many - few > 1;) {
        const int middle = (few + many) / 2;
        (enough(middle) ? many : few) = middle;
    }
    return many;
}

/// One of Siconos' solvers. Told how many iterations it needs, it does not stop before.
struct Rival {
    std::string solver;
    double tolerance;
    int iterations = most_iterations;
    Contender contender = {};

    siconos::Solution solve(const siconos::Problem& judge) const {
        return judge.solve(solver, tolerance, iterations);
    }
};

Rival rival_of(const siconos::Problem& judge, const std::string& solver, const Options& options) {
    if (!options.siconos_is_told()) return {solver, options.tolerance};
    Rival rival{solver, 1e-2 * options.tolerance};
    rival.iterations = fewest([&](int n) {
        const Rival trial{solver, rival.tolerance, n};
        return judge.error(trial.solve(judge).impulses) <= options.tolerance;
    });
    return rival;
}

void siconos_turn(Rival& rival, const siconos::Problem& judge, const Options& options) {
    const double start = processor_seconds();
    const siconos::Solution s = rival.solve(judge);
    const double seconds = processor_seconds() - start;
    const bool reached = judge.error(s.impulses) <= options.tolerance;
    take(rival.contender, judge, seconds, s.iterations,
         options.siconos_is_told() ? reached : s.converged, s.impulses);
}

/// One of our solvers, likewise.
struct Own {
    std::unique_ptr<const nscd::ContactSolver> solver;
    int iterations = most_iterations;
    Contender contender = {};

    siconos::Stopped sweep(const nscd::ContactProblem& problem) const {
        nscd::SolverSettings settings;
        settings.tolerance = 1e-12;
        settings.max_iterations = iterations;
        nscd::SolverResult found =
            solver->solve(problem, nscd::Impulses(problem.contacts.size()), settings);
        return {std::move(found.impulses), found.iterations, 0.0, true};
    }
};

Own own_of(const nscd::ContactProblem& problem, const std::string& solver, const Options& options) {
    Own own{nscd::make_solver(solver)};
    if (options.ours_are_told())
        own.iterations = fewest([&](int n) {
            own.iterations = n;
            return siconos::error_measure(problem, own.sweep(problem).impulses) <=
                   options.tolerance;
        });
    return own;
}

void our_turn(Own& own, const siconos::Problem& judge, const nscd::ContactProblem& problem,
              const Options& options) {
    const double start = processor_seconds();
    const siconos::Stopped s =
        options.ours_are_told()
            ? own.sweep(problem)
            : siconos::solve_to_measure(*own.solver, problem, options.tolerance, most_iterations);
    const double seconds = processor_seconds() - start;
    const std::vector<double> impulses = siconos::flat(s.impulses, judge.dimension());
    // By Siconos' function, which agrees with our measure to rounding.
    const bool reached = judge.error(impulses) <= options.tolerance * (1.0 + 1e-9);
    take(own.contender, judge, seconds, s.iterations, s.converged && reached, impulses);
}

/// The contenders in turns, A B A B.
nlohmann::ordered_json duel(const nscd::ContactProblem& problem, const Options& options) {
    const siconos::Problem judge(problem, {});
    std::vector<Rival> rivals;
    for (const std::string& solver : options.siconos)
        rivals.push_back(rival_of(judge, solver, options));
    std::vector<Own> ours;
    for (const std::string& solver : options.solvers)
        ours.push_back(own_of(problem, solver, options));
    for (int turn = 0; turn < options.repeats; ++turn) {
        for (Rival& rival : rivals) siconos_turn(rival, judge, options);
        for (Own& own : ours) our_turn(own, judge, problem, options);
    }
    nlohmann::ordered_json json = {{"contacts", problem.contacts.size()}};
    for (const Rival& rival : rivals) json["siconos-" + rival.solver] = rival.contender.json();
    for (std::size_t i = 0; i < ours.size(); ++i)
        json[options.solvers[i]] = ours[i].contender.json();
    return json;
}

nscd::Engine column(const Options& options) {
    if (!options.in_space) return dry_column(options.column);
    nscd::SolverSettings settings;
    settings.tolerance = options.column.tolerance;
    settings.max_iterations = 5000;
    return dense_spheres({.width = options.column.width, .shrink = options.shrink}, settings);
}

nlohmann::ordered_json run(const Options& options) {
    nscd::Engine engine = column(options);
    const double mass = engine.bodies().mass.front();
    // Masses are scaled by that of a grain, velocities by h g.
    const siconos::Scale scale{mass, options.column.step};
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    double now = 0.0;
    for (const double time : options.times) {
        play(engine, time - now, options.column.step);
        now = time;
        // The original column is not advanced by this.
        nscd::Engine probe = column(options);
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
    CLI::App app{"Siconos' solvers against ours on a column", "turbidite-bench-siconos"};
    app.add_flag("--spheres", options.in_space, "a column of spheres, twice as high as wide");
    app.add_option("--shrink", options.shrink, "their radii are in [1 - shrink, 1] D/2");
    app.add_option("--siconos", options.siconos, "solvers of Siconos, by name");
    app.add_option("--width", options.column.width, "of the column [D]");
    app.add_option("--height", options.column.height, "of the column [D]");
    app.add_option("--compacity", options.column.compacity, "of its lattice");
    app.add_option("--times", options.times, "when the problems are taken [t_c]");
    app.add_option("--tolerance", options.tolerance, "of Siconos' error measure");
    app.add_option("--solvers", options.solvers, "ours, by name");
    app.add_option("--repeats", options.repeats, "turns of each contender");
    app.add_option("--told", options.told,
                   "who is told beforehand how many iterations reach the error, the fewest; the "
                   "others stop by their own measures")
        ->check(CLI::IsMember({"neither", "siconos", "both"}));
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
