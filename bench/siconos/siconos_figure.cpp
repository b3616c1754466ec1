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
constexpr const char* theirs = "siconos-nsgs";

std::vector<std::string> line(const Site& site, const std::filesystem::path& result) {
    const std::filesystem::path program = site.programs().folder / "turbidite-bench-siconos";
    if (!std::filesystem::exists(program))
        throw Failure(ExitCode::tests_failed,
                      "not measured: Siconos is not installed (Debian package "
                      "libsiconos-numerics-dev; then remove build/release and build again)");
    std::vector<std::string> words{program, "--result", result, "--solvers", ours};
    if (site.quick())
        words.insert(words.end(),
                     {"--width", "6", "--height", "12", "--times", "0.5", "1", "--repeats", "1"});
    return words;
}

/// One problem: ratios of processor time, turn by turn.
std::vector<double> ratios(const nlohmann::json& problem) {
    std::vector<double> result;
    const auto first = problem.at(theirs).at("seconds").get<std::vector<double>>();
    const auto second = problem.at(ours).at("seconds").get<std::vector<double>>();
    for (std::size_t i = 0; i < first.size(); ++i) result.push_back(first[i] / second[i]);
    return result;
}

double milliseconds(const nlohmann::json& problem, const char* who) {
    return 1e3 * median(problem.at(who).at("seconds").get<std::vector<double>>());
}

double iterations(const nlohmann::json& problem, const char* who) {
    return problem.at(who).at("iterations").get<double>();
}

/// The ratio is the product of the ratios of time per iteration and of iterations.
std::string note(const nlohmann::json& problem) {
    const auto part = [&](const char* who) {
        const nlohmann::json& c = problem.at(who);
        return fmt::format("{} {:.4g} ms, {} iterations of {:.3g} ms, error {:.2g}{}", who,
                           milliseconds(problem, who), iterations(problem, who),
                           milliseconds(problem, who) / iterations(problem, who),
                           c.at("error").get<double>(),
                           c.at("converged").get<bool>() ? "" : " (not converged)");
    };
    const double ratio = median(ratios(problem));
    const double numbers = iterations(problem, theirs) / iterations(problem, ours);
    return fmt::format(
        "t = {:g} t_c, {} contacts: {}; {}; ratio {:.3g}: iterations {:.3g}, time per iteration "
        "{:.3g}",
        problem.at("time").get<double>(), problem.at("contacts").get<std::int64_t>(), part(theirs),
        part(ours), ratio, numbers, ratio / numbers);
}

}  // namespace

Measured siconos_over_ours(Site& site) {
    const std::filesystem::path result = site.folder() / "siconos.json";
    site.run(line(site, result), "siconos.log");
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

}  // namespace turbidite::bench
