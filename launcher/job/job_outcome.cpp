// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/job_outcome.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <deque>
#include <fstream>
#include <regex>
#include <utility>
#include <vector>

#include "coupler/protocol/files/kept_lines.hpp"
#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/received.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {
namespace {

constexpr std::size_t lines_shown = 6;

/// True for a line that contains the message's first line, or is one of the others.
bool repeats(const std::string& line, const std::string& message) {
    const std::string first = message.substr(0, message.find('\n'));
    const auto words = line.find_first_not_of(' ');
    return !first.empty() && words != std::string::npos &&
           (line.find(first) != std::string::npos ||
            message.find("\n  " + line.substr(words)) != std::string::npos);
}

/// The last lines of a log that say more than `message`, which every program repeats.
std::deque<std::string> last_lines(const std::filesystem::path& file, const std::string& message) {
    std::ifstream input(file);
    std::deque<std::string> lines;
    for (std::string line; std::getline(input, line);) {
        line = received_line(line);
        if (line.empty() || repeats(line, message)) continue;
        lines.push_back(line);
        if (lines.size() > lines_shown) lines.pop_front();
    }
    return lines;
}

std::string tail(const RunFolder& folder, const std::filesystem::path& log,
                 const std::string& message) {
    const auto lines = last_lines(log, message);
    if (lines.empty()) return "";
    std::string text =
        fmt::format("  Last lines of {}:\n", std::filesystem::relative(log, folder.root).string());
    for (const std::string& line : lines) text += "    " + line + "\n";
    return text;
}

std::vector<std::filesystem::path> log_files(const RunFolder& folder) {
    std::vector<std::filesystem::path> files;
    std::error_code gone;
    for (const auto& entry : std::filesystem::directory_iterator(folder.logs(), gone)) {
        const auto& file = entry.path();
        const bool told = file == folder.log("mpirun") || file == folder.log("blockMesh");
        if (file.extension() == ".log" && !told) files.push_back(file);
    }
    std::sort(files.begin(), files.end());
    files.insert(files.begin(), folder.log("mpirun"));
    return files;
}

std::string rank_name(const std::string& number, const std::vector<std::string>& ranks) {
    const auto rank = static_cast<std::size_t>(std::stoul(number));
    return rank < ranks.size() ? ranks[rank] : "world rank " + number;
}

/// Which program ended first according to mpirun; empty if unknown.
std::string first_to_end(const std::filesystem::path& log, const std::vector<std::string>& ranks) {
    static const std::regex by_signal(R"(process rank (\d{1,9}) .* exited on signal (.*)\.)");
    static const std::regex process(R"(Process name: \[\[\d+,\d+\],(\d{1,9})\])");
    static const std::regex status(R"(Exit code: +(\d+))");
    std::ifstream input(log);
    std::string who;
    std::smatch match;
    for (std::string line; std::getline(input, line);) {
        if (std::regex_search(line, match, by_signal))
            return fmt::format("{} was ended by signal {}", rank_name(match[1], ranks),
                               match[2].str());
        if (std::regex_search(line, match, process)) who = rank_name(match[1], ranks);
        if (!who.empty() && std::regex_search(line, match, status))
            return fmt::format("{} ended with status {}", who, match[1].str());
    }
    return "";
}

/// The last error message in the coupler's log, in case the disk was too full for its record; empty
/// if there is none.
std::string last_word(const std::filesystem::path& log) {
    const std::string sign = "turbidite: ";
    std::ifstream input(log);
    std::string word;
    for (std::string line; std::getline(input, line);)
        if (line.rfind(sign, 0) == 0) word = line.substr(sign.size());
    return word;
}

/// The rank of the job that a message is about: its name begins the text, or follows after "from"
/// in the first line; empty if there is none.
std::string rank_of(const std::string& text, const std::vector<std::string>& ranks) {
    const std::string first = text.substr(0, text.find('\n'));
    for (const std::string& rank : ranks)
        if (first.rfind(rank + " ", 0) == 0 || first.rfind(rank + ":", 0) == 0 ||
            first.find(" from " + rank + " ") != std::string::npos)
            return rank;
    return "";
}

/// Logs are named after the role, and the rank if the role has several.
std::filesystem::path log_of(const RunFolder& folder, const std::string& rank) {
    if (rank.empty()) return {};
    const std::string role = rank.substr(0, rank.find(' '));
    // "grains rank 3" has grains.rank3.log, or grains.log if it is the only one.
    const auto own = folder.log(role + ".rank" + rank.substr(rank.rfind(' ') + 1));
    return std::filesystem::exists(own) ? own : folder.log(role);
}

/// What the coupler last saw of a rank: "was due to send "motion", window 5"; empty if unknown. Not
/// from the coupler's log: mpirun ends the coupler with the others, often by SIGKILL at once.
std::string phase_of(const RunFolder& folder, const std::string& rank) {
    const std::regex state("^  " + rank + R"( \(host .*?, pid \d+\) (.*), for \d+ s$)");
    std::string phase;
    std::smatch match;
    for (const std::string& line : kept_lines(wait_table_file(folder.root)))
        if (std::regex_match(line, match, state)) phase = match[1];
    return std::regex_replace(std::regex_replace(phase, std::regex("^is "), "was "),
                              std::regex("^waits "), "waited ");
}

/// Any program may have written who it was: a log is looked for under the names of ranks only.
JobOutcome of_first_end(const RunFolder& folder, const FirstEnd& first,
                        const std::vector<std::string>& ranks) {
    const bool known = std::find(ranks.begin(), ranks.end(), first.who) != ranks.end();
    const std::string rank = known ? first.who : "";
    const std::string phase = known ? phase_of(folder, rank) : "";
    // A replay writes no history.
    const bool replays = !ranks.empty() && ranks.front() == "replay";
    const bool begun = replays || std::filesystem::exists(folder.history());
    const auto log = log_of(folder, rank);
    return {
        first.code,
        fmt::format("{} {}, log {}{}{}", first.who, first.what, log.string(),
                    phase.empty() ? "" : "; it " + phase, begun ? "" : "; the run had not begun"),
        log};
}

/// Whether the signal that ended a program came to this one as well, as batch systems send it to
/// all processes of a job.
bool came_to_all(const FirstEnd& first, int signal) {
    return signal != 0 && first.what.rfind(fmt::format("was ended by signal {} ", signal), 0) == 0;
}

// mpirun returns the exit code of the rank that ended first.
JobOutcome without_a_word(const RunFolder& folder, const JobEnd& end,
                          const std::vector<std::string>& ranks) {
    const bool begun = std::filesystem::exists(folder.history());
    // From the surest to the vaguest: what was done on request, what a program left in writing, the
    // coupler's log, mpirun's own words, its status.
    if (end.killed)
        return {signal_code(end.signal),
                begun ? "killed on request" : "stopped on request before the first window"};
    if (const auto first = read_first_end(folder.root);
        first && !end.crashed && !came_to_all(*first, end.signal))
        return of_first_end(folder, *first, ranks);
    if (end.signal != 0) return {signal_code(end.signal), "stopped on request"};
    if (end.overdue)
        return {ExitCode::stalled, "mpirun has started no program of the job within limits.start"};
    const std::string word = last_word(folder.log("coupler"));
    if (!word.empty()) return {received_code(end.status), word};
    const std::string first = first_to_end(folder.log("mpirun"), ranks);
    if (!first.empty()) return {received_code(end.status), first + "; see its log"};
    return {received_code(end.status),
            fmt::format("mpirun ended with status {} and named no program: it was killed, or a "
                        "program of the job never started",
                        end.status)};
}

JobOutcome of_record(const RunFolder& folder, ExitCode code, const std::string& error,
                     const std::vector<std::string>& ranks) {
    const std::string rank = rank_of(error, ranks);
    return {code, error, log_of(folder, rank.empty() ? "coupler" : rank)};
}

// A message that cannot be saved is still printed.
void keep_outcome(const RunFolder& folder, nlohmann::ordered_json record, JobOutcome& outcome) {
    try {
        write_run_json(folder.record(), record);
    } catch (const std::exception& error) {
        const std::string fault = error.what();
        if (outcome.error.find(fault) == std::string::npos) outcome.error += "; " + fault;
    }
}

std::string how_to_go_on(const RunFolder& folder, ExitCode code) {
    if (code == ExitCode::physics_refused)
        return "If nothing changes, `turbidite resume` ends in the same way; what to try is in "
               "docs/running.md, \"After exit code 6\".\n";
    if (!std::filesystem::exists(folder.checkpoints())) return "";
    return fmt::format("Go on from the last checkpoint: turbidite resume {}\n",
                       shell_line({folder.root.string()}));
}

}  // namespace

ExitCode signal_code(int signal) {
    return signal == SIGINT ? ExitCode::interrupted : ExitCode::terminated;
}

JobOutcome settle_outcome(const RunFolder& folder, const JobEnd& end,
                          const std::vector<std::string>& ranks) {
    auto record = read_run_json(folder.record());
    // The coupler has given its verdict: whatever mpirun says afterwards is a consequence.
    if (const auto code = record.find("exit_code");
        code != record.end() && code->is_number_integer())
        return of_record(folder, static_cast<ExitCode>(code->get<int>()),
                         record.value("error", std::string()), ranks);
    JobOutcome outcome = without_a_word(folder, end, ranks);
    const char* status = end.signal == 0 ? "failed" : "interrupted";
    record["status"] = status;
    if (const auto parts = record.find("parts"); parts != record.end() && !parts->empty()) {
        parts->back()["status"] = status;
        parts->back().erase("windows_done");  // nobody has said how many
    }
    record["exit_code"] = static_cast<int>(outcome.code);
    record["error"] = outcome.error;
    keep_outcome(folder, std::move(record), outcome);
    return outcome;
}

namespace {

/// " and fluid/fluid.foam": what ParaView opens of the fluid; empty if there is nothing.
std::string fluid_for_paraview(const RunFolder& folder) {
    for (const char* file : {"fluid.foam", "fields/fields.pvd", "slices/slices.pvd"})
        if (std::filesystem::exists(folder.fluid() / file))
            return fmt::format(" and fluid/{}", file);
    return "";
}

}  // namespace

std::string outcome_text(const RunFolder& folder, const JobOutcome& outcome) {
    if (outcome.code == ExitCode::done)
        return fmt::format(
            "Done. Results in {}: {}history.csv; for ParaView {}grains/grains.pvd{}.\n",
            folder.root.string(), std::filesystem::exists(folder.report()) ? "report.html, " : "",
            std::filesystem::exists(folder.view()) ? "view.py, " : "", fluid_for_paraview(folder));
    const bool asked_for =
        outcome.code == ExitCode::interrupted || outcome.code == ExitCode::terminated;
    // The cause stands last, beside what to do: logs may be long.
    return fmt::format("{}{}{}\nResults so far in {}. Exit code {}.\n{}",
                       asked_for ? "" : last_words(folder, outcome),
                       asked_for ? "Interrupted: " : "The run failed: ", outcome.error,
                       folder.root.string(), static_cast<int>(outcome.code),
                       how_to_go_on(folder, outcome.code));
}

std::string last_words(const RunFolder& folder, const JobOutcome& outcome) {
    if (!outcome.log.empty()) return tail(folder, outcome.log, outcome.error);
    std::string text;
    for (const auto& log : log_files(folder)) text += tail(folder, log, outcome.error);
    return text;
}

}  // namespace turbidite
