// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/doctor/command_output.hpp"

#include <sys/wait.h>

#include <cstdio>
#include <sstream>

#include "coupler/protocol/failure.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {

// In the foreground, so that Ctrl-C reaches the command as well.
CommandOutput output_of(const std::vector<std::string>& line) {
    const std::string command = "timeout --foreground 30 " + shell_line(line) + " 2>&1 </dev/null";
    std::FILE* pipe = popen(command.c_str(), "r");
    if (pipe == nullptr)
        throw Failure(ExitCode::participant_failed, "cannot start a shell for: " + command);
    CommandOutput output;
    for (int c; (c = std::fgetc(pipe)) != EOF;) output.text += static_cast<char>(c);
    const int status = pclose(pipe);
    output.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return output;
}

std::string word_after(const std::string& start, const std::string& text) {
    const auto at = text.find(start);
    if (at == std::string::npos) return "";
    const auto from = at + start.size();
    return text.substr(from, text.find_first_of(" )\n", from) - from);
}

std::string first_words(const std::string& text) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (const auto at = line.find_first_not_of(" \t");
            at != std::string::npos && line.compare(at, 2, "--") != 0)
            return line.substr(at);
    return "";
}

}  // namespace turbidite
