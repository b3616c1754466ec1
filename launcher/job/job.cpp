// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/job.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <utility>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

constexpr int cannot_start = 127;
constexpr std::chrono::seconds grace{5};  // between SIGTERM, which mpirun passes on, and SIGKILL

/// nohup has it ignored, so that the run outlives the terminal.
bool ignores_hangups() {
    struct sigaction now = {};
    return sigaction(SIGHUP, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

sigset_t watched_signals() {
    sigset_t set;
    sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1, SIGCHLD}) sigaddset(&set, signal);
    // Blocked, it would be taken even where it is ignored.
    if (!ignores_hangups()) sigaddset(&set, SIGHUP);
    return set;
}

sigset_t announcements() {
    sigset_t set;
    sigemptyset(&set);
    sigaddset(&set, SIGUSR1);
    return set;
}

/// Signals are queued while the job runs, so none is lost between two checks.
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

/// Through which the child tells why it could not become the program. It is closed when it does.
class StartFault {
 public:
    explicit StartFault(const std::string& program) : program_(program) {
        if (pipe2(ends_, O_CLOEXEC) != 0) throw failure(errno);
    }
    ~StartFault() {
        for (const int end : ends_)
            if (end >= 0) close(end);
    }
    StartFault(const StartFault&) = delete;
    StartFault& operator=(const StartFault&) = delete;

    Failure failure(int error) const {
        return Failure(
            ExitCode::participant_failed,
            program_ + " cannot be started: " + std::strerror(error) + "; is it installed?");
    }

    /// By the child.
    void tell(int error) const {
        if (write(ends_[1], &error, sizeof error) < 0) return;  // nobody is left to hear it
    }

    /// By the parent, once the child has ended. 0: it had become the program.
    int told() {
        close(std::exchange(ends_[1], -1));
        int error = 0;
        return read(ends_[0], &error, sizeof error) == sizeof error ? error : 0;
    }

 private:
    std::string program_;
    int ends_[2] = {-1, -1};
};

void redirect(int stream, const std::filesystem::path& file) {
    const int log = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (log >= 0) dup2(log, stream);
}

[[noreturn]] void become(const JobOrder& order, const sigset_t& mask, pid_t parent,
                         const StartFault& fault) {
    // A session of its own, in which all processes of the job can be found again.
    setsid();
    prctl(PR_SET_PDEATHSIG, SIGTERM);  // a job must not outlive a killed `turbidite`
    // The parent may have died before prctl, which then would never send its signal.
    if (getppid() != parent) _exit(cannot_start);
    // The job must not inherit the blocked signals, or no SIGTERM would reach mpirun.
    sigprocmask(SIG_SETMASK, &mask, nullptr);
    const sigset_t held = announcements();
    sigprocmask(SIG_UNBLOCK, &held, nullptr);
    signal(SIGPIPE, SIG_DFL);
    redirect(STDERR_FILENO, order.error_log);
    if (!order.output_log.empty()) redirect(STDOUT_FILENO, order.output_log);
    // Nothing of the terminal's input goes to the job.
    const int nothing = open("/dev/null", O_RDONLY);
    if (nothing >= 0) dup2(nothing, STDIN_FILENO);
    std::vector<char*> arguments;
    for (const std::string& argument : order.arguments)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    execvp(arguments[0], arguments.data());
    fault.tell(errno);
    _exit(cannot_start);
}

struct Process {
    pid_t id = 0, session = 0;
    bool runs = false;  ///< no zombie
};

/// From /proc/PID/stat: the first and the fourth field after the name in parentheses.
Process process_of(const std::filesystem::path& folder) {
    std::ifstream file(folder / "stat");
    std::string text;
    std::getline(file, text, '\0');
    // The last one: a program's name may contain parentheses and spaces.
    const auto end_of_name = text.rfind(')');
    if (end_of_name == std::string::npos) return {};
    char state = 0;
    int parent = 0, group = 0, session = 0;
    std::sscanf(text.c_str() + end_of_name + 1, " %c %d %d %d", &state, &parent, &group, &session);
    return {std::stoi(folder.filename()), session, state != 'Z'};
}

// mpirun gives every rank its own process group, but they stay in its session.
std::vector<Process> processes_of_session(pid_t session) {
    std::vector<Process> found;
    std::error_code ignored;  // processes may end during the search
    for (const auto& entry : std::filesystem::directory_iterator("/proc", ignored)) {
        const std::string name = entry.path().filename();
        if (name.find_first_not_of("0123456789") != std::string::npos) continue;
        const Process process = process_of(entry.path());
        if (process.session == session) found.push_back(process);
    }
    return found;
}

void kill_session(pid_t session) {
    for (const Process& process : processes_of_session(session)) kill(process.id, SIGKILL);
}

// Checks without reaping the process: until then its session id cannot be reused.
bool has_ended(pid_t child) {
    siginfo_t info{};
    return waitid(P_PID, child, &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == child;
}

void end_session(pid_t child, const BlockedSignals& signals) {
    // To the process group of mpirun, which passes it on.
    kill(-child, SIGTERM);
    using Clock = std::chrono::steady_clock;  // a clock that is set would shorten or stretch it
    const auto deadline = Clock::now() + grace;
    const timespec tick{0, 100'000'000};
    while (!has_ended(child) && Clock::now() < deadline)
        sigtimedwait(&signals.set(), nullptr, &tick);
}

/// Files that cannot be looked at now (a stale handle, say) tell nothing: the next look does.
bool is_so(const std::function<bool()>& question) {
    try {
        return question && question();
    } catch (const std::exception&) {
        return false;
    }
}

/// Whether a program has stayed without its children for too long. Open MPI 4.1's mpirun can wait
/// for itself for ever after MPI_Abort (PMIx_server_finalize).
class LeftAlone {
 public:
    /// To be called every second.
    bool too_long(pid_t child, const std::function<bool()>& had_children) {
        const auto processes = processes_of_session(child);
        const bool alone = std::none_of(
            processes.begin(), processes.end(),
            [child](const Process& process) { return process.runs && process.id != child; });
        // Not before the first child: mpirun takes a moment to start its ranks.
        seconds_ = alone && is_so(had_children) ? seconds_ + 1 : 0;
        return seconds_ > patience;
    }

 private:
    static constexpr int patience = 10;  // [s]

    int seconds_ = 0;
};

int exit_status(int status) {
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

JobEnd watch(pid_t child, const JobOrder& order, const BlockedSignals& signals) {
    JobEnd end;
    LeftAlone left_alone;
    bool left = false;
    const timespec second{1, 0};
    while (!has_ended(child)) {
        // Wakes at a signal at once, else every second for the checks below.
        const int signal = sigtimedwait(&signals.set(), nullptr, &second);
        end.overdue = signal < 0 && is_so(order.overdue);
        left = signal < 0 && order.had_children && left_alone.too_long(child, order.had_children);
        if (end.overdue || left) {
            end_session(child, signals);
            break;
        }
        if (signal == SIGCHLD || signal < 0) continue;
        const bool first = end.signal == 0;
        if (first) end.signal = signal;
        // The first signal asks the run to stop in order. A second one, or a first that finds
        // nobody to ask, ends the job.
        if (first && order.request_stop(signal)) continue;
        end.killed = true;
        end_session(child, signals);
        break;
    }
    kill_session(child);  // a killed mpirun leaves its ranks behind
    int status = 0;
    waitpid(child, &status, 0);
    end.status = exit_status(status);
    end.crashed = WIFSIGNALED(status) && !end.killed && !end.overdue && !left;
    return end;
}

}  // namespace

PipesMayBreak::PipesMayBreak() : before_(signal(SIGPIPE, SIG_IGN)) {}

PipesMayBreak::~PipesMayBreak() {
    signal(SIGPIPE, before_);
}

void hold_announcements() {
    const sigset_t set = announcements();
    sigprocmask(SIG_BLOCK, &set, nullptr);
}

bool announced() {
    const sigset_t set = announcements();
    const timespec now{0, 0};
    return sigtimedwait(&set, nullptr, &now) == SIGUSR1;
}

JobEnd run_job(const JobOrder& order) {
    const BlockedSignals signals;
    StartFault fault(order.arguments.at(0));
    const pid_t self = getpid();
    const pid_t child = fork();
    if (child < 0) throw fault.failure(errno);
    if (child == 0) become(order, signals.old(), self, fault);
    const JobEnd end = watch(child, order, signals);
    // Not by a status: a program of the job may end with any.
    if (const int error = fault.told()) throw fault.failure(error);
    return end;
}

}  // namespace turbidite
