// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/siconos/siconos_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/timing/site.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

constexpr const char* ours = "nlgs";

std::vector<std::string> line(const Site& site, const std::filesystem::path& result,
                              const std::vector<std::string>& column,
                              const std::vector<std::string>& quick_column) {
    const std::filesystem::path program = site.programs().folder / "turbidite-bench-siconos";
    if (!std::filesystem::exists(program))
        throw Failure(ExitCode::tests_failed,
                      "not measured: this build has no Siconos (Debian package "
                      "libsiconos-numerics-dev; then configure and build again)");
    std::vector<std::string> words{program, "--result", result, "--solvers", ours};
    const std::vector<std::string>& more = site.quick() ? quick_column : column;
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

std::vector<double> seconds(const nlohmann::json& problem, const std::string& who) {
    return problem.at(who).at("seconds").get<std::vector<double>>();
}

/// The fastest solver of Siconos that reached the error.
std::string theirs(const nlohmann::json& problem) {
    std::string fastest;
    for (const auto& [who, contender] : problem.items())
        if (who.starts_with("siconos-") && contender.at("converged").get<bool>() &&
            (fastest.empty() || median(seconds(problem, who)) < median(seconds(problem, fastest))))
            fastest = who;
    if (fastest.empty())
        throw Failure(ExitCode::tests_failed, "no solver of Siconos reached the error");
    return fastest;
}

/// One problem: ratios of processor time, turn by turn.
std::vector<double> ratios(const nlohmann::json& problem) {
    std::vector<double> result;
    if (!problem.at(ours).at("converged").get<bool>())
        throw Failure(ExitCode::tests_failed, "our solver has not reached the error");
    const auto first = seconds(problem, theirs(problem)), second = seconds(problem, ours);
    for (std::size_t i = 0; i < first.size(); ++i) result.push_back(first[i] / second[i]);
    return result;
}

double milliseconds(const nlohmann::json& problem, const std::string& who) {
    return 1e3 * median(seconds(problem, who));
}

double iterations(const nlohmann::json& problem, const std::string& who) {
    return problem.at(who).at("iterations").get<double>();
}

/// The ratio is the product of the ratios of time per iteration and of iterations.
std::string note(const nlohmann::json& problem) {
    const auto part = [&](const std::string& who) {
        const nlohmann::json& c = problem.at(who);
        return fmt::format("{} {:.4g} ms, {} iterations of {:.3g} ms, error {:.2g}{}", who,
                           milliseconds(problem, who), iterations(problem, who),
                           milliseconds(problem, who) / iterations(problem, who),
                           c.at("error").get<double>(),
                           c.at("converged").get<bool>() ? "" : " (not converged)");
    };
    const double ratio = median(ratios(problem));
    const double numbers = iterations(problem, theirs(problem)) / iterations(problem, ours);
    return fmt::format(
        "t = {:g} t_c, {} contacts: {}; {}; ratio {:.3g}: iterations {:.3g}, time per iteration "
        "{:.3g}",
        problem.at("time").get<double>(), problem.at("contacts").get<std::int64_t>(),
        part(theirs(problem)), part(ours), ratio, numbers, ratio / numbers);
}

/// Of the problems in a file: geometric mean of the ratios.
Measured mean_ratio(const std::filesystem::path& result) {
    std::ifstream file(result);
    const nlohmann::json problems = nlohmann::json::parse(file);
    Measured measured;
    double sum = 0.0, low = 0.0, high = 0.0;
    for (const nlohmann::json& problem : problems) {
        const std::vector<double> each = ratios(problem);
        sum += std::log(median(each));
        low += std::log(*std::min_element(each.begin(), each.end()));
        high += std::log(*std::max_element(each.begin(), each.end()));
        measured.notes.push_back(note(problem));
    }
    const auto count = static_cast<double>(problems.size());
    measured.value = std::exp(sum / count);
    measured.lowest = std::exp(low / count);
    measured.highest = std::exp(high / count);
    return measured;
}

}  // namespace

Measured siconos_over_ours(Site& site) {
    const std::filesystem::path result = site.folder() / "siconos.json";
    site.run(line(site, result, {},
                  {"--width", "6", "--height", "12", "--times", "0.5", "1", "--repeats", "1"}),
             "siconos.log");
    return mean_ratio(result);
}

Measured spheres_over_siconos(Site& site) {
    const std::filesystem::path result = site.folder() / "siconos_spheres.json";
    // In space Siconos' Gauss-Seidel stops by the change of a sweep, at errors far below the
    // required one: neither side is to lose time with that.
    const std::vector<std::string> solvers{"--spheres",
                                           "--told",
                                           "both",
                                           "--siconos",
                                           "nsgs",
                                           "nsgs-newton",
                                           "nsgs-newton-frozen",
                                           "nsgs-iterated-projection"};
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.end(), solvers.begin(), solvers.end());
        return words;
    };
    site.run(line(site, result, with({"--width", "6", "--times", "1", "3", "6"}),
                  with({"--width", "3", "--times", "0.5", "1", "--repeats", "1"})),
             "siconos_spheres.log");
    return mean_ratio(result);
}

}  // namespace turbidite::bench
