// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite bench [NAME] [OPTIONS]: executes turbidite-bench, which has the options (bench/).
#include "launcher/commands/command.hpp"
#include "launcher/job/hand_over.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {
namespace {

[[noreturn]] int run_bench(const std::vector<std::string>& arguments) {
    const Programs programs = find_programs();
    require_checkout(programs, "benchmarks");
    std::vector<std::string> line{programs.bench()};
    line.insert(line.end(), arguments.begin(), arguments.end());
    hand_over(std::move(line));
}

}  // namespace

CommandAction declare_bench(CLI::App& app) {
    app.set_help_flag();  // --help is passed on, like everything else
    app.prefix_command();
    return [&app]() -> int { return run_bench(app.remaining()); };
}

}  // namespace turbidite
