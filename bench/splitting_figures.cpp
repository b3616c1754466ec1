// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/splitting_figures.hpp"

#include <fmt/format.h>

#include "bench/contenders.hpp"
#include "bench/run_history.hpp"
#include "bench/site.hpp"

namespace turbidite::bench {
namespace {

/// Part of a run of configs/avalanche.yaml.
struct Collapse {
    std::string compacity;
    double from, to;  ///< the windows that count [t_c]
};

std::vector<std::string> changes(const Site& site, const Collapse& collapse,
                                 const std::string& splitting) {
    std::vector<std::string> sets{"grains.compacity=" + collapse.compacity,
                                  "fluid.splitting=" + splitting,
                                  fmt::format("time.end={}", collapse.to), "output.interval=0.1"};
    if (site.quick()) sets.insert(sets.end(), {"grains.region=[4,4]", "domain.size=[12,8]"});
    return sets;
}

/// Mean of a column's rows after `from`.
double mean_after(const RunHistory& history, const char* name, double from) {
    const std::vector<double>& time = history.at("time");
    const std::vector<double>& values = history.at(name);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 1; i < time.size(); ++i)
        if (time[i] > from) sum += values[i], count += 1.0;
    return sum / count;
}

/// Wall time of fluid and contacts, which take turns under `joint`.
Sample window(Site& site, const Collapse& collapse, const std::string& splitting) {
    const RunHistory history = read_history(
        play_case(site, "avalanche.yaml", splitting, changes(site, collapse, splitting)));
    const auto mean = [&](const char* name) { return mean_after(history, name, collapse.from); };
    Sample sample;
    sample.wall = mean("wall_fluid") + mean("wall_grains");
    sample.parts = {{"fluid", mean("wall_fluid")}, {"contacts", mean("wall_grains")}};
    sample.counts = {{"multiplier iterations", mean("multiplier_iterations")},
                     {"rounds", mean("joint_rounds")},
                     {"speed", history.at("mean_velocity_norm").back()}};
    if (splitting != "marchuk-yanenko") {
        sample.counts["pressure iterations"] = mean("pressure_iterations");
        sample.counts["viscous iterations"] = mean("viscous_iterations");
    }
    return sample;
}

std::string details(const std::string& who, const std::vector<Sample>& samples) {
    std::string text = who + ":";
    for (const auto& [part, unused] : samples.front().parts)
        text += fmt::format(" {} {:.4g} ms,", part, 1e3 * median_of(samples, [&](const Sample& s) {
                                                        return s.parts.at(part);
                                                    }));
    for (const auto& [name, value] : samples.front().counts)
        text += fmt::format(" {} {:.4g}", name, value);
    return text;
}

Measured over_plain(Site& site, Collapse collapse, const std::string& splitting) {
    if (site.quick()) collapse = {collapse.compacity, 0.0, 0.2};
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return window(site, collapse, splitting); },
        [&] { return window(site, collapse, "marchuk-yanenko"); });
    Measured measured = ratio(duel, [](const Sample& sample) { return sample.wall; });
    measured.notes = {details(splitting, duel.first), details("marchuk-yanenko", duel.second)};
    return measured;
}

Measured explicit_over_plain(Site& site) {
    return over_plain(site, {"0.9069", 0.5, 1.5}, "explicit-multiplier");
}

Measured implicit_over_plain(Site& site) {
    return over_plain(site, {"0.7854", 2.0, 3.0}, "implicit-multiplier");
}

}  // namespace

std::vector<Figure> splitting_figures() {
    using Kind = Reach::Kind;
    return {
        {"explicit_over_plain",
         "window of the dense column of the avalanche (1397 discs, 800 x 480 cells), contacts "
         "included, explicit-multiplier over marchuk-yanenko",
         "ratio",
         {Kind::at_most, 1.1},
         explicit_over_plain},
        {"implicit_over_plain",
         "window of the loose column in mid-collapse, contacts included, implicit-multiplier over "
         "marchuk-yanenko",
         "ratio",
         {Kind::at_most, 3.0},
         implicit_over_plain},
    };
}

}  // namespace turbidite::bench
