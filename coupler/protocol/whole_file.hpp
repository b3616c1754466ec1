// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Files that a reader may open at any moment of a run.
#pragma once

#include <filesystem>
#include <functional>
#include <ostream>

namespace turbidite {

/// Writes beside `file` (name + ".part") and renames: a reader meets the old content or the new,
/// never half of it. Throws Failure (participant failed) naming `file` where that cannot be done;
/// then the old content is still there and the part is gone.
void write_whole(const std::filesystem::path& file,
                 const std::function<void(std::ostream&)>& content);

}  // namespace turbidite
