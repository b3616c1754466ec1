// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite study STUDY: runs what is missing of a sweep of cases, then writes its table and
// figures. Stopped at any moment, the same line goes on where it was.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>

#include "launcher/case/forecast/disk_cost.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/commands/report_script.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/folder/set_aside.hpp"
#include "launcher/job/folder/shipped_cases.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/play_run.hpp"
#include "launcher/job/pour_grains.hpp"
#include "launcher/job/resume_run.hpp"
#include "launcher/job/terminal.hpp"
#include "launcher/study/other_defaults.hpp"
#include "launcher/study/study_record.hpp"
#include "launcher/study/study_turns.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct StudyOptions {
    std::string file;
    std::vector<std::string> overrides;
    std::string out;
    bool dry_run = false;
    bool quick = false;
    bool again = false;
};

/// How long the runs of a part take, from those that were played.
class PaceOfParts {
 public:
    void take_in(const std::string& part, double seconds) { spent_[part].push_back(seconds); }

    /// Seconds of the runs that are to come, empty before the first has ended. Parts that have
    /// played none count as the mean of the others.
    std::optional<double> left(const std::vector<const PlannedRun*>& to_come) const {
        if (spent_.empty()) return std::nullopt;
        double all = 0.0, sum = 0.0;
        for (const auto& [part, seconds] : spent_)
            all += mean(seconds) / static_cast<double>(spent_.size());
        for (const PlannedRun* run : to_come) {
            const auto at = spent_.find(run->part);
            sum += at == spent_.end() ? all : mean(at->second);
        }
        return sum;
    }

 private:
    static double mean(const std::vector<double>& values) {
        double sum = 0.0;
        for (const double value : values) sum += value;
        return sum / static_cast<double>(values.size());
    }

    std::map<std::string, std::vector<double>> spent_;
};

std::string duration(double seconds) {
    const long minutes = static_cast<long>(seconds / 60.0 + 0.5);
    if (minutes == 0) return "less than a minute";
    return minutes < 60 ? fmt::format("about {} min", minutes)
                        : fmt::format("about {} h {:02} min", minutes / 60, minutes % 60);
}

/// `again`: those that are kept count as missing.
std::vector<const PlannedRun*> missing_runs(const std::vector<PlannedRun>& plan,
                                            const fs::path& out, bool again) {
    std::vector<const PlannedRun*> missing;
    for (const PlannedRun& run : plan) {
        const RunState state = state_of(run, out);
        if (state != RunState::done && (again || state != RunState::kept)) missing.push_back(&run);
    }
    return missing;
}

/// So that results of an earlier version do not pass for those of this one.
void tell_kept(const std::vector<PlannedRun>& plan, const fs::path& out) {
    std::size_t kept = 0;
    for (const PlannedRun& run : plan) {
        if (state_of(run, out) != RunState::kept) continue;
        ++kept;
        const auto changes = other_defaults(run, out / run.path());
        for (const std::string& change : changes.value_or(std::vector<std::string>{}))
            tell_on_stderr(fmt::format("{} was played with {}", run.path(), change));
    }
    if (kept > 0)
        tell_on_stderr(
            fmt::format("{} done by a version with other defaults, and {} as {}; --again "
                        "plays {} again and keeps the old {} beside the new",
                        kept == 1 ? "one run was" : fmt::format("{} runs were", kept),
                        kept == 1 ? "stays" : "stay", kept == 1 ? "it is" : "they are",
                        kept == 1 ? "it" : "them", kept == 1 ? "one" : "ones"));
}

bool asked_to_stop(ExitCode code) {
    return code == ExitCode::interrupted || code == ExitCode::terminated;
}

/// What was there stays, under another name, unless nothing has been played in it.
PreparedRun prepare_afresh(const PlannedRun& run, const fs::path& folder, const LaunchSite& site) {
    // Found poured, unless the run was to go on and cannot.
    const ResolvedCase resolved = with_poured_grains(run.resolve(), site);
    require_programs(resolved, needed_programs(resolved.settings, site.programs));
    if (has_windows(folder))
        tell_on_stderr(fmt::format("{}: the run that was there is now {}", run.path(),
                                   set_aside(folder).string()));
    return prepare(resolved, {.out = folder, .force = true}, site);
}

/// A run that was cut off goes on from its last whole checkpoint; any other starts afresh, and so
/// does one whose folder does not allow to go on. Where something else is in the way, such as a
/// full disk, the run stays as it is for the next call: throws Failure.
PreparedRun prepare_to_play(const PlannedRun& run, const fs::path& out, const LaunchSite& site) {
    const fs::path folder = out / run.path();
    if (may_go_on(run, out)) try {
            if (auto resumed = prepare_resumption(folder, {}, site, tell_on_stderr)) {
                fmt::print("goes on after window {}, {:g} t_c\n", resumed->windows, resumed->time);
                return std::move(resumed->run);
            }
        } catch (const Failure& failure) {
            if (failure.code() != ExitCode::bad_input) throw;
            tell_on_stderr(fmt::format("{}: it starts afresh: {}", run.path(), failure.what()));
        }
    return prepare_afresh(run, folder, site);
}

/// Empty if it cannot be played now, which then was said and stands in `why_not`; `result` has the
/// code, unless another run failed before.
template <class Prepare>
auto unless_it_waits(const PlannedRun& run, ExitCode& result, WhyNot& why_not,
                     const Prepare& prepare) -> std::optional<decltype(prepare())> {
    const auto stays = [&](const char* how, const char* why, ExitCode code) {
        tell_on_stderr(fmt::format("{}: {}: {}", run.path(), how, why));
        why_not[run.path()] = why;
        if (result == ExitCode::done) result = code;
    };
    constexpr const char* waits = "it stays as it is, and the next call tries again";
    try {
        return prepare();
    } catch (const Failure& failure) {
        if (asked_to_stop(failure.code())) throw;
        // What only shows now: a packing that was poured does not fit, a file is in its folder.
        if (failure.code() == ExitCode::bad_input)
            stays("it cannot be played", failure.what(), failure.code());
        else
            stays(waits, failure.what(), ExitCode::participant_failed);
    } catch (const fs::filesystem_error& error) {
        // A full disk, a folder that may not be written.
        stays(waits, error.what(), ExitCode::participant_failed);
    }
    return std::nullopt;
}

/// Holds `chosen` except while grains are poured: null if another takes the run meanwhile.
std::optional<PreparedRun> prepare_in_turn(const PlannedRun& run, const fs::path& out,
                                           const LaunchSite& site, const StudyTurns& turns,
                                           std::shared_ptr<RunLock>& chosen) {
    if (run.poured && !may_go_on(run, out)) {
        chosen.reset();
        with_poured_grains(run.resolve(), site);
        chosen = turns.lock();
        if (!turns.is_free(run)) return std::nullopt;
    }
    return prepare_to_play(run, out, site);
}

void announce(const PlannedRun& run, const std::vector<PlannedRun>& plan, const StudyTurns& turns,
              const PaceOfParts& pace) {
    std::vector<const PlannedRun*> to_come = turns.to_come();
    to_come.push_back(&run);
    const std::optional<double> alone = pace.left(to_come);
    const double players = 1.0 + static_cast<double>(turns.played_by_others());
    fmt::print("[{}/{}] {}{}\n", &run - plan.data() + 1, plan.size(), run.path(),
               alone ? "  (study: " + duration(*alone / players) + " left)" : "");
}

/// Plays them one after the other; a run that fails does not keep the others from being played.
/// The code of the first that failed, or of the signal that stopped the study.
ExitCode play_missing(const Study& study, const std::vector<PlannedRun>& plan, const fs::path& out,
                      StudyTurns& turns) {
    const LaunchSite site = this_site();
    PaceOfParts pace;
    ExitCode result = ExitCode::done;
    WhyNot why_not;
    for (;;) {
        std::shared_ptr<RunLock> chosen = turns.lock();
        const PlannedRun* run = turns.next();
        if (run == nullptr) return result;
        announce(*run, plan, turns, pace);
        const auto start = Clock::now();
        const auto prepared = unless_it_waits(
            *run, result, why_not, [&] { return prepare_in_turn(*run, out, site, turns, chosen); });
        chosen.reset();
        if (!prepared) {
            chosen = turns.lock();
            write_study_record(study, plan, out, why_not);
        }
        if (!prepared || !*prepared) continue;
        const auto outcome =
            unless_it_waits(*run, result, why_not, [&] { return play(**prepared, site.programs); });
        const ExitCode code = outcome ? outcome->code : result;
        chosen = turns.lock();
        write_study_record(study, plan, out, why_not);
        if (asked_to_stop(code)) return code;
        if (result == ExitCode::done) result = code;
        if (!outcome) continue;
        if (outcome->signal != 0) return signal_code(outcome->signal);  // after its last window
        pace.take_in(run->part, std::chrono::duration<double>(Clock::now() - start).count());
    }
}

const char* word_of(const PlannedRun& run, const fs::path& out) {
    if (RunLock::is_held(out / run.path())) return "running";
    switch (state_of(run, out)) {
        case RunState::missing:
            return has_windows(out / run.path()) ? "changed" : "missing";
        case RunState::begun:
            return "begun";
        case RunState::done:
            return "done";
        case RunState::kept:
            return "kept";
        case RunState::failed:
            return "failed";
    }
    return "";
}

void list(const std::vector<PlannedRun>& plan, const fs::path& out) {
    bool changed = false;
    for (const PlannedRun& run : plan) {
        const std::string word = word_of(run, out);
        changed = changed || word == "changed";
        fmt::print("{}", for_stdout(fmt::format("{:<8} {:>7}  {}\n", word, rough_time(run.seconds),
                                                run.path())));
    }
    if (changed)
        tell_on_stderr(
            "changed: a run of another case is there; it is renamed to ...-old-1 before this one "
            "is played");
}

/// Those of --quick are other runs, and go to another folder.
fs::path folder_of(const Study& study, const StudyOptions& options) {
    if (!options.out.empty()) return fs::absolute(options.out);
    return fs::absolute(study.out.string() + (options.quick ? "-quick" : ""));
}

/// Of runs that are done and have none: it was interrupted, the disk was full.
void draw_missing_reports(const std::vector<PlannedRun>& plan, const fs::path& out) {
    if (!report_wanted()) return;
    for (const PlannedRun& run : plan) {
        const RunFolder folder{out / run.path()};
        if (state_of(run, out) != RunState::done || fs::exists(folder.report())) continue;
        if (RunLock::is_held(folder.root)) continue;  // another call has it, and draws its report
        fmt::print("{}", for_stdout("report of " + run.path() + "\n"));
        write_report(folder, find_programs());
    }
}

/// ", 1 failed (column/friction-0.3)"; empty if none has.
std::string failed_text(const std::vector<PlannedRun>& plan, const fs::path& out) {
    std::vector<std::string> names;
    for (const PlannedRun& run : plan)
        if (state_of(run, out) == RunState::failed) names.push_back(run.path());
    if (names.empty()) return "";
    const std::size_t shown = std::min<std::size_t>(names.size(), 3);
    const std::string more = names.size() > shown ? ", ..." : "";
    return fmt::format(", {} failed ({}{})", names.size(),
                       fmt::join(names.begin(), names.begin() + static_cast<long>(shown), ", "),
                       more);
}

/// Table and figures, by the last to end; what their script says of them.
ExitCode conclude(const Study& study, const std::vector<PlannedRun>& plan, const fs::path& out,
                  const StudyTurns& turns, bool again) {
    const auto lock = turns.lock();
    if (const std::size_t others = turns.played_by_others()) {
        fmt::print(
            "{} more {} being played by another `turbidite study`; the last to end writes "
            "table and figures.\n",
            others, others == 1 ? "run is" : "runs are");
        return ExitCode::done;
    }
    if (const ExitCode code = write_study_results(out, find_programs()); code != ExitCode::done)
        return code;
    const std::size_t left = missing_runs(plan, out, again).size();
    const std::string text =
        fmt::format("{} of {} runs done{}. Results in {}: study.html, study.csv{}.{}\n",
                    plan.size() - left, plan.size(), failed_text(plan, out), out.string(),
                    study.figures.empty() ? "" : fmt::format(", {}.md", study.figures),
                    left > 0 ? " The same line again runs what is missing." : "");
    fmt::print("{}", for_stdout(text));
    return ExitCode::done;
}

/// What plays the same study from anywhere, without the flags that change no result.
std::vector<std::string> words_of(const StudyOptions& options, const fs::path& out) {
    std::vector<std::string> words{"turbidite", "study", fs::absolute(options.file).string()};
    for (const std::string& text : options.overrides) words.insert(words.end(), {"--set", text});
    words.insert(words.end(), {"--out", out.string()});
    if (options.quick) words.push_back("--quick");
    return words;
}

/// So that the table of another study, or of other keys, is not taken for lost.
void tell_of_another(const std::vector<std::string>& command, const fs::path& out) {
    const auto before = read_run_json(out / "study.json").value("command", command);
    const auto without_folder = [](std::vector<std::string> words) {
        const auto at = std::find(words.begin(), words.end(), "--out");
        if (std::distance(at, words.end()) >= 2) words.erase(at, at + 2);
        return words;
    };
    if (without_folder(before) == without_folder(command)) return;
    tell_on_stderr(fmt::format(
        "{} has the table and figures of another study, which those of this one replace; its runs "
        "stay where this one has none of their names. Its command: {}. With --out the two have "
        "folders of their own",
        out.string(), shell_line(before)));
}

/// Throws Failure (bad input) for a case, and for a folder that cannot be made.
void require_study(const fs::path& file) {
    if (!is_case(file)) return;
    throw Failure(ExitCode::bad_input,
                  fmt::format("turbidite: {0} is a case, which is one run\n  A study names a case "
                              "and the keys to sweep. Play the run with: turbidite run {0}",
                              shell_line({file.string()})));
}

void make_folder(const fs::path& out) {
    std::error_code error;
    fs::create_directories(out, error);
    if (error)
        throw Failure(ExitCode::bad_input,
                      fmt::format("{} cannot be made: {}\n  It is to hold the folders of the runs. "
                                  "Name another with --out. Exit code 2.",
                                  out.string(), error.message()));
}

int run_study(const StudyOptions& options) {
    require_study(options.file);
    Study study = read_study(options.file);
    const std::vector<PlannedRun> plan = plan_study(study, options.overrides, options.quick);
    const fs::path out = folder_of(study, options);
    require_own_record(out);
    study.command = words_of(options, out);
    const std::vector<const PlannedRun*> missing = missing_runs(plan, out, options.again);
    const std::string text =
        fmt::format("{}: {} {}, {} of them done, folder {}{}\n", study.name, plan.size(),
                    plan.size() == 1 ? "run" : "runs", plan.size() - missing.size(), out.string(),
                    missing.empty() ? "" : ", to do: " + forecast_text(missing));
    fmt::print("{}", for_stdout(text + remarks_text(plan)));
    if (!options.again) tell_kept(plan, out);
    tell_of_another(study.command, out);
    if (const std::string lack = lack_of_disk(predicted_disk(missing), out); !lack.empty())
        tell_on_stderr(lack);
    if (options.dry_run) {
        list(plan, out);
        return static_cast<int>(ExitCode::done);
    }
    make_folder(out);
    StudyTurns turns(plan, out, options.again);
    {
        const auto lock = turns.lock();
        write_study_record(study, plan, out);
    }
    const ExitCode code = play_missing(study, plan, out, turns);
    if (!asked_to_stop(code)) draw_missing_reports(plan, out);
    std::fflush(nullptr);
    const ExitCode written = conclude(study, plan, out, turns, options.again);
    return static_cast<int>(written == ExitCode::done ? code : written);
}

}  // namespace

CommandAction declare_study(CLI::App& app) {
    const auto options = std::make_shared<StudyOptions>();
    app.add_option("STUDY", options->file, "study file (YAML), or the name of a shipped study")
        ->required();
    add_overrides(app, options->overrides,
                  "key=value for every run, in place of what the study says");
    app.add_option("--out", options->out, "folder of the run folders; default: the study's `out`")
        ->type_name("DIR");
    app.add_flag("--dry-run", options->dry_run, "list the runs and which of them are done");
    app.add_flag("--again", options->again,
                 "play runs again that a version with other defaults has done; the old ones are "
                 "kept beside the new");
    app.add_flag("--quick", options->quick,
                 "the keys of `quick` instead of those of `full`; results in <out>-quick");
    return [options] {
        options->file = case_named(options->file, find_programs());
        return run_study(*options);
    };
}

}  // namespace turbidite
