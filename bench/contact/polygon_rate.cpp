// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/contact/polygon_rate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/timing/site.hpp"

namespace turbidite::bench {
namespace {

Sample run_worker(Site& site, int rows, int steps) {
    const std::filesystem::path result = site.folder() / "polygons.json";
    site.run({site.programs().folder / "turbidite-bench-polygons", "--rows", std::to_string(rows),
              "--warm-up", "2", "--steps", std::to_string(steps), "--result", result.string()},
             "polygons.log");
    const Sample sample = read_sample(result);
    fmt::print(stderr, "  {} triangles: {:.3g} pair detections per second\n",
               sample.counts.at("triangles"), sample.counts.at("rate"));
    return sample;
}

double rate(const Sample& sample) {
    return sample.counts.at("rate");
}

std::string scene(const Sample& sample) {
    return fmt::format("{} triangles, {} pairs, {} of them within the alert distance, {} points",
                       sample.counts.at("triangles"), sample.counts.at("pairs"),
                       sample.counts.at("near"), sample.counts.at("points"));
}

}  // namespace

Measured polygon_detections_per_second(Site& site) {
    std::vector<Sample> samples;
    for (int i = 0; i < (site.quick() ? 1 : 5); ++i)
        samples.push_back(run_worker(site, site.quick() ? 10 : 60, site.quick() ? 3 : 50));
    const auto [lowest, highest] =
        std::minmax_element(samples.begin(), samples.end(),
                            [](const Sample& a, const Sample& b) { return rate(a) < rate(b); });
    Measured measured;
    measured.value = median_of(samples, rate);
    measured.lowest = rate(*lowest);
    measured.highest = rate(*highest);
    measured.notes = {
        scene(samples.front()),
        fmt::format("{:.3g} ns per pair; the broad phase takes another {:.3g} ns",
                    1e9 / measured.value,
                    1e9 * samples.front().parts.at("broad") / samples.front().counts.at("pairs"))};
    return measured;
}

}  // namespace turbidite::bench
