// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/trial.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "launcher/job/job.hpp"
#include "launcher/job/resume_run.hpp"
#include "launcher/job/run_json.hpp"

namespace turbidite {
namespace {

// The mesh belongs to the fluid that is not there, and is as small as the case allows.
constexpr auto common_case =
    "domain: {size: [16, 10]}\n"
    "grains: {file: grains.csv, density_ratio: 1.5}\n"
    "contact: {friction: 0}\n"
    "fluid: {reynolds: 10, cells_per_diameter: 4, hydrodynamic_radius: 1}\n"
    "coupling: {scheme: split}\n"
    "time: {step: 0.01, end: 0.2}\n"
    "output: {interval: 0.01}\n"
    "limits: {stall_soft: 10, stall_hard: 30, start: 60}\n";

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream out(file);
    out << text;
    if (!out.flush()) throw Failure(ExitCode::participant_failed, "cannot write " + file.string());
}

std::vector<std::string> overrides_of(const Candidate& candidate, const TrialCase& trial) {
    std::vector<std::string> all{"grains.adapter=" + candidate.adapter};
    if (!candidate.command.empty()) all.push_back("grains.command=" + candidate.command);
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

double balance_of(const RunFolder& folder) {
    const auto record = read_run_json(folder.record());
    const auto maxima = record.find("maxima");
    return maxima == record.end() ? NAN : maxima->value("grain_balance", NAN);
}

}  // namespace

double Trial::last(const std::string& column) const {
    const auto at = history.find(column);
    return at == history.end() || at->second.empty() ? NAN : at->second.back();
}

namespace {

/// The launch site with a scripted fluid.
LaunchSite trial_site() {
    LaunchSite site = this_site();
    site.programs.other_fluid = site.programs.partner();
    return site;
}

Trial played(const PreparedRun& prepared, const Settings& settings, const std::string& name) {
    ::setenv("TURBIDITE_PROGRESS", "plain", 1);
    const JobEnd end = run_job({.arguments = prepared.line,
                                .error_log = prepared.folder.log("mpirun"),
                                .output_log = prepared.folder.log("output"),
                                .request_stop = [](int) { return false; }});
    if (end.signal != 0)
        throw Failure(ExitCode::interrupted, "adapter-test was interrupted in \"" + name + "\"");
    return {settle_outcome(prepared.folder, end, prepared.ranks),
            read_history(prepared.folder.history()), balance_of(prepared.folder), settings};
}

}  // namespace

Trial play_trial(const Candidate& candidate, const TrialCase& trial,
                 const std::filesystem::path& folder) {
    const auto root = folder / trial.name;
    std::filesystem::create_directories(root);
    write(root / "grains.csv", trial.grains);
    write(root / "trial.yaml", common_case);
    const ResolvedCase resolved = load_case(root / "trial.yaml", overrides_of(candidate, trial));
    const PreparedRun prepared = prepare(resolved, {root / "run", true}, trial_site());
    if (trial.stop_at_once) write(prepared.folder.stop(), "143\n");
    return played(prepared, resolved.settings, trial.name);
}

std::optional<Trial> resume_trial(const TrialCase& trial, const std::vector<std::string>& changes,
                                  const std::filesystem::path& folder) {
    const RunFolder run{folder / trial.name / "run"};
    if (!std::filesystem::exists(run.checkpoints())) return std::nullopt;
    const auto silent = [](const std::string&) {};
    const auto resumed = prepare_resumption(run.root, changes, trial_site(), silent);
    if (!resumed) throw Failure(ExitCode::participant_failed, "the trial was complete");
    return played(resumed->run, load_run_folder(run.root).settings, trial.name);
}

}  // namespace turbidite
