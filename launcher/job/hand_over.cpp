// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/hand_over.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "coupler/protocol/failure.hpp"

namespace turbidite {

void hand_over(std::vector<std::string> line) {
    std::vector<char*> words;
    for (std::string& word : line) words.push_back(word.data());
    words.push_back(nullptr);
    std::fflush(nullptr);
    execv(words[0], words.data());
    throw Failure(ExitCode::participant_failed, "turbidite: " + line.at(0) +
                                                    " cannot be started: " + std::strerror(errno) +
                                                    ". `turbidite doctor` says what is missing.");
}

}  // namespace turbidite
