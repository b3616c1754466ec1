// SPDX-License-Identifier: LGPL-2.1-or-later
//
// run.json as used by this program: written before the job, completed by the coupler at its end.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace turbidite {

/// An empty object if there is no readable file.
nlohmann::ordered_json read_run_json(const std::filesystem::path& file);

/// What the record says of this program: its version and its commit.
nlohmann::ordered_json own_versions();

/// Replaces the file atomically, and the disk has it; throws Failure (exit code 4) if that fails.
void write_run_json(const std::filesystem::path& file, const nlohmann::ordered_json& record);

}  // namespace turbidite
