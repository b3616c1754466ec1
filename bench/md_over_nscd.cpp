// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/md_over_nscd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "bench/site.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

// Softer contacts and longer steps than by default, which leave a margin; the notes tell whether
// the accuracy was sufficient.
constexpr const char* cheap_md[] = {"contact.md_speed=15", "contact.md_substeps=16"};

constexpr double overlap_limit = 1e-3;   // [D]
constexpr double residual_limit = 1e-3;  // of the natural map

/// Columns of a run's history.csv; empty cells become NaN.
std::map<std::string, std::vector<double>> history(const std::filesystem::path& run) {
    std::ifstream file(run / "history.csv");
    std::string line, cell;
    std::getline(file, line);
    std::vector<std::string> names;
    for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(file, line)) {
        std::istringstream row(line + ",");
        for (std::size_t i = 0; i < names.size() && std::getline(row, cell, ','); ++i)
            columns[names[i]].push_back(cell.empty() ? NAN : std::stod(cell));
    }
    return columns;
}

/// wall_grains is the mean per window since the previous row.
double seconds_of_grains(const std::map<std::string, std::vector<double>>& columns) {
    const auto& steps = columns.at("step");
    const auto& seconds = columns.at("wall_grains");
    double sum = 0.0;
    for (std::size_t i = 1; i < steps.size(); ++i) sum += seconds[i] * (steps[i] - steps[i - 1]);
    return sum;
}

double percentile_95(std::vector<double> values) {
    values.erase(
        std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }),
        values.end());
    if (values.empty()) return NAN;
    std::sort(values.begin(), values.end());
    return values[static_cast<std::size_t>(0.95 * static_cast<double>(values.size() - 1))];
}

/// The natural map is known for windows with output; the interval selects them.
Sample column(Site& site, const std::string& adapter, const std::string& interval) {
    const std::filesystem::path run = site.folder() / adapter;
    std::vector<std::string> line{site.programs().folder / "turbidite",
                                  "run",
                                  site.programs().source / "configs/avalanche-dry.yaml",
                                  "--force",
                                  "--out",
                                  run.string()};
    std::vector<std::string> sets{"grains.adapter=" + adapter, "output.interval=" + interval};
    if (site.quick()) sets.insert(sets.end(), {"grains.region=[5,8]", "time.end=0.2"});
    if (adapter == "yade-md") sets.insert(sets.end(), std::begin(cheap_md), std::end(cheap_md));
    for (const std::string& set : sets) line.insert(line.end(), {"--set", set});
    site.run(line, adapter + ".log");
    const auto columns = history(run);
    const auto record = nlohmann::json::parse(std::ifstream(run / "run.json"));
    Sample sample;
    sample.wall = seconds_of_grains(columns);
    sample.counts = {{"overlap", record.at("maxima").at("penetration").get<double>()},
                     {"residual", percentile_95(columns.at("contact_residual"))},
                     {"iterations", columns.at("contact_iterations").back()}};
    fmt::print(stderr, "  {}: {:.4g} s\n", adapter, sample.wall);
    return sample;
}

std::string verdict(double value, double limit) {
    return value <= limit ? "kept" : "EXCEEDED: the ratio compares unequal results";
}

}  // namespace

Measured md_over_nscd_dry_column(Site& site) {
    const Duel duel = alternate(
        1, [&] { return column(site, "yade-md", "1"); },
        [&] { return column(site, "yade-nscd", "0.01"); });
    Measured measured = ratio(duel, [](const Sample& sample) { return sample.wall; });
    const Sample &md = duel.first[0], &nscd = duel.second[0];
    measured.notes = {
        fmt::format("yade-md {:.4g} s, {:.0f} sub-steps per window, overlaps at most {:.2g} D: "
                    "1e-3 D {}",
                    md.wall, md.counts.at("iterations"), md.counts.at("overlap"),
                    verdict(md.counts.at("overlap"), overlap_limit)),
        fmt::format("yade-nscd {:.4g} s, overlaps at most {:.2g} D, 95th percentile of the natural "
                    "map {:.2g}: 1e-3 {}",
                    nscd.wall, nscd.counts.at("overlap"), nscd.counts.at("residual"),
                    verdict(nscd.counts.at("residual"), residual_limit))};
    return measured;
}

}  // namespace turbidite::bench
