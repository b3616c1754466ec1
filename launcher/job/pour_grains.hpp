// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <filesystem>

#include "launcher/case/case_file.hpp"
#include "launcher/job/launch_line.hpp"

namespace turbidite {

/// The case of the run that pours the grains of a poured case, dry and on one rank. Throws Failure
/// if its grains cannot be poured so.
ResolvedCase pouring_case(const ResolvedCase& resolved);

/// The run that pours the grains of a poured case (pouring.hpp), which is played until they are at
/// rest unless that was done before: its folder is named by the hash of its case, below
/// XDG_CACHE_HOME or ~/.cache. One that was interrupted goes on. Throws Failure if it does not end
/// well, or grains are not at rest after 200 t_c.
std::filesystem::path poured_grains(const ResolvedCase& resolved, const LaunchSite& site);

/// The case with its grains poured, where they are to be; any other case as it is. Throws as above.
ResolvedCase with_poured_grains(ResolvedCase resolved, const LaunchSite& site);

/// Whether the last row of a history.csv is that of the end of a piece of 10 t_c, and has a mean
/// kinetic energy that grains at rest may keep [m u_c2]: 1e-4, and in a high packing (t h)^2/2,
/// with its height h [D] and contacts solved to the tolerance t [u_c].
bool is_at_rest(const std::filesystem::path& history, double tolerance);

}  // namespace turbidite
