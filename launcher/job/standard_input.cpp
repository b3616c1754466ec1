// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/standard_input.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

void require(bool done) {
    if (!done)
        throw Failure(
            ExitCode::participant_failed,
            std::string("turbidite: a program cannot be given its input: ") + std::strerror(errno));
}

}  // namespace

void give_standard_input(const std::string& text) {
    const int file = memfd_create("input", 0);
    require(file >= 0);
    for (std::size_t done = 0; done < text.size();) {
        const ssize_t count = write(file, text.data() + done, text.size() - done);
        require(count > 0);
        done += static_cast<std::size_t>(count);
    }
    require(lseek(file, 0, SEEK_SET) == 0 && dup2(file, STDIN_FILENO) == STDIN_FILENO);
    close(file);
}

}  // namespace turbidite
