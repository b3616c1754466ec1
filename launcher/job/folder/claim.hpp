// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a coupler asks of its run folder before it writes there. `turbidite run` and `resume` have
// seen to it; the line that their --dry-run prints may be started at any time, and twice: by a
// batch system that repeats the job of a lost node.
#pragma once

#include <memory>
#include <string>

#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/run_lock.hpp"

namespace turbidite {

/// The lock on the folder; null if the launcher of this job holds it. `set`: the checkpoint from
/// which the run goes on; empty: from the beginning. Throws Failure (bad input) if another process
/// has the folder, or if the run has got further than the line knows: nothing is changed then.
std::shared_ptr<RunLock> claim(const RunFolder& folder, const std::string& set);

}  // namespace turbidite
