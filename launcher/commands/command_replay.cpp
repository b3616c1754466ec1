// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite replay RUN: one participant against what its partner had said.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "coupler/replay/recorded_start.hpp"
#include "launcher/case/files/file_names.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/overdue.hpp"
#include "launcher/job/play_run.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

constexpr int most_parts = 1'000'000;

struct ReplayOptions {
    std::string run, side;
    int part = 0;  ///< of a resumed run; 0: the last one
    RunOrder order;
    bool dry_run = false;
};

Failure refused(const std::string& text) {
    return Failure(ExitCode::bad_input, text + " Exit code 2.");
}

/// The folder of the recordings of the part that is to be played.
std::filesystem::path recordings_of(const ReplayOptions& options, const RunFolder& recorded) {
    if (options.part == 0) return recorded.recordings();
    const auto part = recorded.recordings() / fmt::format("part-{}", options.part);
    if (!is_there(part))
        throw refused(
            fmt::format("{} has no recording/part-{}.\n  Earlier parts of a resumed run are "
                        "numbered from 1; without --part the last one is played.",
                        options.run, options.part));
    return part;
}

/// --side, or the one that was recorded.
std::string side_of(const ReplayOptions& options, const std::filesystem::path& recordings) {
    const auto file = [&](const std::string& role) { return recordings / (role + ".frames"); };
    std::vector<std::string> there;
    for (const char* role : {"grains", "fluid"})
        if (is_there(file(role))) there.emplace_back(role);
    if (there.empty())
        throw refused(
            fmt::format("{} has no recording.\n  Play the case again with --set "
                        "coupling.recording=grains, fluid or both.",
                        options.run));
    if (options.side.empty() && there.size() == 1) return there.front();
    if (options.side.empty())
        throw refused(
            fmt::format("{} has recordings of grains and fluid.\n  Say which program is "
                        "to run: --side grains or --side fluid.",
                        options.run));
    if (!is_there(file(options.side)))
        throw refused(
            fmt::format("{} has no recording of the {}.\n  Play the case again with "
                        "--set coupling.recording=both.",
                        options.run, options.side));
    return options.side;
}

/// Where that checkpoint was kept. Throws Failure (bad input) if it is not there.
std::filesystem::path kept_checkpoint(const std::filesystem::path& recordings,
                                      const std::string& set) {
    if (is_there(recordings / set)) return recordings / set;
    throw refused(
        fmt::format("The recording begins with a checkpoint that is not there: {}.\n  It belongs "
                    "to the part of a run after `turbidite resume`, which keeps the checkpoint "
                    "beside the recording.",
                    (recordings / set).string()));
}

/// The folder of the replay is emptied by --force.
void require_other_folder(const ReplayOptions& options, const RunFolder& recorded) {
    namespace fs = std::filesystem;
    if (options.order.out.empty()) return;
    const fs::path out = fs::weakly_canonical(fs::absolute(options.order.out) / "");
    const fs::path way = fs::weakly_canonical(recorded.recordings()).lexically_relative(out);
    if (*way.begin() == "..") return;
    throw refused(fmt::format("--out = {} holds the recording itself.\n  Choose another folder.",
                              options.order.out.string()));
}

int replay(const ReplayOptions& options) {
    if (options.run.empty()) throw refused("The name of the run is empty.");
    const RunFolder recorded{std::filesystem::absolute(options.run).lexically_normal()};
    if (!is_there(recorded.resolved_case()))
        throw refused(fmt::format("{} is not a run folder: it has no case.yaml.", options.run));
    require_other_folder(options, recorded);
    const auto recordings = recordings_of(options, recorded);
    const std::string side = side_of(options, recordings);
    const auto recording = recordings / (side + ".frames");
    const std::optional<std::string> checkpoint = first_checkpoint(recording);
    const std::filesystem::path kept =
        checkpoint ? kept_checkpoint(recordings, *checkpoint) : std::filesystem::path();
    const bool needs_mesh = mesh_of_replay(side) != FluidMesh::left_out;
    const ResolvedCase resolved =
        load_run_folder(recorded.root, {}, needs_mesh ? Machine::this_one : Machine::any);
    LaunchSite site = this_site();
    site.programs.scripted_fluid = !needs_mesh;
    require_programs(resolved, needed_programs(resolved.settings, site.programs));
    RunOrder order = options.order;
    order.for_openfoam = has_openfoam(resolved.settings);
    const auto [folder, lock] = own_run_folder(order, resolved.name + "-replay");
    const auto line = replay_arguments(resolved.settings, folder, site, side, recording);
    prepare_run(resolved, folder, line, mesh_of_replay(side));
    if (checkpoint) {
        std::filesystem::create_directories((folder.root / *checkpoint).parent_path());
        std::filesystem::copy(kept, folder.root / *checkpoint);
    }
    fmt::print(options.dry_run ? stderr : stdout, "The {} of {} again, alone.  folder: {}\n", side,
               options.run, folder.root.string());
    std::fflush(nullptr);
    if (options.dry_run) {
        fmt::print("{}\n", shell_line(line));
        return static_cast<int>(ExitCode::done);
    }
    const JobEnd end = run_job({.arguments = line,
                                .error_log = folder.log("mpirun"),
                                .request_stop = [](int) { return false; },
                                .overdue = Overdue(folder, resolved.settings),
                                .had_children = [&] { return played_here(folder); }});
    const JobOutcome outcome = settle_outcome(folder, end, {"replay", side + " rank 0"});
    if (outcome.code != ExitCode::done) print_on_stderr(outcome_text(folder, outcome));
    const bool differs = is_there(folder.root / "differences");
    return static_cast<int>(outcome.code == ExitCode::done && differs ? ExitCode::tests_failed
                                                                      : outcome.code);
}

}  // namespace

CommandAction declare_replay(CLI::App& app) {
    const auto options = std::make_shared<ReplayOptions>();
    app.add_option("RUN", options->run, "run folder with a recording (coupling.recording)")
        ->required()
        ->type_name("DIR");
    app.add_option("--side", options->side, "the program that runs; the other one is the recording")
        ->check(CLI::IsMember({"grains", "fluid"}))
        ->type_name("grains|fluid");
    app.add_option("--part", options->part,
                   "an earlier part of a resumed run, from 1; default: the last one")
        ->check(CLI::Range(1, most_parts))
        ->type_name("N");
    app.add_option("--out", options->order.out,
                   "folder of the replay, new or empty; default runs/<run>-replay-<date>-<time>")
        ->type_name("DIR");
    app.add_flag("--force", options->order.force, "overwrite an existing run in --out");
    app.add_flag("--dry-run", options->dry_run,
                 "prepare everything and print the mpirun line, for a debugger");
    return [options] { return replay(*options); };
}

}  // namespace turbidite
