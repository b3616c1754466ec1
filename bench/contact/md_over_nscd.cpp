// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/contact/md_over_nscd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "bench/timing/run_history.hpp"
#include "bench/timing/site.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

// Times are compared at equal accuracy: molecular dynamics gets the softest springs, hence the
// longest sub-steps, whose largest overlap of the whole run is just within the limit.
constexpr double overlap_limit = 1e-3;   // [D]
constexpr double residual_limit = 1e-3;  // of the natural map

// Springs are accepted when the largest overlap is between these fractions of the limit. Otherwise
// the run is repeated with others: k ~ md_speed^2, and the overlap of an impact falls as 1/sqrt(k)
// (docs/md.md).
constexpr double least_used = 0.8;
constexpr double aimed_at = 0.9;
constexpr int most_runs = 4;
constexpr double first_speed = 7.0;  // contact.md_speed [u_c]

constexpr const char* coarse_substeps = "contact.md_substeps=16";

/// wall_grains is the mean per window since the previous row.
double seconds_of_grains(const RunHistory& columns) {
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
Sample column(Site& site, const std::string& adapter, const std::string& interval,
              const std::vector<std::string>& springs = {}) {
    std::vector<std::string> sets{"grains.adapter=" + adapter, "output.interval=" + interval};
    if (site.quick()) sets.insert(sets.end(), {"grains.region=[5,8]", "time.end=0.2"});
    sets.insert(sets.end(), springs.begin(), springs.end());
    const std::filesystem::path run = play_case(site, "avalanche-dry.yaml", adapter, sets);
    const RunHistory columns = read_history(run);
    const auto record = nlohmann::json::parse(std::ifstream(run / "run.json"));
    Sample sample;
    sample.wall = seconds_of_grains(columns);
    sample.counts = {{"overlap", record.at("maxima").at("penetration").get<double>()},
                     {"residual", percentile_95(columns.at("contact_residual"))},
                     {"iterations", columns.at("contact_iterations").back()}};
    fmt::print(stderr, "  {}: {:.4g} s\n", adapter, sample.wall);
    return sample;
}

bool uses_limit(double overlap) {
    return overlap >= least_used * overlap_limit && overlap <= overlap_limit;
}

/// The run with the softest springs that keep the overlap limit.
Sample softest_md(Site& site) {
    double speed = first_speed;
    for (int run = 1;; ++run) {
        Sample sample =
            column(site, "yade-md", "1",
                   {fmt::format("contact.md_speed={:.4g}", speed), std::string(coarse_substeps)});
        const double overlap = sample.counts.at("overlap");
        sample.counts["speed"] = speed;
        fmt::print(stderr, "  yade-md: springs for {:.4g} u_c, overlaps at most {:.2g} D\n", speed,
                   overlap);
        if (uses_limit(overlap) || site.quick()) return sample;
        if (run == most_runs)
            throw Failure(
                ExitCode::tests_failed,
                fmt::format("no springs were found whose overlaps use the limit: {:.2g} D "
                            "of {:.2g} in the last run",
                            overlap, overlap_limit));
        speed *= overlap / (aimed_at * overlap_limit);
    }
}

std::string verdict(double value, double limit) {
    return value <= limit ? "kept" : "EXCEEDED: the ratio compares unequal results";
}

}  // namespace

Measured md_over_nscd_dry_column(Site& site) {
    const Duel duel = alternate(
        1, [&] { return softest_md(site); }, [&] { return column(site, "yade-nscd", "0.01"); });
    Measured measured = ratio(duel, [](const Sample& sample) { return sample.wall; });
    const Sample &md = duel.first[0], &nscd = duel.second[0];
    measured.notes = {
        fmt::format("yade-md {:.4g} s, springs for {:.3g} u_c, {:.0f} sub-steps per window, "
                    "overlaps at most {:.2g} D: 1e-3 D {}",
                    md.wall, md.counts.at("speed"), md.counts.at("iterations"),
                    md.counts.at("overlap"), verdict(md.counts.at("overlap"), overlap_limit)),
        fmt::format("yade-nscd {:.4g} s, overlaps at most {:.2g} D, 95th percentile of the natural "
                    "map {:.2g}: 1e-3 {}",
                    nscd.wall, nscd.counts.at("overlap"), nscd.counts.at("residual"),
                    verdict(nscd.counts.at("residual"), residual_limit))};
    return measured;
}

}  // namespace turbidite::bench
