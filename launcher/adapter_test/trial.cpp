// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/trial.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "launcher/case/files/command_words.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/job.hpp"
#include "launcher/job/overdue.hpp"
#include "launcher/job/resume_run.hpp"

namespace turbidite {
namespace {

constexpr auto case_of_all =
    "contact: {friction: 0}\n"
    "coupling: {scheme: split}\n"
    "time: {step: 0.01, end: 0.2}\n"
    "output: {interval: 0.01, fields_interval: 10}\n"
    "limits: {stall_soft: 10, stall_hard: 30, start: 60}\n";

// The mesh belongs to the fluid that is not there, and is as small as the case allows.
constexpr auto case_of_grains_in_plane =
    "domain: {size: [16, 10]}\n"
    "grains: {file: grains.csv, density_ratio: 1.5}\n"
    "fluid: {reynolds: 10, cells_per_diameter: 4, hydrodynamic_radius: 1}\n";

constexpr auto case_of_grains_in_space =
    "dimension: 3\n"
    "domain: {size: [16, 10, 4]}\n"
    "grains: {file: grains.csv, density_ratio: 2.5}\n"
    "fluid: {reynolds: 10, cells_per_diameter: 8}\n";

// The grains of the partner touch nothing, so that they must stay apart.
constexpr auto case_of_fluid_in_plane =
    "domain: {size: [8, 8]}\n"
    "grains: {file: grains.csv, density_ratio: 1.5}\n"
    "fluid: {reynolds: 36, cells_per_diameter: 8, hydrodynamic_radius: 1}\n";

constexpr auto case_of_fluid_in_space =
    "dimension: 3\n"
    "domain: {size: [8, 8, 4]}\n"
    "grains: {file: grains.csv, density_ratio: 2.5}\n"
    "fluid: {reynolds: 36, cells_per_diameter: 6}\n";

std::string case_of(const Candidate& candidate) {
    const bool space = candidate.dimension == 3;
    const char* own = candidate.side == Role::fluid
                          ? (space ? case_of_fluid_in_space : case_of_fluid_in_plane)
                          : (space ? case_of_grains_in_space : case_of_grains_in_plane);
    return std::string(own) + case_of_all;
}

constexpr double middle = 2.0;  // of the depth [D]

/// A table of grains in the plane, with a column z after y.
std::string in_middle_depth(const std::string& table) {
    std::istringstream rows(table);
    std::string result;
    for (std::string row; std::getline(rows, row);) {
        std::size_t third = 0;  // where what follows y begins
        for (int column = 0; column < 3 && third != std::string::npos; ++column)
            third = row.find(',', third + (column > 0));
        const std::string z = result.empty() ? "z" : std::to_string(middle);
        const std::size_t end = std::min(third, row.size());
        result += row.substr(0, end) + "," + z + row.substr(end) + "\n";
    }
    return result;
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file);
    out << text;
    if (!out.flush()) throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

/// The program that plays the other side.
std::vector<std::string> overrides_of(const Candidate& candidate, const TrialCase& trial) {
    std::vector<std::string> all;
    if (candidate.side == Role::fluid)
        all = {"grains.adapter=external",
               "grains.command=" + command_text({find_programs().partner(), "grains"})};
    else
        all = {"grains.adapter=" + candidate.adapter};
    all.push_back(std::string("coupling.recording=") + role_name(candidate.side));
    if (candidate.side == Role::fluid && candidate.adapter != users_program)
        all.push_back("fluid.program=" + candidate.adapter);
    if (candidate.side == Role::grains && !candidate.words.empty())
        all.push_back("grains.command=" + command_text(candidate.words));
    all.insert(all.end(), trial.overrides.begin(), trial.overrides.end());
    return all;
}

std::map<std::string, std::vector<double>> read_history(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string line, cell;
    std::vector<std::string> names;
    std::getline(in, line);
    for (std::istringstream header(line); std::getline(header, cell, ',');) names.push_back(cell);
    std::map<std::string, std::vector<double>> columns;
    while (std::getline(in, line)) {
        std::istringstream row(line + ",");
        for (std::size_t i = 0; i < names.size() && std::getline(row, cell, ','); ++i)
            columns[names[i]].push_back(cell.empty() ? NAN : std::stod(cell));
    }
    return columns;
}

std::map<std::string, double> maxima_of(const RunFolder& folder) {
    std::map<std::string, double> maxima;
    const auto record = read_run_json(folder.record());
    if (const auto of = record.find("maxima"); of != record.end())
        for (const auto& [name, value] : of->items())
            if (value.is_number()) maxima[name] = value;
    return maxima;
}

LaunchSite site_for(const Candidate& candidate) {
    LaunchSite site = this_site();
    if (candidate.side == Role::grains) {
        // The partner takes the place of what the trial does not test.
        site.programs.other_fluid = {site.programs.partner()};
        site.programs.scripted_fluid = true;
    } else {
        site.programs.other_fluid = candidate.words;
    }
    return site;
}

JobEnd start(const std::vector<std::string>& line, const RunFolder& folder,
             const Settings& settings, const std::string& name) {
    // No lines that rewrite themselves: all output goes to files.
    ::setenv("TURBIDITE_PROGRESS", "plain", 1);
    const JobEnd end = run_job({.arguments = under_lock(line),
                                .error_log = folder.log("mpirun"),
                                .output_log = folder.log("output"),
                                .request_stop = [](int) { return false; },
                                .overdue = Overdue(folder, settings),
                                .had_children = [&] { return played_here(folder); }});
    if (end.signal != 0)
        throw Failure(ExitCode::interrupted, "adapter-test was interrupted in \"" + name + "\"");
    return end;
}

Trial read_trial(const RunFolder& folder, const Candidate& candidate, const Settings& settings,
                 JobOutcome outcome) {
    return {std::move(outcome), read_history(folder.history()),
            maxima_of(folder),  settings,
            folder.root,        folder.recording(role_name(candidate.side))};
}

Trial played(const PreparedRun& prepared, const Candidate& candidate, const Settings& settings,
             const std::string& name) {
    const JobEnd end = start(prepared.line, prepared.folder, prepared.settings, name);
    JobOutcome outcome = settle_outcome(prepared.folder, end, prepared.ranks);
    if (outcome.code != ExitCode::done) outcome.log_tail = last_words(prepared.folder, outcome);
    return read_trial(prepared.folder, candidate, settings, std::move(outcome));
}

/// Whether this process has played the whole case there: a folder of --keep may hold runs of
/// another version of the program under test.
class Played {
 public:
    bool has(const RunFolder& folder, const Settings& settings) const {
        const auto at = cases_.find(folder.root);
        return at != cases_.end() && at->second == settings.text("run.hash");
    }
    void note(const RunFolder& folder, const Trial& trial) {
        if (trial.done()) cases_[folder.root] = trial.settings.text("run.hash");
    }

 private:
    std::map<std::filesystem::path, std::string> cases_;
};
Played& trials_so_far() {
    static Played trials;
    return trials;
}

}  // namespace

double Trial::last(const std::string& column) const {
    const auto at = history.find(column);
    return at == history.end() || at->second.empty() ? NAN : at->second.back();
}

double Trial::maximum(const std::string& of) const {
    const auto at = maxima.find(of);
    return at == maxima.end() ? NAN : at->second;
}

Trial play_trial(const Candidate& candidate, const TrialCase& trial,
                 const std::filesystem::path& folder) {
    const auto root = folder / trial.name;
    std::filesystem::create_directories(root);
    write(root / "grains.csv",
          candidate.dimension == 3 ? in_middle_depth(trial.grains) : trial.grains);
    write(root / "trial.yaml", case_of(candidate));
    const ResolvedCase resolved = load_case(root / "trial.yaml", overrides_of(candidate, trial));
    const RunFolder run{root / "run"};
    if (trials_so_far().has(run, resolved.settings))
        return read_trial(run, candidate, resolved.settings, {});
    const PreparedRun prepared = prepare(resolved, {run.root, true}, site_for(candidate));
    if (trial.stop_at_once) write(prepared.folder.stop(), "143\n");
    Trial done = played(prepared, candidate, resolved.settings, trial.name);
    trials_so_far().note(run, done);
    return done;
}

std::optional<Trial> resume_trial(const Candidate& candidate, const TrialCase& trial,
                                  const std::vector<std::string>& changes,
                                  const std::filesystem::path& folder) {
    const RunFolder run{folder / trial.name / "run"};
    // The program claims to save its state, and no set has come of it.
    if (!std::filesystem::exists(run.checkpoints())) return std::nullopt;
    const auto silent = [](const std::string&) {};
    const auto resumed = prepare_resumption(run.root, changes, site_for(candidate), silent);
    if (!resumed) throw Failure(ExitCode::participant_failed, "the trial was complete");
    return played(resumed->run, candidate, load_run_folder(run.root).settings, trial.name);
}

JobOutcome replay_trial(const Candidate& candidate, const TrialCase& trial, const std::string& as,
                        const std::filesystem::path& recording,
                        const std::filesystem::path& folder) {
    const ResolvedCase resolved = load_run_folder(folder / trial.name / "run");
    const auto [run, lock] = own_run_folder({folder / trial.name / as, true}, resolved.name);
    const std::string role = role_name(candidate.side);
    const auto line =
        replay_arguments(resolved.settings, run, site_for(candidate), role, recording);
    prepare_run(resolved, run, line, mesh_of_replay(role));
    return settle_outcome(run, start(line, run, resolved.settings, trial.name),
                          {"replay", role + " rank 0"});
}

}  // namespace turbidite
