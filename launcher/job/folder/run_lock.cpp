// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <thread>
#include <utility>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

/// Whether the file of this name is still the one that was opened: its owner removes it when it
/// ends.
bool is_current(int descriptor, const std::filesystem::path& path) {
    struct stat opened, named;
    return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// That of a run never has content: one that has is somebody's own file.
bool is_empty(int descriptor) {
    struct stat opened;
    return ::fstat(descriptor, &opened) == 0 && opened.st_size == 0;
}

enum class Try { taken, busy, without_locks };

struct Attempt {
    Try result;
    int descriptor;
};

/// A folder whose lock cannot be looked at may be in use.
Failure cannot_open(const std::filesystem::path& path) {
    return Failure(ExitCode::bad_input,
                   "cannot open " + path.string() + ": " + std::strerror(errno) +
                       "\n  It tells whether a run uses the folder. Make it readable and writable, "
                       "or use another folder.\nNothing was started. Exit code 2.");
}

Failure is_no_lock(const std::filesystem::path& path) {
    return Failure(
        ExitCode::bad_input,
        path.string() +
            " has content: it is a file of yours\n  In the folder of a run or a study an "
            "empty file of this name tells whether it is in use. Rename yours, or use "
            "another folder.\nNothing was started. Exit code 2.");
}

Attempt attempt(const std::filesystem::path& path) {
    // Not O_CLOEXEC: mpirun inherits the descriptor, and with it the lock, as long as the job
    // lives.
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT, 0644);
    if (descriptor < 0) throw cannot_open(path);
    if (!is_empty(descriptor)) {
        ::close(descriptor);
        throw is_no_lock(path);
    }
    const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
    if (!locked && errno != EWOULDBLOCK) return {Try::without_locks, descriptor};
    // A lock on a file that its owner has just removed holds nothing: another try makes a new one.
    if (locked && is_current(descriptor, path)) return {Try::taken, descriptor};
    ::close(descriptor);
    return {Try::busy, -1};
}

}  // namespace

// A process that was killed holds its files a little longer than its name in the process table: a
// `resume` that follows at once has to wait for them.
std::shared_ptr<RunLock> RunLock::take(const std::filesystem::path& folder,
                                       std::chrono::seconds patience) {
    using Clock = std::chrono::steady_clock;
    std::filesystem::path path = folder / file;
    const auto deadline = Clock::now() + patience;
    Attempt got = attempt(path);
    for (; got.result == Try::busy && Clock::now() < deadline; got = attempt(path))
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    if (got.result == Try::busy) return nullptr;
    return std::shared_ptr<RunLock>(new RunLock(std::move(path), got.descriptor));
}

bool RunLock::is_held(const std::filesystem::path& folder) {
    const int descriptor = ::open((folder / file).c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0 && (errno == ENOENT || errno == ENOTDIR)) return false;
    if (descriptor < 0) throw cannot_open(folder / file);
    // A shared lock is enough to ask with, and does not disturb others who ask.
    const bool held = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(descriptor);
    return held;
}

RunLock::~RunLock() {
    if (descriptor_ < 0) return;
    // Before the lock is given up: whoever takes it later finds that the name is gone.
    if (is_empty(descriptor_)) ::unlink(file_.c_str());
    ::close(descriptor_);
}

}  // namespace turbidite
