// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/pour_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <utility>

#include "coupler/keys/key_spec.hpp"
#include "coupler/keys/key_value.hpp"
#include "coupler/protocol/case_hash.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "launcher/case/grains/packing/pouring.hpp"
#include "launcher/job/folder/run_lock.hpp"
#include "launcher/job/resume_run.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

constexpr double piece = 10.0;     // [t_c] played at a time
constexpr double longest = 200.0;  // [t_c]
/// Thousands of grains at rest keep 1e-6 to 3e-5: gaps of 1e-5 D that open and close within a
/// window of 0.01 t_c are speeds of 1e-3 u_c, and single grains in cages go on rolling. What is
/// left at contacts that lie above each other adds up: 71 D of 50,000 spheres, at a tolerance of
/// 1e-3, move up and down as a whole with 0.035 u_c, for ever.
double energy_at_rest(double height, double tolerance) {
    const double speed = tolerance * height;
    return std::max(1e-4, 0.5 * speed * speed);
}

fs::path cache_folder() {
    const char *own = std::getenv("TURBIDITE_CACHE"), *given = std::getenv("XDG_CACHE_HOME"),
               *home = std::getenv("HOME");
    if (own != nullptr && *own != '\0') return fs::path(own) / "poured";
    if (given != nullptr && *given != '\0') return fs::path(given) / "turbidite" / "poured";
    if (home != nullptr && *home != '\0') return fs::path(home) / ".cache" / "turbidite" / "poured";
    return fs::path("runs") / "poured";
}

/// The last row of a table, by column; empty without one.
std::map<std::string, double> last_row(const fs::path& file) {
    std::ifstream in(file);
    std::string names, line, last, name, cell;
    std::getline(in, names);
    while (std::getline(in, line)) last = line;
    std::map<std::string, double> row;
    std::istringstream header(names), cells(last);
    while (std::getline(header, name, ',') && std::getline(cells, cell, ','))
        row[name] = parse_real(cell).value_or(NAN);
    return row;
}

/// The end of the next piece.
double next_end(const fs::path& history) {
    const auto row = last_row(history);
    const auto time = row.find("time");
    if (time == row.end()) return piece;
    // The next multiple of 10 t_c, also after a piece that was interrupted.
    return piece * (std::floor(time->second / piece + 1e-9) + 1.0);
}

/// Of a resolved case the groups that a dry packing depends on; its head has those of the grains.
std::string packing_text(const std::string& yaml) {
    const auto counts = [](const std::string& line) {
        for (const char* group : {"fluid:", "coupling:", "output:", "checkpoint:", "limits:"})
            if (line.rfind(group, 0) == 0) return false;
        return true;
    };
    std::istringstream lines(yaml);
    std::string text;
    bool kept = true;
    for (std::string line; std::getline(lines, line);) {
        if (!line.empty() && line[0] != ' ') kept = counts(line);
        if (kept) text += line + "\n";
    }
    return text;
}

/// Waits until no other process pours these grains.
std::shared_ptr<RunLock> own_turn(const fs::path& pouring) {
    // Not the lock of the run folder, which is free between two pieces.
    const fs::path folder = pouring.string() + ".turn";
    fs::create_directories(folder);
    bool told = false;
    for (;;) {
        if (auto lock = RunLock::take(folder, std::chrono::seconds(1))) return lock;
        if (announced())
            throw Failure(ExitCode::terminated,
                          "interrupted while another run pours the same grains: nothing has been "
                          "played. Exit code 143.");
        if (!std::exchange(told, true))
            tell_on_stderr("another run pours the same grains; this one waits for them, in " +
                           pouring.string());
    }
}

/// No report is made of it.
class WithoutReport {
 public:
    WithoutReport() {
        if (const char* wish = std::getenv("TURBIDITE_REPORT")) before_ = wish;
        ::setenv("TURBIDITE_REPORT", "off", 1);
    }
    ~WithoutReport() {
        if (before_)
            ::setenv("TURBIDITE_REPORT", before_->c_str(), 1);
        else
            ::unsetenv("TURBIDITE_REPORT");
    }
    WithoutReport(const WithoutReport&) = delete;
    WithoutReport& operator=(const WithoutReport&) = delete;

 private:
    std::optional<std::string> before_;
};

[[noreturn]] void end_early(const RunFolder& folder, ExitCode code, const std::string& why) {
    throw Failure(code, fmt::format("the grains are not poured: {}\n  The pouring is in {}; the "
                                    "same command goes on with it, with other limits.* if they are "
                                    "given. The run itself was not started.",
                                    why, folder.root.string()));
}

ResolvedCase load_pouring(const ResolvedCase& resolved, std::int64_t ranks) {
    std::vector<std::string> values = resolved.overrides;
    for (std::string& change : pouring_changes(resolved)) values.push_back(std::move(change));
    values.push_back(fmt::format("grains.ranks={}", ranks));
    try {
        return load_case(resolved.file, values);
    } catch (const CaseRefused& refused) {
        throw Failure(refused.code(),
                      fmt::format("the grains cannot be poured, in a dry run of its own:\n{}",
                                  refused.what()));
    }
}

/// What a piece may change. Limits are those of now, not of the case that began to pour: where one
/// of them has ended it, another goes on.
std::vector<std::string> piece_changes(const ResolvedCase& pouring, const RunFolder& folder) {
    std::vector<std::string> changes{fmt::format("time.end={:g}", next_end(folder.history()))};
    for (const auto& [key, value] : pouring.settings.entries())
        if (key.rfind("limits.", 0) == 0) changes.push_back(key + "=" + value);
    return changes;
}

JobOutcome play_piece(const ResolvedCase& pouring, const RunFolder& folder,
                      const LaunchSite& site) {
    if (!fs::exists(folder.history()))
        return play(prepare(pouring, {folder.root, true}, site), site.programs);
    const auto resumed =
        prepare_resumption(folder.root, piece_changes(pouring, folder), site, tell_on_stderr);
    // It would be asked for ever to go on to an end that it has reached.
    if (!resumed) end_early(folder, ExitCode::participant_failed, "it does not go on");
    return play(resumed->run, site.programs);
}

}  // namespace

bool is_at_rest(const fs::path& history, double tolerance) {
    std::map<std::string, double> row = last_row(history);
    // Grains that begin at rest are not at rest: at least one piece is played. What it leaves when
    // it is interrupted depends on when.
    const double pieces = row.empty() ? 0.0 : row["time"] / piece;
    if (pieces < 0.5 || std::abs(pieces - std::round(pieces)) > 1e-9) return false;
    // Of a bed of even density: its centre is at half its height.
    const double height = 2.0 * row["mean_position_y"];
    return row["kinetic_energy"] < energy_at_rest(height, tolerance);
}

ResolvedCase pouring_case(const ResolvedCase& resolved) {
    return load_pouring(resolved, 1);
}

fs::path poured_grains(const ResolvedCase& resolved, const LaunchSite& site) {
    ResolvedCase pouring = pouring_case(resolved);
    // By what the packing depends on: another run of the same packing finds it.
    const RunFolder folder{fs::absolute(cache_folder() / case_hash(packing_text(pouring.yaml)))};
    const std::shared_ptr<RunLock> turn = own_turn(folder.root);
    const double tolerance = pouring.settings.real("contact.tolerance");
    if (is_at_rest(folder.history(), tolerance)) {
        fmt::print("{} grains were poured before, in {}\n", pouring.population.size(),
                   folder.root.string());
        return folder.root;
    }
    fmt::print("Pouring {} grains, in {}\n", pouring.population.size(), folder.root.string());
    std::fflush(stdout);
    // Discs are poured on one: on several they have other digits, and the packing must not depend
    // on the machine.
    const std::int64_t ranks =
        in_space(pouring.settings) ? best_grains_ranks(pouring.population.size()) : 1;
    pouring = load_pouring(resolved, ranks);
    const WithoutReport without;
    while (!is_at_rest(folder.history(), tolerance)) {
        if (next_end(folder.history()) > longest)
            throw Failure(ExitCode::participant_failed,
                          fmt::format("the grains are not poured: they still move after {} D/u_c, "
                                      "u_c = sqrt(g D)\n  Other friction or restitution may bring "
                                      "them to rest. The pouring is in {}; without this folder it "
                                      "begins anew. The run itself was not started.",
                                      longest, folder.root.string()));
        const JobOutcome outcome = play_piece(pouring, folder, site);
        if (outcome.code != ExitCode::done)
            end_early(folder, outcome.code, "the dry run ended early");
    }
    return folder.root;
}

ResolvedCase with_poured_grains(ResolvedCase resolved, const LaunchSite& site) {
    if (!is_poured(resolved.settings)) return resolved;
    return load_poured(resolved, poured_grains(resolved, site));
}

}  // namespace turbidite
