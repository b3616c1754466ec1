// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/adapter_test/trial.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "launcher/job/job.hpp"
#include "launcher/job/play_run.hpp"
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

Trial play_trial(const Candidate& candidate, const TrialCase& trial,
                 const std::filesystem::path& folder) {
    const auto root = folder / trial.name;
    std::filesystem::create_directories(root);
    write(root / "grains.csv", trial.grains);
    write(root / "trial.yaml", common_case);
    const ResolvedCase resolved = load_case(root / "trial.yaml", overrides_of(candidate, trial));
    LaunchSite site = this_site();
    site.programs.other_fluid = site.programs.partner();
    const PreparedRun prepared = prepare(resolved, {root / "run", true}, site);
    if (trial.stop_at_once) write(prepared.folder.stop(), "143\n");
    ::setenv("TURBIDITE_PROGRESS", "plain", 1);
    const JobEnd end = run_job({.arguments = prepared.line,
                                .error_log = prepared.folder.log("mpirun"),
                                .output_log = prepared.folder.log("output"),
                                .request_stop = [](int) { return false; }});
    if (end.signal != 0)
        throw Failure(ExitCode::interrupted,
                      "adapter-test was interrupted in \"" + trial.name + "\"");
    return {settle_outcome(prepared.folder, end, prepared.ranks),
            read_history(prepared.folder.history()), balance_of(prepared.folder),
            resolved.settings};
}

}  // namespace turbidite
