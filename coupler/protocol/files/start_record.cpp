// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/start_record.hpp"

#include <cstdlib>
#include <fstream>

#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/received.hpp"

namespace turbidite {
namespace {

struct StepName {
    StartStep step;
    const char* name;
    const char* missing;
};
constexpr StepName step_names[] = {
    {StartStep::mpi_init, "MPI_Init", "has not called MPI_Init"},
    {StartStep::split, "split",
     "has called MPI_Init, but has not taken part in the split of MPI_COMM_WORLD"},
    {StartStep::announcement, "announcement",
     "has taken part in the split of MPI_COMM_WORLD, but has not announced itself to the coupler"},
    {StartStep::end, "end", "has not ended"},
};
constexpr std::size_t most_named = 4;

std::filesystem::path folder(const std::filesystem::path& run) {
    return run / "logs" / "starts";
}

std::filesystem::path file_of(const std::filesystem::path& run, Role role, int rank) {
    return folder(run) / (std::string(role_name(role)) + "." + std::to_string(rank));
}

/// Four lines in the order in which begin_start_record writes them; without them there is no
/// record.
bool read_head(std::istream& file, StartRecord& record) {
    std::string pid;
    if (!std::getline(file, record.host) || !std::getline(file, pid) ||
        !std::getline(file, record.program) || !std::getline(file, record.log))
        return false;
    for (std::string* text : {&record.host, &record.program, &record.log})
        *text = received_line(*text);
    record.pid = std::atol(pid.c_str());
    return true;
}

std::string who(const StartRecord& record) {
    return rank_name(record.role, record.rank) + " (" + record.program + ", host " + record.host +
           ", pid " + std::to_string(record.pid) + ", log " + record.log + ")";
}

std::string seconds(double limit) {
    std::string text = std::to_string(limit);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text + " s";
}

}  // namespace

std::string begin_start_record(const std::filesystem::path& run, const StartRecord& record) {
    std::error_code exists;
    std::filesystem::create_directories(folder(run), exists);
    const auto file = file_of(run, record.role, record.rank);
    std::ofstream(file) << record.host << "\n"
                        << record.pid << "\n"
                        << record.program << "\n"
                        << record.log << "\n";
    return std::filesystem::absolute(file).string();
}

void note_start(StartStep step) {
    const char* file = std::getenv(member_variable);
    if (!file || !std::filesystem::exists(file)) return;
    for (const StepName& entry : step_names)
        // Closed at once: the line is in the file before the step itself, which may block.
        if (entry.step == step) std::ofstream(file, std::ios::app) << entry.name << "\n";
}

std::string started_log() {
    const char* name = std::getenv(member_variable);
    if (!name) return "";
    std::ifstream file(name);
    StartRecord record;
    return read_head(file, record) ? record.log : "";
}

std::optional<StartRecord> read_start_record(const std::filesystem::path& run, Role role,
                                             int rank) {
    std::ifstream file(file_of(run, role, rank));
    StartRecord record;
    record.role = role;
    record.rank = rank;
    if (!read_head(file, record)) return std::nullopt;
    for (std::string line; std::getline(file, line);)
        for (const StepName& entry : step_names) {
            // Unknown lines are those of other versions.
            if (line != entry.name) continue;
            if (entry.step == StartStep::end)
                record.left = true;
            else
                record.step = entry.step;
        }
    return record;
}

std::vector<StartRecord> not_yet_at(StartStep step, const std::filesystem::path& run,
                                    const std::vector<Role>& roles, const Settings& settings) {
    std::vector<StartRecord> late;
    for (const Role role : roles) {
        const auto ranks = settings.integer(std::string(role_name(role)) + ".ranks");
        for (int rank = 0; rank < ranks; ++rank)
            if (const auto record = read_start_record(run, role, rank);
                // A rank without a record is not named: nothing is known of it.
                record && (step == StartStep::end ? !record->left : record->step < step))
                late.push_back(*record);
    }
    return late;
}

std::vector<StartRecord> left_before(StartStep step, const std::filesystem::path& run,
                                     const std::vector<Role>& roles, const Settings& settings) {
    std::vector<StartRecord> records = not_yet_at(step, run, roles, settings);
    std::erase_if(records, [](const StartRecord& record) { return !record.left; });
    return records;
}

std::string left_text(const std::vector<StartRecord>& left) {
    return who(left.front()) + " has left MPI (MPI_Finalize) without joining the run";
}

std::vector<std::string> hosts_of_started(const std::filesystem::path& run) {
    std::vector<std::string> hosts;
    std::error_code none;
    for (const auto& entry : std::filesystem::directory_iterator(folder(run), none)) {
        std::ifstream file(entry.path());
        // A record that is being written has no host yet.
        if (std::string host; std::getline(file, host)) hosts.push_back(received_line(host));
    }
    return hosts;
}

std::string late_start_text(StartStep step, const std::vector<StartRecord>& late, double limit) {
    if (late.empty())
        return "not all programs of the job have joined within limits.start = " + seconds(limit);
    std::string missing;
    for (const StepName& entry : step_names)
        if (entry.step == step) missing = entry.missing;
    std::string text = "nothing from " + who(late.front()) +
                       " within limits.start = " + seconds(limit) + ": it " + missing;
    for (std::size_t i = 1; i < late.size() && i < most_named; ++i)
        text += "\n  nor from " + who(late[i]);
    if (late.size() > most_named)
        text += "\n  nor from " + std::to_string(late.size() - most_named) + " other ranks";
    return text;
}

std::string late_end_text(const std::vector<StartRecord>& late, double limit) {
    const std::string others =
        late.size() > 1 ? " and " + std::to_string(late.size() - 1) + " other programs" : "";
    return "the run is over, but " + (late.empty() ? "mpirun" : who(late.front())) + others +
           " has not ended within limits.stall_hard = " + seconds(limit) + " and is killed";
}

}  // namespace turbidite
