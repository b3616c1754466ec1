// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A command of the program `turbidite`: its name, its options, what it does.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace turbidite {

/// Returns the exit code; throws Failure with a message for the user.
using CommandAction = std::function<int()>;

struct Command {
    std::string name;
    std::string help;
    /// Declares the options; the returned action is called after parsing.
    CommandAction (*declare)(CLI::App& options);
};

CommandAction declare_new(CLI::App& options);
CommandAction declare_resume(CLI::App& app);
CommandAction declare_run(CLI::App& options);
CommandAction declare_check(CLI::App& options);
CommandAction declare_replay(CLI::App& app);
CommandAction declare_report(CLI::App& options);
CommandAction declare_compare(CLI::App& options);
CommandAction declare_study(CLI::App& options);
CommandAction declare_gallery(CLI::App& app);
CommandAction declare_adapter_test(CLI::App& options);
CommandAction declare_keys(CLI::App& options);
CommandAction declare_docs(CLI::App& options);
CommandAction declare_doctor(CLI::App& options);
CommandAction declare_test(CLI::App& options);
CommandAction declare_bench(CLI::App& options);
CommandAction declare_yade(CLI::App& options);

}  // namespace turbidite
