// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mpirun line of a prepared run folder: what `turbidite run` starts and --dry-run prints.
//
//     mpirun … -n 1 turbidite-coupler RUN : … -n F turbidite-fluid -case RUN/fluid : … -n G
//     <grains>
//
// It carries all it needs: absolute paths, exported variables. Dry cases have no fluid part.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "launcher/case/run_folder.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {

struct LaunchSite {
    Programs programs;
    bool as_root = false;       ///< mpirun refuses root unless told
    std::string openfoam = {};  ///< WM_PROJECT_DIR
    std::string python = {};    ///< the user's own PYTHONPATH, kept behind ours
};

/// Of this machine and user.
LaunchSite this_site();

/// `mpirun` and what it needs on this site, before the first program.
std::vector<std::string> mpirun_options(const LaunchSite& site);

std::vector<std::string> launch_arguments(const Settings& settings, const RunFolder& folder,
                                          const LaunchSite& site);

/// Who a rank of the world is, by its number: "coupler", "fluid rank 0", …
std::vector<std::string> rank_names(const Settings& settings);

/// Quoted where needed, to be pasted in a shell.
std::string shell_line(const std::vector<std::string>& arguments);

/// The programs that the line starts, to be looked for before the job.
std::vector<std::filesystem::path> needed_programs(const Settings& settings,
                                                   const Programs& programs);

}  // namespace turbidite
