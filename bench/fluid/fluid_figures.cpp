// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/fluid/fluid_figures.hpp"

#include <fmt/format.h>

#include "bench/fluid/fluid_samples.hpp"
#include "bench/timing/contenders.hpp"

namespace turbidite::bench {
namespace {

int repeats(const Site& site) {
    return site.quick() ? 1 : 5;
}

/// The full box of 320 x 960 cells; 40 x 80 cells for trials.
BenchBox tall_box(const Site& site, bool discs) {
    if (site.quick()) return {2.5, 5.0, discs ? 3 : 0};
    return {20.0, 60.0, discs ? 300 : 0};
}

Effort windows(const Site& site) {
    return site.quick() ? Effort{2, 3} : Effort{10, 20};
}

Measured icofoam_over_ours(Site& site) {
    const BenchBox box = tall_box(site, true);
    // icoFoam's clock has a resolution of 10 ms, so tiny meshes need many steps.
    const Effort steps = site.quick() ? Effort{5, 60} : Effort{3, 8};
    const Duel duel = alternate(
        repeats(site), [&] { return icofoam_step(site, tall_box(site, false), steps); },
        [&] { return our_window(site, box, windows(site)); });
    Measured measured = ratio(duel, processor);
    measured.notes = {milliseconds("icoFoam", duel.first), profile(duel.second)};
    return measured;
}

Measured ours_over_array_code(Site& site) {
    const BenchBox box = tall_box(site, false);
    const Duel duel = alternate(
        repeats(site), [&] { return our_window(site, box, windows(site)); },
        [&] { return array_code_step(site, box, windows(site)); });
    Measured measured = ratio(duel, processor);
    measured.notes = {milliseconds("array code", duel.second), profile(duel.first)};
    return measured;
}

Measured cell_cost_growth(Site& site) {
    const BenchBox large = site.quick() ? BenchBox{10.0, 10.0} : BenchBox{100.0, 250.0};
    const BenchBox small = site.quick() ? BenchBox{5.0, 5.0} : BenchBox{15.0, 20.0};
    const Effort few = site.quick() ? Effort{2, 3} : Effort{2, 6};
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return our_window(site, large, few); },
        [&] { return our_window(site, small, windows(site)); });
    Measured measured = ratio(duel, processor);
    divide(measured, large.cells() / small.cells());
    measured.notes = {per_cell(large.name(), large.cells(), duel.first),
                      per_cell(small.name(), small.cells(), duel.second), profile(duel.first)};
    return measured;
}

Measured speedup_2_ranks(Site& site) {
    const BenchBox box = tall_box(site, true);
    const Duel duel = alternate(
        repeats(site), [&] { return our_window(site, box, windows(site), 1); },
        [&] { return our_window(site, box, windows(site), 2); });
    Measured measured = ratio(duel, wall);
    measured.notes = {"on one rank: " + profile(duel.first),
                      "on the first of two: " + profile(duel.second)};
    return measured;
}

/// Mid-fall requires a developed flow: one t_c before the clock starts.
Effort mid_fall(const Site& site) {
    return site.quick() ? Effort{2, 3} : Effort{100, 30};
}

std::string work_done(const std::vector<Sample>& samples) {
    const auto median_count = [&](const char* name) {
        return median_of(samples, [&](const Sample& s) { return s.counts.at(name); });
    };
    return fmt::format("{} iterations of the multipliers per window, {} contacts",
                       median_count("multiplier iterations"), median_count("contacts"));
}

Measured joint_window_d16(Site& site) {
    const BenchBox box = tall_box(site, false);
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return mid_fall_window(site, mid_fall(site)); },
        [&] { return our_window(site, box, windows(site)); });
    Measured measured = ratio(duel, processor);
    measured.notes = {milliseconds("mid-fall", duel.first), profile(duel.first),
                      work_done(duel.first), milliseconds("without grains", duel.second),
                      profile(duel.second)};
    return measured;
}

Measured second_over_first_order(Site& site) {
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return mid_fall_window_in_order(site, mid_fall(site), true); },
        [&] { return mid_fall_window_in_order(site, mid_fall(site), false); });
    Measured measured = ratio(duel, processor);
    measured.notes = {milliseconds("second order", duel.first), profile(duel.first),
                      milliseconds("first order", duel.second), profile(duel.second)};
    return measured;
}

Measured joint_speedup_2_ranks(Site& site) {
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return mid_fall_window(site, mid_fall(site), 1); },
        [&] { return mid_fall_window(site, mid_fall(site), 2); });
    Measured measured = ratio(duel, wall);
    measured.notes = {"on one rank: " + profile(duel.first),
                      "on the first of two: " + profile(duel.second)};
    return measured;
}

Measured bytes_per_cell(Site& site) {
    const BenchBox large = site.quick() ? BenchBox{15.0, 15.0} : BenchBox{40.0, 120.0};
    const BenchBox small = site.quick() ? BenchBox{5.0, 5.0} : BenchBox{20.0, 60.0};
    const Duel duel = alternate(
        site.quick() ? 1 : 3,
        [&] {
            return our_window(site, large, {2, 1});
        },
        [&] {
            return our_window(site, small, {2, 1});
        });
    const Sample arrays = array_code_step(site, small, {0, 1});
    const double cells = large.cells() - small.cells();
    Measured measured;
    measured.value = (median_of(duel.first, resident) - median_of(duel.second, resident)) / cells;
    measured.lowest = measured.highest = measured.value;
    measured.notes = {
        fmt::format("growth of resident memory from {} to {} cells", small.cells(), large.cells()),
        "steps 1 to 3 need 40, five doubles: u (2), p (1), the difference of the face fluxes from "
        "the interpolated u (2)",
        fmt::format("the array code also stores u during transport (2) and all pivots (2): {:.1f} "
                    "with its ghosts",
                    arrays.arrays / small.cells())};
    return measured;
}

}  // namespace

std::vector<Figure> fluid_figures() {
    using Kind = Reach::Kind;
    return {
        {"icofoam_over_ours_2d",
         "a step of icoFoam (GAMG, 2 correctors, 1e-7) over our window with 300 discs, 320 x 960",
         "ratio",
         {Kind::at_least, 20.0},
         icofoam_over_ours},
        {"ours_over_array_code",
         "our window without grains over the same splitting in hand-written arrays, 320 x 960",
         "ratio",
         {Kind::at_most, 1.0},
         ours_over_array_code},
        {"cell_cost_growth",
         "time per cell of 1600 x 4000 cells over that of 240 x 320",
         "ratio",
         {Kind::at_most, 1.5},
         cell_cost_growth},
        {"speedup_2_ranks",
         "wall time of a window with 300 discs, 320 x 960, 1 rank over 2",
         "ratio",
         {Kind::at_least, 1.6},
         speedup_2_ranks},
        {"joint_window_d16",
         "fluid side of a window of the shipped sedimentation (joint, mid-fall, contacts) over our "
         "window without grains, 320 x 960",
         "ratio",
         {Kind::at_most, 1.8},
         joint_window_d16},
        {"second_over_first_order",
         "fluid side of that window, second order in time (LUST) over first (limitedLinearV)",
         "ratio",
         {Kind::at_most, 1.3},
         second_over_first_order},
        {"joint_speedup_2_ranks",
         "wall time of the fluid side in that window, 1 rank over 2",
         "ratio",
         {Kind::at_least, 1.6},
         joint_speedup_2_ranks},
        {"bytes_per_cell",
         "growth of the fluid program's resident memory",
         "bytes",
         {Kind::none, 0.0},
         bytes_per_cell},
    };
}

}  // namespace turbidite::bench
