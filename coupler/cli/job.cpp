// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/cli/job.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

constexpr int cannot_start = 127;
constexpr int grace_seconds = 5;  // between SIGTERM, which mpirun passes on, and SIGKILL

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&set, signal);
    return set;
}

/// Signals wait in a queue while the job runs, so none is lost between two looks at it.
class BlockedSignals {
 public:
    BlockedSignals() : set_(watched_signals()) { sigprocmask(SIG_BLOCK, &set_, &old_); }
    ~BlockedSignals() { sigprocmask(SIG_SETMASK, &old_, nullptr); }
    BlockedSignals(const BlockedSignals&) = delete;
    BlockedSignals& operator=(const BlockedSignals&) = delete;

    const sigset_t& set() const { return set_; }
    const sigset_t& old() const { return old_; }

 private:
    sigset_t set_;
    sigset_t old_;
};

[[noreturn]] void become(const JobOrder& order, const sigset_t& mask) {
    setsid();
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // a job must not outlive a killed `turbidite`
    sigprocmask(SIG_SETMASK, &mask, nullptr);
    const int log = open(order.error_log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (log >= 0) dup2(log, STDERR_FILENO);
    const int nothing = open("/dev/null", O_RDONLY);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    std::vector<char*> arguments;
    for (const std::string& argument : order.arguments)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    _exit(cannot_start);
}

/// Session of a process from /proc/PID/stat: the fourth field after the name in parentheses.
pid_t session_of(const std::filesystem::path& process) {
    std::ifstream file(process / "stat");
    std::string text;
    std::getline(file, text, '\0');
    const auto end_of_name = text.rfind(')');
    if (end_of_name == std::string::npos) return 0;
    char state = 0;
    int parent = 0, group = 0, session = 0;
    std::sscanf(text.c_str() + end_of_name + 1, " %c %d %d %d", &state, &parent, &group, &session);
    return session;
}

// mpirun gives every rank a process group of its own, but they stay in its session.
void kill_session(pid_t session) {
    std::error_code ignored;  // processes end while we look
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        if (session_of(entry.path()) == session) kill(std::stoi(name), SIGKILL);
    }
}

bool has_ended(pid_t child, int& status) {
    return waitpid(child, &status, WNOHANG) == child;
}

void end_session(pid_t child, const BlockedSignals& signals, int& status) {
    kill(-child, SIGTERM);
    const std::time_t deadline = std::time(nullptr) + grace_seconds;
    const timespec tick{0, 100'000'000};
    while (std::time(nullptr) < deadline) {
        sigtimedwait(&signals.set(), nullptr, &tick);
        if (has_ended(child, status)) return kill_session(child);
    }
    kill_session(child);
    waitpid(child, &status, 0);
}

int code_of(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

JobEnd watch(pid_t child, const JobOrder& order, const BlockedSignals& signals) {
    JobEnd end;
    int status = 0;
    while (!has_ended(child, status)) {
        const int signal = sigwaitinfo(&signals.set(), nullptr);
        if (signal == SIGCHLD || signal < 0) continue;
        if (end.signal == 0) {
            end.signal = signal;
            order.request_stop(signal);
            continue;
        }
        end.killed = true;
        end_session(child, signals, status);
        break;
    }
    end.status = code_of(status);
    return end;
}

}  // namespace

JobEnd run_job(const JobOrder& order) {
    const BlockedSignals signals;
    const pid_t child = fork();
    if (child < 0)
        throw Failure(ExitCode::participant_failed,
                      "cannot start " + order.arguments.at(0) + ": " + std::strerror(errno));
    if (child == 0) become(order, signals.old());
    const JobEnd end = watch(child, order, signals);
    if (end.status == cannot_start && !end.killed)
        throw Failure(ExitCode::participant_failed,
                      order.arguments.at(0) + " cannot be started: is it installed?");
    return end;
}

}  // namespace turbidite
