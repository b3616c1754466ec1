// SPDX-License-Identifier: LGPL-2.1-or-later
//
// run.json as this program uses it: written before the job, completed by the coupler at its end.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace turbidite {

/// An empty object when there is no readable file.
nlohmann::ordered_json read_run_json(const std::filesystem::path& file);

/// Replaces the file in one step; throws Failure (exit code 4) when that cannot be done.
void write_run_json(const std::filesystem::path& file, const nlohmann::ordered_json& record);

}  // namespace turbidite
