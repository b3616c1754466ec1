// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/coupling/coupling_play.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "bench/timing/site.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite::bench {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

void append(Words& to, const Words& more) {
    to.insert(to.end(), more.begin(), more.end());
}

std::string program(const Site& site) {
    return (site.programs().folder / "turbidite-bench-coupling").string();
}

fs::path fresh_folder(const Site& site) {
    const fs::path folder = site.folder() / "coupling";
    fs::remove_all(folder);
    fs::create_directories(folder / "logs");
    return folder;
}

Ranks results(const fs::path& folder, const std::string& role, int ranks) {
    Ranks all;
    for (int rank = 0; rank < ranks; ++rank) {
        const std::string name = (folder / fmt::format("{}.{}", role, rank)).string();
        const std::vector<Stamp> stamps = read_stamps(name + ".stamps");
        all.stamps.insert(all.stamps.end(), stamps.begin(), stamps.end());
        all.samples.push_back(read_sample(name + ".json"));
    }
    return all;
}

}  // namespace

double Ranks::largest(const std::string& count) const {
    double result = 0.0;
    for (const Sample& sample : samples) result = std::max(result, sample.counts.at(count));
    return result;
}

double Ranks::largest_resident() const {
    double result = 0.0;
    for (const Sample& sample : samples) result = std::max(result, sample.resident);
    return result;
}

PlayedJob play_coupling(Site& site, const CouplingJob& job) {
    const fs::path folder = fresh_folder(site);
    Words line = mpirun_options(this_site());
    const auto add = [&](int ranks, const std::string& role, const Words& more) {
        append(line, {"-n", std::to_string(ranks), program(site), role, folder.string()});
        append(line, more);
        append(line, {"--grains", std::to_string(job.grains), "--windows",
                      std::to_string(job.windows), "--fluid-ranks", std::to_string(job.fluid_ranks),
                      "--grains-ranks", std::to_string(job.grains_ranks)});
    };
    add(1, "coupler", {site.source("coupling.yaml").string()});
    line.push_back(":");
    add(job.fluid_ranks, "fluid", {});
    line.push_back(":");
    add(job.grains_ranks, "grains", {"--pause", fmt::format("{}", job.pause)});
    site.run(line, "coupling.log");
    return {results(folder, "coupler", 1), results(folder, "fluid", job.fluid_ranks),
            results(folder, "grains", job.grains_ranks)};
}

double play_relay(Site& site, std::int64_t bytes, int turns) {
    const fs::path folder = fresh_folder(site);
    Words line = mpirun_options(this_site());
    append(line, {"-n", "3", program(site), "relay", folder.string(), "--bytes",
                  std::to_string(bytes), "--turns", std::to_string(turns + 1)});
    site.run(line, "relay.log");
    return read_sample(folder / "relay.json").wall;
}

}  // namespace turbidite::bench
