// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A command of the program `turbidite`: its name, its options, what it does.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace turbidite {

/// Returns the exit code; throws Failure with a message for the user.
using CommandAction = std::function<int()>;

struct Command {
    std::string name;
    std::string help;
    /// Declares the options; the returned action is called after parsing.
    CommandAction (*declare)(CLI::App& options);
};

/// --set KEY=VALUE, as often as wanted; the values come in the order in which they are given.
inline CLI::Option* add_overrides(CLI::App& app, std::vector<std::string>& overrides,
                                  const std::string& help) {
    const auto add = [&overrides](const std::string& text) { overrides.push_back(text); };
    return app.add_option_function<std::string>("--set", add, help)
        ->trigger_on_parse()
        ->type_name("KEY=VALUE");
}

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
