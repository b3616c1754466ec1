// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/coupling/coupling_figures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/coupling/coupling_play.hpp"
#include "bench/timing/site.hpp"
#include "coupler/protocol/failure.hpp"

namespace turbidite::bench {
namespace {

constexpr std::int64_t warm_up = 2;  // windows that touch memory for the first time

/// From window n's last message to the first of window n + 1: the coupler's checks, sums, output.
std::vector<double> between_windows(std::vector<Stamp> coupler) {
    for (Stamp& stamp : coupler)
        if (stamp.kind == Kind::window) --stamp.window;
    return delays(coupler, Kind::state, coupler, Kind::window, warm_up);
}

double microseconds(const std::vector<double>& seconds) {
    return 1e6 * median(seconds);
}

std::string range(const std::vector<double>& seconds) {
    std::vector<double> sorted = seconds;
    std::sort(sorted.begin(), sorted.end());
    const auto at = [&](double share) {
        return 1e6 *
               sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    };
    return fmt::format("{:.0f} us (a tenth below {:.0f}, a tenth above {:.0f})", at(0.5), at(0.1),
                       at(0.9));
}

Measured added_microseconds_1400(Site& site) {
    const int repeats = site.quick() ? 1 : 5;
    std::vector<double> medians;
    std::vector<std::string> notes;
    for (int i = 0; i < repeats; ++i) {
        const PlayedJob job =
            play_coupling(site, {.grains = 1400, .windows = site.quick() ? 10 : 1000});
        const auto& hub = job.coupler.stamps;
        const auto there = delays(hub, Kind::motion, hub, Kind::constraint, warm_up);
        const auto back = delays(hub, Kind::kicks, hub, Kind::kick, warm_up);
        const auto over_hops =
            delays(job.grains.stamps, Kind::motion, job.fluid.stamps, Kind::constraint, warm_up);
        medians.push_back(std::max(microseconds(there), microseconds(back)));
        const double bare =
            play_relay(site, bytes_of(hub, Kind::motion, warm_up), site.quick() ? 3 : 200);
        notes.push_back(fmt::format(
            "grains to fluid {}, back {}, between two windows {}; from program to program {:.0f} "
            "us, a bare relay {:.0f} us",
            range(there), range(back), range(between_windows(hub)), microseconds(over_hops),
            1e6 * bare));
    }
    const auto [lowest, highest] = std::minmax_element(medians.begin(), medians.end());
    return {median(medians), *lowest, *highest, notes};
}

Measured coupling_share_d16(Site& site) {
    std::vector<std::string> changes{
        "grains.file=" + std::filesystem::canonical(site.source("mid_fall.csv")).string(),
        "output.interval=0.5", "time.end=4"};
    if (site.quick()) changes.insert(changes.end(), {"fluid.cells_per_diameter=4", "time.end=1"});
    const double from = site.quick() ? 0.0 : 1.0;
    std::vector<double> shares;
    std::vector<std::string> notes;
    for (int i = 0; i < (site.quick() ? 1 : 3); ++i) {
        const RunHistory history =
            read_history(play_case(site, "sedimentation-discs.yaml", "mid-fall", changes));
        shares.push_back(100.0 * coupling_share(history, from));
        notes.push_back(fmt::format(
            "last row: window {:.2f} ms, fluid {:.2f} ms, grains {:.2f} ms, coupler {:.2f} ms",
            1e3 * history.at("wall_step").back(), 1e3 * history.at("wall_fluid").back(),
            1e3 * history.at("wall_grains").back(), 1e3 * history.at("wall_coupling").back()));
    }
    const auto [lowest, highest] = std::minmax_element(shares.begin(), shares.end());
    return {median(shares), *lowest, *highest, notes};
}

std::int64_t many(const Site& site) {
    return site.quick() ? 2000 : 1000000;
}

/// Both hops of the message that carries all grains.
Sample through_the_hub(Site& site) {
    const PlayedJob job = play_coupling(site, {.grains = many(site), .windows = 7});
    const auto& hub = job.coupler.stamps;
    Sample sample;
    sample.wall = median(
        delays(job.grains.stamps, Kind::motion, job.fluid.stamps, Kind::constraint, warm_up));
    sample.parts = {{"inside", median(delays(hub, Kind::motion, hub, Kind::constraint, warm_up))}};
    sample.counts = {{"bytes", static_cast<double>(bytes_of(hub, Kind::motion, warm_up))}};
    return sample;
}

Measured over_plain_mpi_1e6(Site& site) {
    double bytes = 0.0;
    const Duel duel = alternate(
        site.quick() ? 1 : 5,
        [&] {
            const Sample sample = through_the_hub(site);
            bytes = sample.counts.at("bytes");
            return sample;
        },
        [&] {
            Sample sample;
            sample.wall = play_relay(site, static_cast<std::int64_t>(bytes), 5);
            return sample;
        });
    const Quantity wall = [](const Sample& sample) { return sample.wall; };
    Measured measured = ratio(duel, wall);
    measured.notes = {fmt::format(
        "{:.0f} MB: through the hub {:.0f} ms, of which {:.0f} ms between the last byte in and the "
        "last byte out; bare relay {:.0f} ms",
        1e-6 * bytes, 1e3 * median_of(duel.first, wall),
        1e3 * median_of(duel.first, [](const Sample& s) { return s.parts.at("inside"); }),
        1e3 * median_of(duel.second, wall))};
    return measured;
}

double busiest(const Ranks& ranks) {
    double percent = 0.0;
    for (const Sample& sample : ranks.samples)
        percent = std::max(percent, 100.0 * sample.processor / sample.wall);
    return percent;
}

Measured waiting_cpu_percent(Site& site) {
    const PlayedJob job = play_coupling(site, {.grains = 300,
                                               .windows = site.quick() ? 4 : 40,
                                               .fluid_ranks = 4,
                                               .pause = site.quick() ? 0.05 : 0.25});
    const double fluid = busiest(job.fluid), coupler = busiest(job.coupler);
    const double worst = std::max(fluid, coupler);
    return {worst,
            std::min(fluid, coupler),
            worst,
            {fmt::format("while the grains take 0.25 s per window: the worst of four fluid ranks "
                         "{:.2f} %, the coupler {:.2f} %",
                         fluid, coupler)}};
}

/// One line of the table of sizes.
struct Size {
    std::int64_t grains;
    int ranks;  ///< of each program
};

PlayedJob played(Site& site, const Size& size, std::int64_t windows) {
    return play_coupling(site, {.grains = size.grains,
                                .windows = windows,
                                .fluid_ranks = size.ranks,
                                .grains_ranks = size.ranks});
}

std::string row(const Size& size, const PlayedJob& job, std::int64_t windows) {
    const Sample& coupler = job.coupler.samples.front();
    const double count = static_cast<double>(windows - 1), mega = 1e-6;
    const auto moved = [&](const Ranks& ranks) {
        return mega * (ranks.largest("sent") + ranks.largest("received"));
    };
    return fmt::format(
        "{} grains, {} + {} ranks: window {:.4g} ms, coupler's processor {:.4g} ms; MB moved per "
        "window and rank: coupler {:.3g}, fluid {:.3g}, grains {:.3g}; peak MB: coupler {:.0f}, "
        "fluid {:.0f}, grains {:.0f}",
        size.grains, size.ranks, size.ranks, 1e3 * coupler.wall / count,
        1e3 * coupler.processor / count, moved(job.coupler), moved(job.fluid), moved(job.grains),
        mega * job.coupler.largest_resident(), mega * job.fluid.largest_resident(),
        mega * job.grains.largest_resident());
}

Measured hub_growth_32_ranks(Site& site) {
    std::vector<Size> sizes{{2000, 1}, {2000, 4}};
    if (!site.quick())
        sizes = {{1000, 1},   {1000, 16},   {10000, 1},   {10000, 16},
                 {100000, 1}, {100000, 16}, {1000000, 1}, {1000000, 16}};
    Measured measured;
    std::vector<double> processor;
    for (const Size& size : sizes) {
        const std::int64_t windows = size.grains > 100000 ? 5 : 10;
        const PlayedJob job = played(site, size, windows);
        processor.push_back(job.coupler.samples.front().processor /
                            static_cast<double>(windows - 1));
        measured.notes.push_back(row(size, job, windows));
    }
    measured.value = processor.back() / processor[processor.size() - 2];
    measured.lowest = measured.highest = measured.value;
    return measured;
}

}  // namespace

double coupling_share(const RunHistory& history, double from) {
    if (!history.count("joint_rounds"))
        throw Failure(ExitCode::tests_failed, "the run did not use coupling.scheme: joint");
    const std::vector<double>&time = history.at("time"), &steps = history.at("step");
    double whole = 0.0, computing = 0.0;
    for (std::size_t i = 1; i < time.size(); ++i) {
        if (time[i] <= from) continue;
        const double windows = steps[i] - steps[i - 1];
        whole += windows * history.at("wall_step")[i];
        computing += windows * (history.at("wall_fluid")[i] + history.at("wall_grains")[i]);
    }
    return 1.0 - computing / whole;
}

std::vector<Figure> coupling_figures() {
    using Kind = Reach::Kind;
    return {
        {"added_microseconds_1400",
         "last byte in to last byte out at the coupler, 1400 grains, the slower direction",
         "us",
         {Kind::at_most, 100.0},
         added_microseconds_1400},
        {"coupling_share_d16",
         "share of a window in which neither side computes, sedimentation at D/16 in mid-fall",
         "%",
         {Kind::at_most, 2.0},
         coupling_share_d16},
        {"over_plain_mpi_1e6",
         "1e6 grains from program to program through the coupler over a bare MPI relay",
         "ratio",
         {Kind::at_most, 2.0},
         over_plain_mpi_1e6},
        {"waiting_cpu_percent",
         "processor time of the worst rank that waits",
         "%",
         {Kind::at_most, 3.0},
         waiting_cpu_percent},
        {"hub_growth_32_ranks",
         "the coupler's processor time with 1e6 grains on 16 + 16 ranks over that on 1 + 1",
         "ratio",
         {},
         hub_growth_32_ranks},
    };
}

}  // namespace turbidite::bench
