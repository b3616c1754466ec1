// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/case/run_folder.hpp"
#include "coupler/cli/programs.hpp"

namespace turbidite {

/// Runs coupler/cli/report/report.py; false when it failed, its words on stderr.
bool write_report(const RunFolder& folder, const Programs& programs);

}  // namespace turbidite
