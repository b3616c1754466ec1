// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite docs: the pages as a site on this machine.
#include <cstdint>
#include <memory>

#include "coupler/protocol/failure.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/hand_over.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {
namespace {

int show(std::uint16_t port) {
    const Programs programs = find_programs();
    // In a checkout the pages may have changed: the site is built anew, which takes some seconds.
    if (!programs.installed)
        hand_over({programs.python(), "-B", programs.site_script(), "fresh", programs.source,
                   programs.site(), std::to_string(port)});
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
