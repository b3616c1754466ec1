// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/contact/contact_rate.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/timing/site.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite::bench {
namespace {

/// Parameters of one call of the worker program.
struct Order {
    double width = 0.0;  ///< of the column [D]
    int warm_up = 0, steps = 1;
    int sweeps = 2000;
    double tolerance = 1e-3;
    double agitation = 0.0;
    int threads = 1;
    bool spheres = false;
};

Sample run_worker(Site& site, const Order& order) {
    const std::filesystem::path result = site.folder() / "contact.json";
    std::vector<std::string> words = {site.programs().folder / "turbidite-bench-contact",
                                      "--width",
                                      fmt::format("{}", order.width),
                                      "--warm-up",
                                      std::to_string(order.warm_up),
                                      "--steps",
                                      std::to_string(order.steps),
                                      "--sweeps",
                                      std::to_string(order.sweeps),
                                      "--tolerance",
                                      fmt::format("{:g}", order.tolerance),
                                      "--agitation",
                                      fmt::format("{:g}", order.agitation),
                                      "--threads",
                                      std::to_string(order.threads),
                                      "--result",
                                      result.string()};
    if (order.spheres) words.push_back("--spheres");
    site.run(words, "contact.log");
    const Sample sample = read_sample(result);
    fmt::print(stderr, "  {} grains: {:.3g} contact-iterations per second\n",
               sample.counts.at("grains"), sample.counts.at("rate"));
    return sample;
}

double count(const std::vector<Sample>& samples, const std::string& name) {
    return median_of(samples, [&](const Sample& sample) { return sample.counts.at(name); });
}

double seconds(const std::vector<Sample>& samples, const std::string& part) {
    return median_of(samples, [&](const Sample& sample) { return sample.parts.at(part); });
}

std::string scene(const std::vector<Sample>& samples) {
    return fmt::format(
        "{} grains, {:.0f} contacts with an impulse, of {:.0f} candidates, {:.0f} sweeps",
        count(samples, "grains"), count(samples, "contacts"), count(samples, "candidates"),
        count(samples, "sweeps"));
}

std::string time_needed(const std::vector<Sample>& samples, const Order& order) {
    return fmt::format(
        "to natural map {:g}: {:.4g} ms, {:.0f} % of steps get there; whole step {:.4g} ms",
        order.tolerance, 1e3 * seconds(samples, "solve"), 100.0 * count(samples, "converged"),
        1e3 * seconds(samples, "step"));
}

Measured rate(Site& site, const Order& order, int repeats) {
    std::vector<Sample> samples;
    for (int i = 0; i < (site.quick() ? 1 : repeats); ++i)
        samples.push_back(run_worker(site, order));
    Measured measured;
    measured.value = count(samples, "rate");
    const auto [lowest, highest] = std::minmax_element(
        samples.begin(), samples.end(),
        [](const Sample& a, const Sample& b) { return a.counts.at("rate") < b.counts.at("rate"); });
    measured.lowest = lowest->counts.at("rate");
    measured.highest = highest->counts.at("rate");
    measured.notes = {scene(samples), time_needed(samples, order)};
    return measured;
}

/// Whole windows of spheres on ranks.
Sample sphere_windows(Site& site, double width, int ranks) {
    const std::filesystem::path result = site.folder() / "ranks.json";
    std::vector<std::string> words = mpirun_options(this_site());
    words.insert(words.end(), {"-n", std::to_string(ranks),
                               site.programs().folder / "turbidite-bench-sphere-ranks", "--width",
                               fmt::format("{}", width), "--warm-up", site.quick() ? "1" : "10",
                               "--steps", site.quick() ? "2" : "10", "--result", result});
    site.run(words, "ranks.log");
    const Sample sample = read_sample(result);
    fmt::print(stderr, "  {} ranks: {:.4g} s per window\n", ranks, sample.wall);
    return sample;
}

double cost(const Sample& sample) {
    return 1.0 / sample.counts.at("rate");
}

}  // namespace

Measured contact_rate_1397(Site& site) {
    if (site.quick()) return rate(site, {.width = 7.0, .warm_up = 5, .steps = 5}, 1);
    return rate(site, {.width = 25.0, .warm_up = 500, .steps = 100}, 5);
}

Measured contact_rate_50000(Site& site) {
    if (site.quick()) return rate(site, {.width = 21.2, .warm_up = 2, .steps = 2}, 1);
    return rate(site, {.width = 147.6, .warm_up = 20, .steps = 10}, 3);
}

// In mid-collapse: agitated until contacts are everywhere.
Measured contact_rate_spheres(Site& site) {
    Order order{.width = 26.3, .warm_up = 20, .steps = 5};
    order.agitation = 0.1;
    order.spheres = true;
    if (site.quick()) order.width = 6.0, order.warm_up = 5, order.steps = 2;
    return rate(site, order, 3);
}

// A fixed number of sweeps at both sizes, since large columns converge more slowly; with agitation,
// since otherwise contacts form everywhere only after many steps.
Measured contact_cost_growth(Site& site) {
    Order small{.width = 21.2, .warm_up = 2, .steps = site.quick() ? 2 : 50, .sweeps = 64};
    small.tolerance = 1e-12;
    small.agitation = 0.1;
    Order large = small;
    large.width = site.quick() ? 30.0 : 658.0;
    large.steps = 2;
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return run_worker(site, large); },
        [&] { return run_worker(site, small); });
    Measured measured = ratio(duel, cost);
    for (const auto* samples : {&duel.first, &duel.second})
        measured.notes.push_back(
            fmt::format("{}: {:.4g} ns", scene(*samples), 1e9 * median_of(*samples, cost)));
    return measured;
}

// 1e5 spheres, begun as an agitated lattice.
Measured grains_speedup_2_ranks(Site& site) {
    const double width = site.quick() ? 8.0 : 32.9;
    const Duel duel = alternate(
        site.quick() ? 1 : 3, [&] { return sphere_windows(site, width, 1); },
        [&] { return sphere_windows(site, width, 2); });
    Measured measured = ratio(duel, [](const Sample& sample) { return sample.wall; });
    measured.notes = {fmt::format(
        "{} spheres, {:.0f} sweeps: {:.4g} s on one rank, {:.4g} on two; {:.3g} us for an exchange",
        count(duel.first, "grains"), count(duel.first, "sweeps"),
        median_of(duel.first, [](const Sample& sample) { return sample.wall; }),
        median_of(duel.second, [](const Sample& sample) { return sample.wall; }),
        1e6 * seconds(duel.second, "phase"))};
    return measured;
}

}  // namespace turbidite::bench
