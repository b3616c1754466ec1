// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/resume_run.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "coupler/checkpoint/checkpoint_sets.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "coupler/protocol/run_values.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "launcher/case/grains/grains_adapters.hpp"
#include "launcher/case/placed_case.hpp"
#include "launcher/job/folder/openfoam_path.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/folder/run_on_disk.hpp"
#include "launcher/job/folder/set_aside.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;
using Say = std::function<void(const std::string&)>;

Failure refused(const fs::path& folder, const std::string& fault, const std::string& remedy) {
    return Failure(ExitCode::bad_input,
                   fmt::format("{} {}\n  {}\nNothing was started. Exit code 2.", folder.string(),
                               fault, remedy));
}

std::shared_ptr<RunLock> lock_of(const RunFolder& folder, const fs::path& as_given) {
    if (!fs::is_regular_file(folder.resolved_case()))
        throw refused(as_given, "is not a run folder: it has no case.yaml",
                      "Give the folder of a run, as `turbidite run` named it.");
    std::shared_ptr<RunLock> lock = RunLock::take(folder.root);
    if (!lock) throw refused(as_given, RunLock::in_use, RunLock::how_to_get_it);
    return lock;
}

/// The folder may have been moved since it was prepared.
void require_path(const RunFolder& folder, const Settings& settings) {
    if (has_openfoam(settings) && !openfoam_finds(folder.root))
        throw refused(folder.root, "has a space, a quote or a backslash in its path",
                      "OpenFOAM changes these in file names. Rename the folder, or move it.");
}

struct Chosen {
    std::string name;
    Manifest manifest;
};

/// The newest whole checkpoint; newer ones, which are damaged, are removed.
std::optional<Chosen> choose(const RunFolder& folder, const CheckpointSets& sets, const Say& say) {
    std::vector<std::string> damaged;
    std::optional<Chosen> chosen;
    for (const std::string& name : sets.names()) try {
            chosen = Chosen{name, sets.verified(name)};
            break;
        } catch (const Failure& failure) {
            say(fmt::format("checkpoint {}: {}; the one before it is used", name, failure.what()));
            damaged.push_back(name);
        }
    if (!chosen && damaged.empty()) return std::nullopt;
    // Only once an older one is known to be whole. The run will write these windows again.
    if (chosen) {
        for (const std::string& bad : damaged) sets.remove(bad);
        return chosen;
    }
    throw refused(folder.root, fmt::format("has no whole checkpoint: {}", fmt::join(damaged, ", ")),
                  "Start a new run with the grains of this one: turbidite run CASE --from DIR.");
}

bool begins_with(const std::string& text, const std::string& part) {
    return text.rfind(part, 0) == 0;
}

bool may_change(const std::string& key) {
    for (const std::string& allowed : keys_that_may_change())
        if (key == allowed || (allowed.back() == '.' && begins_with(key, allowed))) return true;
    // What follows from them.
    for (const char* derived : {"run.hash", "run.windows", "run.slip_tolerance", "run.output_every",
                                "run.fields_every", "run.fluid_layers"})
        if (key == derived) return true;
    return false;
}

/// Named by an override, itself or with its group.
bool is_given(const std::string& key, const std::vector<std::string>& overrides) {
    return std::any_of(overrides.begin(), overrides.end(), [&](const std::string& text) {
        const std::string name = text.substr(0, text.find('='));
        return key == name || begins_with(key, name + ".");
    });
}

/// "contact.friction is 0.5, in the checkpoint 0.3", one line per key. A setting that one of the
/// two does not have at all is one that only the version of the other knows, and has its default
/// there.
std::string forbidden_changes(const Settings& now, const Settings& then, const char* of_then,
                              const std::vector<std::string>& overrides) {
    std::string lines;
    for (const std::string& text : overrides)
        if (const std::string key = text.substr(0, text.find('=')); names_copy(key))
            lines += fmt::format("\n  {} is given, and the run has its copy of that file", key);
    for (const auto& [key, value] : now.entries()) {
        if (names_copy(key)) continue;
        const bool known = then.has(key);
        if (may_change(key) || (known ? value == then.text(key) : !is_given(key, overrides)))
            continue;
        lines += fmt::format("\n  {} is {}, in the {} {}", key, value, of_then,
                             known ? then.text(key) : "nothing");
    }
    for (const auto& [key, value] : then.entries())
        if (!now.has(key) && !may_change(key) && is_given(key, overrides))
            lines += fmt::format("\n  {} is nothing, in the {} {}", key, of_then, value);
    return lines;
}

/// For readers: "checkpoint.*" is all keys of that group.
std::vector<std::string> readable_keys() {
    std::vector<std::string> names = keys_that_may_change();
    for (std::string& name : names)
        if (name.back() == '.') name += '*';
    return names;
}

/// `before`: the settings of `what`.
void check_keys(const RunFolder& folder, const Settings& now, const Settings& before,
                const char* what, const std::vector<std::string>& overrides) {
    const std::string changes = forbidden_changes(now, before, what, overrides);
    if (!changes.empty())
        throw refused(folder.root, fmt::format("cannot go on as another case:{}", changes),
                      fmt::format("These keys may change: {}. For all others start a new run, with "
                                  "--from for its grains.",
                                  fmt::join(readable_keys(), ", ")));
}

void check_changes(const RunFolder& folder, const ResolvedCase& resolved, const Chosen& chosen,
                   const std::vector<std::string>& overrides) {
    check_keys(folder, resolved.settings, chosen.manifest.settings, "checkpoint", overrides);
    const std::int64_t ranks = resolved.settings.integer("grains.ranks");
    if (ranks != std::ssize(chosen.manifest.grains) &&
        !grains_adapter(resolved.settings).resumes_on_other_ranks)
        throw refused(folder.root,
                      fmt::format("cannot go on with grains.ranks = {}: {} reads its state on as "
                                  "many ranks as saved it",
                                  ranks, resolved.settings.text("grains.adapter")),
                      fmt::format("Use grains.ranks = {}.", chosen.manifest.grains.size()));
    const std::int64_t windows = resolved.settings.integer("run.windows");
    // The same end is allowed: it is found out later that all is done.
    if (windows < chosen.manifest.windows)
        throw refused(
            folder.root,
            fmt::format("has already done {} windows, time.end = {} t_c is {}",
                        chosen.manifest.windows, resolved.settings.text("time.end"), windows),
            fmt::format("Use a later time.end, above {:g}.", chosen.manifest.time));
}

void remove_requests(const RunFolder& folder) {
    std::error_code ignored;
    // Left by the part before: the first window would obey them.
    for (const char* name : {stop_file, write_file, checkpoint_file})
        fs::remove(folder.root / name, ignored);
}

bool is_part(const fs::path& folder) {
    return begins_with(folder.filename(), "part-");
}

long number_of_part(const fs::path& folder) {
    return std::strtol(folder.filename().c_str() + std::string("part-").size(), nullptr, 10);
}

/// What the parts so far have left in a folder goes into one of its own there.
void put_aside(const fs::path& folder) {
    std::vector<fs::path> entries;
    for (const auto& entry : fs::directory_iterator(folder)) entries.push_back(entry.path());
    long last = 0;  // a user may have removed earlier ones
    for (const fs::path& entry : entries)
        if (is_part(entry)) last = std::max(last, number_of_part(entry));
    // part-1 is the first part of the run, and so on; that of now stays outside.
    const fs::path aside = folder / fmt::format("part-{}", last + 1);
    fs::create_directories(aside);
    for (const fs::path& entry : entries)
        if (!is_part(entry)) fs::rename(entry, aside / entry.filename());
}

/// A recording of the part that begins is played with this checkpoint, which the run itself will
/// have replaced by newer ones.
void keep_for_recording(const ResolvedCase& resolved, const RunFolder& folder,
                        const Chosen& chosen) {
    if (resolved.settings.text("coupling.recording") == "none") return;
    const fs::path set = CheckpointSets::folder(chosen.name);
    fs::create_directories((folder.recordings() / set).parent_path());
    fs::copy(folder.root / set, folder.recordings() / set, fs::copy_options::recursive);
}

/// Folders of the fluid that are named after a time later than `time` [s].
void remove_later_times(const fs::path& fluid_case, double time) {
    std::error_code none;
    std::vector<fs::path> later;
    for (const auto& entry : fs::directory_iterator(fluid_case, none)) {
        const std::string name = entry.path().filename();
        char* end = nullptr;
        const double value = std::strtod(name.c_str(), &end);
        // The whole name is a number: folders of OpenFOAM's times. Later ones are of windows that
        // are played again.
        if (*end == '\0' && end != name.c_str() && value > time * (1.0 + 1e-9))
            later.push_back(entry.path());
    }
    for (const fs::path& folder : later) fs::remove_all(folder);
}

/// Files NAME_00000100.vtr of a series that were written after so many windows, and what a program
/// that was killed has left of one (.part).
void remove_later_files(const fs::path& series, std::int64_t windows) {
    std::error_code none;
    std::vector<fs::path> later;
    for (const auto& entry : fs::directory_iterator(series, none)) {
        const std::string name = entry.path().stem().string();
        const std::size_t number = name.rfind('_');
        if (entry.path().extension() == ".part") later.push_back(entry.path());
        if (entry.path().extension() != ".vtr" || number == std::string::npos) continue;
        if (std::strtoll(name.c_str() + number + 1, nullptr, 10) > windows)
            later.push_back(entry.path());
    }
    for (const fs::path& file : later) fs::remove(file);
}

std::vector<fs::path> processor_folders(const fs::path& fluid_case) {
    std::vector<fs::path> found;
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(fluid_case, none))
        if (begins_with(entry.path().filename(), "processor")) found.push_back(entry.path());
    return found;
}

void move_all(const std::vector<fs::path>& entries, const fs::path& into) {
    fs::create_directories(into);
    for (const fs::path& entry : entries) fs::rename(entry, into / entry.filename());
}

/// There while `decompose_again` is at work: what it left when it was cut off is not to be used.
fs::path unfinished_decomposition(const RunFolder& folder) {
    return folder.fluid() / "decomposing";
}

/// The mesh for another number of ranks than it has. Fields of the ranks that have written the
/// checkpoint stay in fluid/until-SET, from where they come back with their number. May be cut off
/// at any place and called again.
void decompose_again(const Settings& settings, const RunFolder& folder, const Chosen& chosen) {
    const std::int64_t ranks = settings.integer("fluid.ranks");
    const std::int64_t wrote = chosen.manifest.settings.integer("fluid.ranks");
    const fs::path aside = folder.fluid() / ("until-" + chosen.name);
    write_whole(unfinished_decomposition(folder), [](std::ostream&) {});
    const std::vector<fs::path> present = processor_folders(folder.fluid());
    const std::int64_t there = std::ssize(present) + std::ssize(processor_folders(aside));
    if (wrote > 1 && there == wrote)
        move_all(present, aside);  // all, or the rest of a move that was cut off
    else                           // of an attempt since then, which has written nothing that stays
        for (const fs::path& own : present) fs::remove_all(own);
    write_decomposition(settings, folder.fluid());
    const std::vector<fs::path> kept = processor_folders(aside);
    if (ranks == wrote && std::ssize(kept) == wrote) {
        move_all(kept, folder.fluid());
        fs::remove(aside);
    } else if (ranks > 1) {
        decompose_fluid_case(folder.fluid(), folder.log("decomposePar"));
    }
    fs::remove(unfinished_decomposition(folder));
}

void prepare_fluid(const ResolvedCase& resolved, const RunFolder& folder, const Chosen& chosen) {
    if (!resolved.settings.flag("fluid.enabled")) return;
    const Settings& now = resolved.settings;
    const RunValues run = run_values(now);
    const double time = static_cast<double>(chosen.manifest.windows) * run.step;
    remove_later_times(folder.fluid(), time);
    const std::vector<fs::path> processors = processor_folders(folder.fluid());
    for (const fs::path& own : processors) remove_later_times(own, time);
    for (const char* series : {"slices", "fields"})
        remove_later_files(folder.fluid() / series, chosen.manifest.windows);
    if (fluid_program(now) == FluidProgram::box) return;
    extend_fluid_case(now, folder.fluid());
    // Of what is there, which need not be of the checkpoint: a part may have ended before its
    // first.
    const std::int64_t ranks = std::max<std::int64_t>(1, std::ssize(processors));
    if (now.integer("fluid.ranks") != ranks || fs::exists(unfinished_decomposition(folder)))
        decompose_again(now, folder, chosen);
}

void note_overrides(nlohmann::ordered_json& record, const std::vector<std::string>& overrides) {
    // Of a poured run: it is no longer that of its plan.
    if (const std::string planned = record.value("hash_before_pouring", "");
        !planned.empty() && !overrides.empty())
        record["hash_before_pouring"] = planned + " with other keys";
    // Where the keys are known that were named.
    if (const auto given = record.find("given"); given != record.end())
        for (const std::string& change : overrides)
            given->push_back(change.substr(0, change.find('=')));
}

void write_record(const ResolvedCase& resolved, const RunFolder& folder, std::int64_t windows,
                  const std::vector<std::string>& line, const std::vector<std::string>& overrides) {
    auto record = read_run_json(folder.record());
    record["status"] = "prepared";
    record["exit_code"] = nullptr;
    record["error"] = "";
    record["case_hash"] = resolved.settings.text("run.hash");
    note_overrides(record, overrides);
    record["windows"] = resolved.settings.integer("run.windows");
    record["command"] = shell_line(line);
    record["parts"].push_back({{"resumed", local_time("%Y-%m-%dT%H:%M:%S%z")},
                               {"versions", own_versions()},
                               {"overrides", overrides},
                               {"from_window", windows},
                               {"windows_done", windows},
                               {"status", "prepared"}});
    write_run_json(folder.record(), record);
}

PreparedRun from_the_beginning(const ResolvedCase& resolved, const RunFolder& folder,
                               std::shared_ptr<RunLock> lock, const LaunchSite& site,
                               const std::vector<std::string>& overrides) {
    fs::remove_all(folder.fluid());
    const auto before = read_run_json(folder.record());
    PreparedRun prepared = fill(resolved, {folder, std::move(lock)}, site);
    // The folder's own case does not know where it has come from.
    auto record = read_run_json(folder.record());
    for (const char* of :
         {"case", "case_file", "overrides", "given", "from", "hash_before_pouring", "extra_grains"})
        if (before.contains(of)) record[of] = before[of];
    note_overrides(record, overrides);
    if (!overrides.empty()) record["parts"].back()["overrides"] = overrides;
    write_run_json(folder.record(), record);
    return prepared;
}

/// The case and the record with the overrides, of one of which nothing is left if the other cannot
/// be written: a later `resume` would take the values unseen. The text of the case before, if there
/// are any. The programs of the job read the case and compare its hash.
std::string change_case(const ResolvedCase& resolved, const RunFolder& folder, std::int64_t windows,
                        const std::vector<std::string>& line,
                        const std::vector<std::string>& overrides) {
    if (overrides.empty()) {
        write_record(resolved, folder, windows, line, overrides);
        return {};
    }
    const auto put = [&](const std::string& yaml) {
        write_whole(folder.resolved_case(), [&](std::ostream& out) { out << yaml; });
    };
    const std::string before = read_whole(folder.resolved_case());
    put(resolved.yaml);
    try {
        write_record(resolved, folder, windows, line, overrides);
    } catch (...) {
        put(before);
        throw;
    }
    return before;
}

/// All windows of the case are done, and the coupler has said so.
bool is_complete(const RunFolder& folder, const ResolvedCase& resolved) {
    const auto record = read_run_json(folder.record());
    const auto done = record.find("windows_done");
    return record.value("status", "") == "done" && done != record.end() &&
           *done == resolved.settings.integer("run.windows");
}

/// To start from the beginning would cost what a run without checkpoints has written.
void require_no_windows(const RunFolder& folder) {
    if (has_windows(folder.root))
        throw refused(folder.root, "has windows that are done, but no checkpoint to go on from",
                      "Start it afresh in another folder, with turbidite run CASE, or add --from "
                      "DIR for its grains.");
}

fs::file_time_type written_at(const fs::path& file) {
    std::error_code gone;
    return fs::last_write_time(file, gone);
}

/// Something is left of a window of this part. Where nothing was written since it began, later rows
/// of the history are those of the part before.
bool has_new_windows(const Resumed& resumed) {
    const RunFolder& folder = resumed.run.folder;
    // A coupler that was ended with the others has not said how many windows were done.
    const auto record = read_run_json(folder.record());
    const nlohmann::ordered_json& part = record["parts"].back();
    if (const auto done = part.find("windows_done"); done != part.end())
        return *done > resumed.windows;
    return CheckpointSets(folder.root).newest_windows() > resumed.windows ||
           (written_at(folder.history()) != resumed.history_written &&
            windows_kept(folder.root) > resumed.windows);
}

}  // namespace

const std::vector<std::string>& keys_that_may_change() {
    static const std::vector<std::string> keys = {"time.end",
                                                  "output.interval",
                                                  "output.fields_interval",
                                                  "output.timeline",
                                                  "checkpoint.",
                                                  "limits.",
                                                  "fluid.ranks",
                                                  "grains.ranks",
                                                  "contact.iterations",
                                                  "contact.tolerance",
                                                  "contact.threads",
                                                  "coupling.iterations",
                                                  "coupling.tolerance",
                                                  "fluid.multiplier_iterations",
                                                  "fluid.multiplier_tolerance",
                                                  "fluid.splitting_iterations",
                                                  "fluid.splitting_tolerance"};
    return keys;
}

std::optional<Resumed> prepare_resumption(const fs::path& given,
                                          const std::vector<std::string>& overrides,
                                          const LaunchSite& site, const Say& say) {
    const RunFolder folder{fs::path(fs::absolute(given / ".").lexically_normal()).parent_path()};
    std::shared_ptr<RunLock> lock = lock_of(folder, given);
    const CheckpointSets sets(folder.root);
    // With the lock: no other process can be writing one.
    sets.remove_unfinished();
    const std::optional<Chosen> chosen = choose(folder, sets, say);
    const ResolvedCase resolved = load_run_folder(folder.root, overrides, Machine::this_one);
    require_path(folder, resolved.settings);
    require_programs(resolved, needed_programs(resolved.settings, site.programs));
    if (chosen)
        check_changes(folder, resolved, *chosen, overrides);
    else if (!overrides.empty())
        check_keys(folder, resolved.settings, load_run_folder(folder.root, {}).settings,
                   "run so far", overrides);
    // After the changes: a later time.end makes a run that was complete go on.
    if (is_complete(folder, resolved)) return std::nullopt;
    if (!chosen) require_no_windows(folder);
    remove_requests(folder);
    fs::create_directories(folder.logs());  // somebody may have removed old ones
    put_aside(folder.logs());
    if (fs::exists(folder.recordings())) put_aside(folder.recordings());
    if (!chosen) {
        say("there is no checkpoint yet; the run starts from the beginning");
        return Resumed{from_the_beginning(resolved, folder, lock, site, overrides)};
    }
    const auto record_before = read_run_json(folder.record());
    prepare_fluid(resolved, folder, *chosen);
    keep_for_recording(resolved, folder, *chosen);
    const auto line = launch_arguments(resolved.settings, folder, site, chosen->name);
    const std::string case_before =
        change_case(resolved, folder, chosen->manifest.windows, line, overrides);
    // Last: what the job relies on is there, also after a power cut.
    put_run_on_disk(folder);
    return Resumed{{folder, lock, line, rank_names(resolved.settings), resolved.settings},
                   chosen->manifest.windows,
                   chosen->manifest.time,
                   case_before,
                   record_before,
                   written_at(folder.history())};
}

bool take_back_overrides(const Resumed& resumed, ExitCode code) {
    const bool refused =
        code == ExitCode::participant_failed || code == ExitCode::handshake_refused;
    if (!refused || resumed.case_before.empty() || has_new_windows(resumed)) return false;
    const RunFolder& folder = resumed.run.folder;
    auto record = read_run_json(folder.record());
    write_whole(folder.resolved_case(), [&](std::ostream& out) { out << resumed.case_before; });
    for (const char* changed : {"case_hash", "windows", "given", "hash_before_pouring"})
        if (resumed.record_before.contains(changed))
            record[changed] = resumed.record_before[changed];
    auto& part = record["parts"].back();
    part["refused_overrides"] = std::exchange(part["overrides"], nlohmann::ordered_json::array());
    write_run_json(folder.record(), record);
    return true;
}

}  // namespace turbidite
