// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite-member RUN ROLE FIRST RANKS COMMAND…: starts a program of a job and waits for it. ROLE
// is coupler, fluid or grains, FIRST the world rank of its first rank, RANKS their number.
//
// mpirun notices a program that dies, but not in every case one that ends quietly: if it exits with
// 0 before MPI_Init, the others may wait for it for ever in their own MPI_Init, where nobody can
// watch them. Here it is noticed, since this program does not use MPI: unless the coupler has
// recorded the end of the run, the program left too early, and the exit code 4 makes mpirun end the
// job. Who it was is written to RUN/logs/first_end, and who has been started to RUN/logs/starts
// (start_record.hpp). The output of a participant goes to its log from its very first line.
#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

#include "coupler/output/run_record.hpp"
#include "coupler/protocol/files/freed_memory.hpp"
#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/files/start_record.hpp"
#include "coupler/protocol/files/whole_file.hpp"
#include "coupler/protocol/host_name.hpp"
#include "launcher/case/files/run_folder.hpp"

namespace {

using namespace turbidite;

constexpr int cannot_start = 127;
volatile sig_atomic_t asked_to_end = 0;

struct Member {
    std::filesystem::path run;
    Role role = Role::grains;
    int rank = 0, ranks = 1;
    char** command = nullptr;

    std::filesystem::path record() const { return RunFolder{run}.record(); }
};

Role role_of(const std::string& name) {
    for (const Role role : {Role::coupler, Role::fluid, Role::grains})
        if (name == role_name(role)) return role;
    throw std::invalid_argument("unknown role " + name);
}

/// Rank in the world, as the process manager tells it to every program.
int world_rank() {
    for (const char* name : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK"})
        if (const char* rank = std::getenv(name)) return std::atoi(rank);
    return 0;
}

std::filesystem::path log_of(const Member& member) {
    return log_file(member.run, member.role, member.rank, member.ranks);
}

/// The coupler speaks to the user, and keeps a log of its own.
void open_log(const Member& member) {
    if (member.role == Role::coupler) return;
    const auto file = log_of(member);
    const int log = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0644);
    if (log < 0) return;  // the output then goes where mpirun sends it
    dup2(log, STDOUT_FILENO);
    dup2(log, STDERR_FILENO);
    close(log);
}

[[noreturn]] void become(const Member& member) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    open_log(member);
    const std::string record = begin_start_record(
        member.run,
        {member.role, member.rank, host_name(), getpid(), member.command[0], log_of(member)});
    setenv(member_variable, record.c_str(), 1);
    // Here, too: on another node, or where a user has pasted the launch line.
    ask_for_large_pages();
    execvp(member.command[0], member.command);
    std::fprintf(stderr, "turbidite-member: cannot start %s: %s\n", member.command[0],
                 std::strerror(errno));
    std::fflush(nullptr);
    _exit(cannot_start);
}

// mpirun signals the process group, so the program gets the same signal; this one waits for it.
void outlive_the_program() {
    struct sigaction action {};
    action.sa_handler = [](int) { asked_to_end = 1; };
    action.sa_flags = SA_RESTART;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) sigaction(signal, &action, nullptr);
}

int wait_for(pid_t child) {
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

std::string end_text(const Member& member, int status, pid_t child) {
    const std::string how = WIFSIGNALED(status)
                                ? "was ended by signal " + std::to_string(WTERMSIG(status)) + " (" +
                                      strsignal(WTERMSIG(status)) + ")"
                                : "ended with status " + std::to_string(WEXITSTATUS(status)) +
                                      " before the run was over";
    return how + "; program " + member.command[0] + ", host " + host_name() + ", pid " +
           std::to_string(child);
}

/// Ends like the program, so that mpirun reports the same.
[[noreturn]] void die_of(int signal) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    ::signal(signal, SIG_DFL);
    raise(signal);
    _exit(128 + signal);
}

/// `before`: the record when the program was started; that of an earlier run does not count.
int exit_code(const Member& member, int status, pid_t child, const std::string& before) {
    const bool over = read_whole(member.record()) != before && has_verdict(member.record());
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    if (over || asked_to_end) return code;
    // A folder that is not its own to play in: it has told why, and leaves nothing there.
    if (member.role == Role::coupler && code == static_cast<int>(ExitCode::bad_input)) return code;
    if (!write_first_end(member.run,
                         {ExitCode::participant_failed, rank_name(member.role, member.rank),
                          end_text(member, status, child)}) &&
        code != 0)
        return code;  // it has told its end itself, or another program was first
    return static_cast<int>(ExitCode::participant_failed);
}

int play(const Member& member) {
    // A batch system's, which mpirun passes on: the coupler heeds it, all others go on.
    for (const int signal : {SIGUSR1, SIGUSR2}) ::signal(signal, SIG_IGN);
    const std::string before = read_whole(member.record());
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
    if (child == 0) become(member);
    outlive_the_program();
    const int status = wait_for(child);
    const int code = exit_code(member, status, child, before);
    if (WIFSIGNALED(status)) die_of(WTERMSIG(status));
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 6) {
        std::fprintf(stderr,
                     "usage: turbidite-member RUN ROLE FIRST RANKS COMMAND...   (started by "
                     "mpirun for `turbidite run`)\n");
        return static_cast<int>(ExitCode::bad_input);
    }
    try {
        return play({argv[1], role_of(argv[2]), world_rank() - std::atoi(argv[3]),
                     std::atoi(argv[4]), argv + 5});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "turbidite-member: %s\n", error.what());
        return static_cast<int>(ExitCode::participant_failed);
    }
}
