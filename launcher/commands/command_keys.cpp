// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite keys: the reference of the case file (docs/case-reference.md).
#include <fmt/format.h>

#include "coupler/protocol/failure.hpp"
#include "launcher/case/key_reference.hpp"
#include "launcher/commands/command.hpp"

namespace turbidite {

CommandAction declare_keys(CLI::App&) {
    return [] {
        fmt::print("{}", key_reference());
        return static_cast<int>(ExitCode::done);
    };
}

}  // namespace turbidite
