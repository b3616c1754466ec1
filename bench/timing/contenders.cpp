// SPDX-License-Identifier: LGPL-2.1-or-later
#include "bench/timing/contenders.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <regex>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/case_file.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/prepare_run.hpp"

namespace turbidite::bench {
namespace {

namespace fs = std::filesystem;

int along(const BenchBox& box, double size) {
    return static_cast<int>(std::lround(size * box.cells_per_diameter()));
}

int layers(const BenchBox& box) {
    return box.in_space() ? along(box, box.depth) : 1;
}

/// Reports progress on standard error.
void say(const std::string& text) {
    fmt::print(stderr, "  {}\n", text);
}

ResolvedCase case_of(const Site& site, const BenchBox& box, int ranks = 1) {
    std::vector<std::string> sets = {
        fmt::format("grains.count={}", std::max(box.grains, 1)),
        fmt::format("fluid.ranks={}", ranks),
        fmt::format("fluid.cells_per_diameter={}", box.cells_per_diameter())};
    if (box.in_space())
        sets.insert(sets.end(), {"dimension=3", fmt::format("domain.size=[{},{},{}]", box.width,
                                                            box.height, box.depth)});
    else
        sets.push_back(fmt::format("domain.size=[{},{}]", box.width, box.height));
    return load_case(site.source("fluid.yaml"), sets);
}

RunFolder prepared_run(const Site& site, const BenchBox& box, int ranks) {
    const std::string name = fmt::format("{}-on-{}", box.name(), ranks);
    const RunFolder folder{site.folder() / ("ours-" + name)};
    if (fs::exists(folder.root)) return folder;
    say("preparing " + name);
    const ResolvedCase resolved = case_of(site, box, ranks);
    prepare_run(resolved, make_run_folder({.out = folder.root}, resolved.name), {});
    if (box.grains == 0)
        site.run({"setExprFields", "-case", folder.fluid(), "-dict",
                  site.source("icofoam/system/setExprFieldsDict")},
                 "setExprFields-" + box.name());
    return folder;
}

RunFolder prepared_mid_fall(const Site& site, const std::string& name,
                            const std::vector<std::string>& sets) {
    const RunFolder folder{site.folder() / name};
    if (fs::exists(folder.root)) return folder;
    say("preparing the mid-fall");
    std::vector<std::string> all{
        "grains.adapter=standalone-nscd",
        "grains.file=" + fs::canonical(site.source("mid_fall.csv")).string(),
        fmt::format("fluid.cells_per_diameter={}",
                    site.quick() ? 4 : BenchBox{}.cells_per_diameter())};
    all.insert(all.end(), sets.begin(), sets.end());
    const ResolvedCase resolved =
        load_case(site.source("../configs/sedimentation-discs.yaml"), all);
    prepare_run(resolved, make_run_folder({.out = folder.root}, resolved.name), {});
    return folder;
}

/// Windows of our fluid on a prepared folder, each sample in its own process.
Sample played(const Site& site, const RunFolder& folder, const std::string& name,
              const Effort& effort, int ranks, bool discs) {
    const fs::path result = site.folder() / "ours.json";
    std::vector<std::string> line;
    if (ranks > 1) {
        line = mpirun_options(this_site());
        line.insert(line.end(), {"-n", std::to_string(ranks)});
    }
    line.insert(line.end(), {(site.programs().folder / "turbidite-bench-fluid").string(),
                             folder.root.string(), "--warm-up", std::to_string(effort.warm_up),
                             "--steps", std::to_string(effort.steps), "--result", result.string()});
    if (discs) line.push_back("--discs");
    if (ranks > 1) line.push_back("--parallel");
    site.run(line, "ours.log");
    const Sample sample = read_sample(result);
    say(fmt::format("our window, {} on {}: {:.4g} s, wall {:.4g} s", name, ranks, sample.processor,
                    sample.wall));
    return sample;
}

fs::path prepared_icofoam(const Site& site, const BenchBox& box, const Effort& effort) {
    const fs::path folder = site.folder() / ("icofoam-" + box.name());
    if (fs::exists(folder)) return folder;
    say("preparing icoFoam " + box.name());
    fs::copy(site.source("icofoam"), folder, fs::copy_options::recursive);
    std::ofstream(folder / "system/boxSize")
        << fmt::format("width {}; height {}; depth {}; nx {}; ny {}; nz {};\n", box.width,
                       box.height, box.in_space() ? box.depth : 0.0625, along(box, box.width),
                       along(box, box.height), layers(box))
        << (box.in_space() ? "ends wall; velocityEnds noSlip; pressureEnds zeroGradient;\n"
                           : "ends empty; velocityEnds empty; pressureEnds empty;\n");
    const double end =
        case_of(site, box).settings.real("time.step") * (effort.warm_up + effort.steps);
    std::ofstream(folder / "system/controlDict", std::ios::app)
        << fmt::format("\nendTime {:.10g};\n", end);
    site.run({"blockMesh", "-case", folder}, "blockMesh-icofoam");
    site.run({"setExprFields", "-case", folder}, "setExprFields-icofoam");
    return folder;
}

/// The clock after every step, from lines such as "ExecutionTime = 4.6 s  ClockTime = 5 s".
std::vector<double> execution_times(const std::string& log) {
    static const std::regex line("ExecutionTime = ([0-9.e+-]+) s");
    std::vector<double> times;
    for (std::sregex_iterator at(log.begin(), log.end(), line), end; at != end; ++at)
        times.push_back(std::stod((*at)[1]));
    return times;
}

}  // namespace

double BenchBox::cells() const {
    return static_cast<double>(along(*this, width)) * along(*this, height) * layers(*this);
}

std::string BenchBox::name() const {
    const std::string deep = in_space() ? fmt::format("x{}", layers(*this)) : "";
    return fmt::format("{}x{}{}{}", along(*this, width), along(*this, height), deep,
                       grains > 0 ? fmt::format("-{}-grains", grains) : "");
}

Sample our_window(Site& site, const BenchBox& box, const Effort& effort, int ranks) {
    const RunFolder folder = prepared_run(site, box, ranks);
    return played(site, folder, box.name(), effort, ranks, box.grains > 0);
}

Sample mid_fall_window(Site& site, const Effort& effort, int ranks) {
    const RunFolder folder = prepared_mid_fall(site, fmt::format("mid-fall-on-{}", ranks),
                                               {fmt::format("fluid.ranks={}", ranks)});
    return played(site, folder, "mid-fall", effort, ranks, true);
}

Sample mid_fall_window_in_order(Site& site, const Effort& effort, bool second) {
    const std::string name = second ? "mid-fall-second-order" : "mid-fall-first-order";
    const std::string scheme = second ? "Gauss LUST grad(U)" : "Gauss limitedLinearV 1";
    const RunFolder folder = prepared_mid_fall(
        site, name,
        {std::string("fluid.time_scheme=") + (second ? "second-order" : "first-order"),
         "fluid.transport_scheme=" + scheme});
    return played(site, folder, name, effort, 1, true);
}

std::vector<std::string> SpaceCase::changes(const Site& site) const {
    std::vector<std::string> all = sets;
    if (!grains.empty())
        all.push_back("grains.file=" + fs::canonical(site.source(grains)).string());
    return all;
}

Sample settling_window(Site& site, const SpaceCase& of, const Effort& effort) {
    const RunFolder folder{site.folder() / fmt::format("{}-on-{}", of.name, of.ranks)};
    if (!fs::exists(folder.root)) {
        say("preparing " + of.name);
        std::vector<std::string> sets{"grains.adapter=standalone-nscd",
                                      fmt::format("fluid.ranks={}", of.ranks)};
        for (std::string& change : of.changes(site)) sets.push_back(std::move(change));
        const ResolvedCase resolved =
            load_case(site.source("../configs/settling-spheres.yaml"), sets);
        prepare_run(resolved, make_run_folder({.out = folder.root}, resolved.name), {});
    }
    return played(site, folder, of.name, effort, of.ranks, true);
}

Sample array_code_step(Site& site, const BenchBox& box, const Effort& effort) {
    const fs::path result = site.folder() / "array-code.json";
    const Settings settings = case_of(site, box).settings;
    site.run({site.programs().folder / "turbidite-bench-array-code", "--width",
              fmt::format("{}", box.width), "--height", fmt::format("{}", box.height),
              "--cells-per-diameter", std::to_string(box.cells_per_diameter()), "--reynolds",
              settings.text("fluid.reynolds"), "--step", settings.text("time.step"), "--warm-up",
              std::to_string(effort.warm_up), "--steps", std::to_string(effort.steps), "--result",
              result.string()},
             "array-code.log");
    const Sample sample = read_sample(result);
    say(fmt::format("array code, {}: {:.4g} s", box.name(), sample.processor));
    return sample;
}

Sample icofoam_step(Site& site, const BenchBox& box, const Effort& effort) {
    const fs::path folder = prepared_icofoam(site, box, effort);
    site.run({"icoFoam", "-case", folder.string()}, "icofoam.log");
    const std::vector<double> times = execution_times(site.text("icofoam.log"));
    const int steps = effort.warm_up + effort.steps;
    if (effort.warm_up < 1 || static_cast<int>(times.size()) != steps)
        throw Failure(
            ExitCode::tests_failed,
            fmt::format("icoFoam's log shows {} steps instead of {}", times.size(), steps));
    Sample sample;
    sample.processor = (times.back() - times[effort.warm_up - 1]) / effort.steps;
    say(fmt::format("icoFoam, {}: {:.4g} s", box.name(), sample.processor));
    return sample;
}

}  // namespace turbidite::bench
