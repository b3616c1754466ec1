// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/run_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace turbidite {

std::shared_ptr<RunLock> RunLock::take(const std::filesystem::path& folder) {
    std::filesystem::path path = folder / file;
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT, 0644);
    if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(descriptor);
        return nullptr;
    }
    return std::shared_ptr<RunLock>(new RunLock(std::move(path), descriptor));
}

RunLock::~RunLock() {
    if (descriptor_ < 0) return;
    ::unlink(file_.c_str());
    ::close(descriptor_);
}

}  // namespace turbidite
