// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/fluid/space_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "bench/coupling/coupling_figures.hpp"
#include "bench/fluid/fluid_samples.hpp"
#include "bench/timing/contenders.hpp"
#include "bench/timing/run_history.hpp"

namespace turbidite::bench {
namespace {

int turns(const Site& site) {
    return site.quick() ? 1 : 3;
}

/// A million cells; 8000 for trials.
BenchBox box(const Site& site, int spheres) {
    if (site.quick()) return {2.5, 2.5, std::min(spheres, 1), 2.5};
    return {10.0, 20.0, spheres, 10.0};
}

Measured icofoam_over_ours(Site& site) {
    const Effort steps = site.quick() ? Effort{5, 60} : Effort{1, 2};
    const Effort windows = site.quick() ? Effort{2, 3} : Effort{5, 10};
    const Duel duel = alternate(
        turns(site), [&] { return icofoam_step(site, box(site, 0), steps); },
        [&] { return our_window(site, box(site, 300), windows); });
    Measured measured = ratio(duel, processor);
    measured.notes = {milliseconds("icoFoam", duel.first), profile(duel.second)};
    return measured;
}

Measured cells_over_plane(Site& site) {
    const BenchBox space = box(site, 0);
    const BenchBox plane = site.quick() ? BenchBox{2.5, 5.0} : BenchBox{20.0, 60.0};
    const Effort windows = site.quick() ? Effort{2, 3} : Effort{3, 10};
    const Duel duel = alternate(
        turns(site), [&] { return our_window(site, space, windows); },
        [&] { return our_window(site, plane, windows); });
    Measured measured = ratio(duel, processor);
    divide(measured, space.cells() / plane.cells());
    measured.notes = {per_cell(space.name(), space.cells(), duel.first),
                      per_cell(plane.name(), plane.cells(), duel.second), profile(duel.first)};
    return measured;
}

Measured cell_cost_growth(Site& site) {
    const BenchBox large =
        site.quick() ? BenchBox{5.0, 5.0, 0, 2.5} : BenchBox{20.0, 40.0, 0, 25.0};
    const BenchBox small = site.quick() ? BenchBox{2.5, 2.5, 0, 2.5} : BenchBox{7.5, 10.0, 0, 5.0};
    const Duel duel = alternate(
        turns(site),
        [&] {
            return our_window(site, large, {2, 3});
        },
        [&] {
            return our_window(site, small, {5, 20});
        });
    Measured measured = ratio(duel, processor);
    divide(measured, large.cells() / small.cells());
    measured.notes = {per_cell(large.name(), large.cells(), duel.first),
                      per_cell(small.name(), small.cells(), duel.second)};
    return measured;
}

/// The shipped case, begun with the spheres where they are after 10 t_c; a box of 5 x 5 x 5 D for
/// trials.
SpaceCase shipped(const Site& site, const std::string& name, std::vector<std::string> sets = {}) {
    if (!site.quick()) {
        sets.push_back("grains.overlap=1e-5");  // of the run from which the file is
        return {name, "mid_fall_spheres.csv", std::move(sets)};
    }
    sets.insert(sets.end(), {"domain.size=[5,5,5]", "grains.count=8"});
    return {name, "", std::move(sets)};
}

/// Mid-run requires a developed flow: one t_c before the clock starts.
Effort mid_run(const Site& site) {
    return site.quick() ? Effort{2, 3} : Effort{100, 10};
}

Measured bytes_per_cell(Site& site) {
    const bool quick = site.quick();
    const auto sized = [&](const char* name, const char* size) {
        return SpaceCase{name, "", {std::string("domain.size=") + size, "grains.count=8"}};
    };
    const SpaceCase large = sized("large", quick ? "[6,6,6]" : "[18,24,18]");
    const SpaceCase small = sized("small", quick ? "[5,5,5]" : "[9,24,9]");
    const double cells = 512.0 * (quick ? 216.0 - 125.0 : 24.0 * (324.0 - 81.0));
    const Duel duel = alternate(
        1,
        [&] {
            return settling_window(site, large, {2, 1});
        },
        [&] {
            return settling_window(site, small, {2, 1});
        });
    Measured measured;
    measured.value = (median_of(duel.first, resident) - median_of(duel.second, resident)) / cells;
    measured.lowest = measured.highest = measured.value;
    measured.notes = {
        fmt::format("growth of resident memory with {:.3g} cells more, of the "
                    "shipped case with few spheres",
                    cells)};
    return measured;
}

/// Of the largest program of a whole run, the fluid, with its checkpoints, slices and fields.
double peak_of_box_program(Site& site, const std::string& name, const std::string& size) {
    ::setenv("TURBIDITE_REPORT", "off", 1);
    return site.peak_memory_of(
        {site.programs().folder / "turbidite", "run",
         site.source("../configs/settling-spheres.yaml"), "--out", site.folder() / name, "--set",
         "fluid.program=box", "--set", "grains.adapter=standalone-nscd", "--set", "grains.count=8",
         "--set", "domain.size=" + size, "--set", "time.end=0.03", "--set", "output.interval=0.03"},
        name + ".log");
}

Measured bytes_per_cell_of_box(Site& site) {
    const bool quick = site.quick();
    const double large = peak_of_box_program(site, "box-large", quick ? "[6,6,6]" : "[18,24,18]");
    const double small = peak_of_box_program(site, "box-small", quick ? "[5,5,5]" : "[9,24,9]");
    const double cells = 512.0 * (quick ? 216.0 - 125.0 : 24.0 * (324.0 - 81.0));
    Measured measured;
    measured.value = measured.lowest = measured.highest = (large - small) / cells;
    measured.notes = {fmt::format("growth of the peak of a run with {:.3g} cells more", cells)};
    return measured;
}

Measured explicit_over_plain(Site& site) {
    const SpaceCase corrected = shipped(site, "explicit");
    const SpaceCase plain = shipped(site, "plain", {"fluid.splitting=marchuk-yanenko"});
    const Duel duel = alternate(
        turns(site), [&] { return settling_window(site, corrected, mid_run(site)); },
        [&] { return settling_window(site, plain, mid_run(site)); });
    Measured measured = ratio(duel, processor);
    measured.notes = {milliseconds("explicit-multiplier", duel.first), profile(duel.first),
                      milliseconds("marchuk-yanenko", duel.second), profile(duel.second)};
    return measured;
}

Measured speedup_2_ranks(Site& site) {
    SpaceCase one = shipped(site, "settled");
    if (!site.quick()) one.grains = "settled_spheres.csv";  // after 30 t_c
    SpaceCase two = one;
    two.ranks = 2;
    const Effort effort = site.quick() ? Effort{2, 3} : Effort{20, 10};
    const Duel duel = alternate(
        turns(site), [&] { return settling_window(site, one, effort); },
        [&] { return settling_window(site, two, effort); });
    Measured measured = ratio(duel, wall);
    measured.notes = {"on one rank: " + profile(duel.first),
                      "on the first of two: " + profile(duel.second)};
    return measured;
}

Measured settling_coupling_share(Site& site) {
    std::vector<std::string> changes = shipped(site, "share").changes(site);
    changes.insert(changes.end(),
                   {"output.interval=0.1", site.quick() ? "time.end=0.3" : "time.end=2"});
    const RunHistory history =
        read_history(play_case(site, "settling-spheres.yaml", "share", changes));
    Measured measured;
    measured.value = 100.0 * coupling_share(history, site.quick() ? 0.0 : 1.0);
    measured.lowest = measured.highest = measured.value;
    measured.notes = {fmt::format(
        "last row: window {:.3g} ms, fluid {:.3g} ms, grains {:.3g} ms, coupler {:.3g} ms",
        1e3 * history.at("wall_step").back(), 1e3 * history.at("wall_fluid").back(),
        1e3 * history.at("wall_grains").back(), 1e3 * history.at("wall_coupling").back())};
    return measured;
}

}  // namespace

std::vector<Figure> space_figures() {
    using Kind = Reach::Kind;
    return {
        {"icofoam_over_ours_3d",
         "a step of icoFoam (GAMG, 2 correctors, 1e-7) over our window with 300 spheres, 80 x 160 "
         "x 80 cells",
         "ratio",
         {Kind::at_least, 20.0},
         icofoam_over_ours},
        {"cells_space_over_plane",
         "time per cell of our window without grains, 80 x 160 x 80 cells over 320 x 960",
         "ratio",
         {Kind::at_most, 3.5},
         cells_over_plane},
        {"cell_cost_growth_space",
         "time per cell of 160 x 320 x 200 cells over that of 60 x 80 x 40",
         "ratio",
         {Kind::at_most, 1.4},
         cell_cost_growth},
        {"bytes_per_cell_space",
         "growth of the fluid program's resident memory, settling-spheres.yaml",
         "bytes",
         {Kind::at_most, 1150.0},
         bytes_per_cell},
        {"bytes_per_cell_space_box",
         "growth of the box program's peak of resident memory in whole runs of that case",
         "bytes",
         {Kind::at_most, 260.0},
         bytes_per_cell_of_box},
        {"explicit_over_plain_space",
         "fluid side of a window of the shipped settling spheres in mid-fall, explicit-multiplier "
         "over the paper's splitting",
         "ratio",
         {Kind::at_most, 1.7},
         explicit_over_plain},
        {"fluid_speedup_2_ranks_space",
         "wall time of the fluid side in that case with a settled bed, 1 rank over 2",
         "ratio",
         {Kind::at_least, 1.6},
         speedup_2_ranks},
        {"coupling_share_space",
         "share of a window's wall time in coupler and messages, that case in mid-fall",
         "%",
         {Kind::at_most, 5.0},
         settling_coupling_share},
    };
}

}  // namespace turbidite::bench
