// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite docs: the pages as a site on this machine.
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "coupler/protocol/failure.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/hand_over.hpp"
#include "launcher/job/launch_line.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {
namespace {

/// In a checkout the pages may have changed: the site is built anew, which takes some seconds.
void build_site(const Programs& programs) {
    const std::string line = shell_line({programs.python(), "-B", programs.site_script(), "build",
                                         programs.source, programs.site()});
    if (std::system(line.c_str()) != 0)
        throw Failure(ExitCode::participant_failed,
                      "turbidite: the site cannot be built\n  The lines above say why; the pages "
                      "themselves are " +
                          (programs.source / "docs").string() + ".");
}

int show(std::uint16_t port) {
    const Programs programs = find_programs();
    if (!programs.installed) build_site(programs);
    if (!std::filesystem::exists(programs.site() / "index.html"))
        throw Failure(ExitCode::bad_input,
                      "turbidite: there is no " + programs.site().string() +
                          "\n  This installation was made without mkdocs; the pages are in " +
                          (programs.site().parent_path() / "docs").string() + ".");
    hand_over({programs.python(), "-B", programs.site_script(), "show", programs.site(),
               std::to_string(port)});
}

}  // namespace

CommandAction declare_docs(CLI::App& app) {
    const auto port = std::make_shared<std::uint16_t>(0);
    app.add_option("--port", *port, "of the local server; 0: a free one")->capture_default_str();
    return [port] { return show(*port); };
}

}  // namespace turbidite
