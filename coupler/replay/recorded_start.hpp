// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace turbidite {

/// The checkpoint with which a recording begins, if its run had been resumed: the folder, relative
/// to that of the run. Throws Failure (bad input) if the file is not a recording.
std::optional<std::string> first_checkpoint(const std::filesystem::path& recording);

}  // namespace turbidite
