// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How much the files of a run take on the disk, before it starts, and whether there is room.
// docs/cluster.md says how well the forecast holds.
#pragma once

#include <filesystem>
#include <string>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// Files of the finished run [GB = 1e9 bytes]: mesh, fields, checkpoints that are kept, series of
/// the grains, history. Recordings, timelines and logs are not counted.
double predicted_disk(const ResolvedCase& resolved);

/// "25 MB", "1.7 GB", "52 GB"
std::string rough_size(double gigabytes);

/// "roughly 52 GB of files are to come, 0.8 GB are free in /data/runs: ..."; empty if there is
/// room, or if the file system does not say. The folder need not exist yet.
std::string lack_of_disk(double gigabytes, const std::filesystem::path& folder);

}  // namespace turbidite
