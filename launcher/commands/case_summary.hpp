// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// A short summary of a valid case: grains, box, mesh, windows, scales, notes.
std::string case_summary(const ResolvedCase& resolved);

}  // namespace turbidite
