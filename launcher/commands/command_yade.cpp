// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite yade SCRIPT: YADE with the contact engine available to its scripts (docs/yade.md).

#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include "launcher/commands/command.hpp"
#include "launcher/job/hand_over.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {
namespace {

constexpr int most_threads = 1024;

struct YadeOptions {
    std::string script;
    int threads = 1;
    bool interactive = false;
    std::vector<std::string> arguments;  ///< of the script
};

void show_packages_to_python(const std::string& folder) {
    const char* before = std::getenv("PYTHONPATH");
    const std::string path = before && *before ? folder + ":" + before : folder;
    setenv("PYTHONPATH", path.c_str(), 1);
}

// Without -x an error opens a prompt, and an unattended script would wait forever.
std::vector<std::string> command_line(const YadeOptions& options, const Programs& programs) {
    std::vector<std::string> line{programs.yade(), "-j", std::to_string(options.threads)};
    if (!options.interactive) line.insert(line.end(), {"-n", "-x"});
    line.push_back(options.script);
    line.insert(line.end(), options.arguments.begin(), options.arguments.end());
    return line;
}

int run_yade(const YadeOptions& options) {
    const Programs programs = find_programs();
    show_packages_to_python(programs.yade_folder());
    hand_over(command_line(options, programs));
}

}  // namespace

CommandAction declare_yade(CLI::App& app) {
    const auto options = std::make_shared<YadeOptions>();
    app.add_option("SCRIPT", options->script, "Python script or saved scene of YADE")
        ->required()
        ->check(CLI::ExistingFile);
    app.add_option("-j,--threads", options->threads, "threads of YADE's own engines")
        ->check(CLI::Range(1, most_threads));
    app.add_flag("--interactive", options->interactive,
                 "with YADE's prompt, and its 3-D view if there is a display");
    app.prefix_command();  // arguments after the script belong to the script
    return [options, &app] {
        options->arguments = app.remaining();
        return run_yade(*options);
    };
}

}  // namespace turbidite
