// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite test: ctest in the folder this program was built in, on all cores.
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <thread>

#include "coupler/protocol/failure.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {
namespace {

// Tests that start MPI jobs have one of these labels.
constexpr auto slow_labels = "system|physics|protocol";

int test(bool unit_only) {
    const Programs programs = find_programs();
    require_checkout(programs, "tests");
    // One more than there are cores: a job whose programs start or are waited for keeps none busy.
    const unsigned at_once = 1 + std::max(1u, std::thread::hardware_concurrency());
    std::vector<std::string> line{"ctest",
                                  "--test-dir",
                                  programs.build(),
                                  "--parallel",
                                  std::to_string(at_once),
                                  "--output-on-failure"};
    if (unit_only) line.insert(line.end(), {"-LE", slow_labels});
    // All jobs of the tests play on this machine: mpirun need not look for fast networks, which
    // takes a quarter of a second for each of them.
    ::setenv("OMPI_MCA_pml", "ob1", 0);
    std::fflush(nullptr);
    const bool passed = std::system(shell_line(line).c_str()) == 0;
    return static_cast<int>(passed ? ExitCode::done : ExitCode::tests_failed);
}

}  // namespace

CommandAction declare_test(CLI::App& app) {
    const auto unit_only = std::make_shared<bool>(false);
    app.add_flag("--unit", *unit_only, "leave out the tests that run whole jobs");
    return [unit_only] { return test(*unit_only); };
}

}  // namespace turbidite
