// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/fluid/splitting_figures.hpp"

#include <fmt/format.h>

#include "bench/timing/contenders.hpp"
#include "bench/timing/memory_triad.hpp"
#include "bench/timing/run_history.hpp"
#include "bench/timing/site.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"

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
    return over_plain(site, {"0.9069", 0.5, 1.5}, "implicit-multiplier");
}

Measured implicit_over_plain_loose(Site& site) {
    return over_plain(site, {"0.7854", 2.0, 3.0}, "implicit-multiplier");
}

/// The dense column at D/16 in the paper's box, with rows stretched above it, on two ranks.
std::vector<std::string> paper_box(const Site& site) {
    std::vector<std::string> sets{
        "fluid.ranks=2",         "fluid.cells_per_diameter=16", "domain.size=[250,100]",
        "fluid.stretch_from=55", "fluid.stretch_ratio=1.05",    "fluid.stretch_largest=32",
        "time.end=0.3",          "output.interval=0.3"};
    if (site.quick())
        sets.insert(sets.end(), {"grains.region=[4,4]", "domain.size=[12,12]",
                                 "fluid.stretch_from=6", "fluid.cells_per_diameter=8"});
    return sets;
}

double cells_of(const std::filesystem::path& run) {
    return fluid_cells(load_run_folder(run).settings);
}

/// The first 30 windows, from rest.
Measured avalanche_window_d16(Site& site) {
    const std::filesystem::path run = play_case(site, "avalanche.yaml", "paper", paper_box(site));
    const RunHistory history = read_history(run);
    constexpr double from = 0.0, bytes_per_cell = 100.0;
    const double fluid = mean_after(history, "wall_fluid", from);
    const double contacts = mean_after(history, "wall_grains", from);
    const double cells = cells_of(run), bandwidth = memory_triad();
    const double triad = cells * bytes_per_cell / bandwidth;
    Measured measured;
    measured.value = measured.lowest = measured.highest = (fluid + contacts) / triad;
    measured.notes = {
        fmt::format("{:.3g} million cells; window {:.4g} s: fluid {:.4g} s, contacts {:.4g} s",
                    1e-6 * cells, fluid + contacts, fluid, contacts),
        fmt::format("triad on one core {:.3g} GB/s, {:.4g} s for 100 bytes per cell",
                    1e-9 * bandwidth, triad)};
    return measured;
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
         "the same, implicit-multiplier over marchuk-yanenko",
         "ratio",
         {Kind::at_most, 3.0},
         implicit_over_plain},
        {"implicit_over_plain_loose",
         "the same of the loose column in mid-collapse",
         "ratio",
         {Kind::none, 0.0},
         implicit_over_plain_loose},
        {"avalanche_window_d16",
         "wall time of a window of the dense column at D/16 in the paper's box, with stretched "
         "rows and two ranks, over that of a memory triad on 100 bytes per cell",
         "ratio",
         {Kind::none, 0.0},
         avalanche_window_d16},
    };
}

}  // namespace turbidite::bench
