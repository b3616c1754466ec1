// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite keys: the reference of the case file, as docs/case-reference.md or for a terminal.
#include <fmt/format.h>
#include <unistd.h>

#include <memory>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/keys/key_reference.hpp"
#include "launcher/commands/command.hpp"
#include "launcher/commands/key_schema.hpp"
#include "launcher/job/terminal.hpp"

namespace turbidite {
namespace {

struct KeysOptions {
    std::vector<std::string> names;
    bool markdown = false, schema = false;
};

int print_keys(const KeysOptions& options) {
    const bool for_a_file = options.names.empty() && !isatty(STDOUT_FILENO);
    if (options.schema)
        fmt::print("{}", key_schema());
    else if (options.markdown || for_a_file)
        fmt::print("{}", key_reference(options.names));
    else
        fmt::print("{}", key_help(options.names, terminal_width()));
    return static_cast<int>(ExitCode::done);
}

}  // namespace

CommandAction declare_keys(CLI::App& app) {
    const auto options = std::make_shared<KeysOptions>();
    app.add_option("NAME", options->names,
                   "groups or keys, for example contact or fluid.reynolds; default: all");
    app.add_flag("--markdown", options->markdown,
                 "tables as in docs/case-reference.md, also what a file or pipe gets of all keys");
    app.add_flag("--schema", options->schema,
                 "a JSON Schema of all keys, with which editors complete and check case files");
    return [options] { return print_keys(*options); };
}

}  // namespace turbidite
