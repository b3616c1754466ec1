// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// What a program of the job says of itself. The program may be anybody's: its exit code is taken
/// for one of ours only if it is one, and its texts are made fit for the record, which is UTF-8,
/// and for a terminal, which obeys control characters. Valid C++17.
#pragma once

#include <cstdint>
#include <string>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/hello.hpp"

namespace turbidite {

/// The exit code by which a program may end the run: 3 to 6. Anything else, the code of success
/// among it, is that of a failed participant.
ExitCode received_code(std::int64_t code);

/// The text with U+FFFD for every byte that is not UTF-8 and every control character but line ends
/// and tabs.
std::string received_text(const std::string& text);

/// The same in one line: line ends and tabs become spaces.
std::string received_line(const std::string& text);

/// With all its texts as lines.
Hello received(Hello hello);

}  // namespace turbidite
