// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A run folder that survives a power cut: the first checkpoint counts a moment after the job has
// begun, and `turbidite resume` needs case, grains and mesh with it.
#pragma once

#include "launcher/case/files/run_folder.hpp"

namespace turbidite {

/// Waits until the disk has what was prepared in the folder, and the folder's own name. Throws
/// Failure (participant failed) naming a file for which that fails.
void put_run_on_disk(const RunFolder& folder);

}  // namespace turbidite
