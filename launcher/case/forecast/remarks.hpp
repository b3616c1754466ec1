// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>
#include <vector>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// What is to be known of a valid case before it is played: "warning: ...", then "note: ...".
std::vector<std::string> remarks_of(const ResolvedCase& resolved);

}  // namespace turbidite
