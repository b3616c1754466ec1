// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The mpirun command line of a prepared run folder: started by `turbidite run`, printed by
// --dry-run.
//
//     mpirun … -n 1 turbidite-coupler RUN : … -n F turbidite-fluid -case RUN/fluid : … -n G
//     <grains>
//
// with `turbidite-member RUN ROLE FIRST RANKS` before every program, which notices when it ends too
// early. The line is self-contained: absolute paths, exported variables. Dry cases have no fluid
// part.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {

struct LaunchSite {
    Programs programs;
    bool as_root = false;       ///< mpirun refuses to run as root without an option
    std::string openfoam = {};  ///< WM_PROJECT_DIR
    std::string python = {};    ///< the user's own PYTHONPATH, appended to ours
};

/// Of this machine and user.
LaunchSite this_site();

/// `mpirun` and the options it needs on this site, before the first program.
std::vector<std::string> mpirun_options(const LaunchSite& site);

/// `checkpoint`: the name of the set from which the run goes on; empty: from the beginning.
std::vector<std::string> launch_arguments(const Settings& settings, const RunFolder& folder,
                                          const LaunchSite& site,
                                          const std::string& checkpoint = "");

/// The same with a recording in the place of the coupler and of the other participant; `role` is
/// "grains" or "fluid".
std::vector<std::string> replay_arguments(const Settings& settings, const RunFolder& folder,
                                          const LaunchSite& site, const std::string& role,
                                          const std::filesystem::path& recording);

/// Name of a rank of the world: "coupler", "fluid rank 0", …
std::vector<std::string> rank_names(const Settings& settings);

/// The line as a launcher starts it that holds the lock on the folder, and goes on holding it.
std::vector<std::string> under_lock(std::vector<std::string> line);

/// Quoted where needed, to be pasted in a shell.
std::string shell_line(const std::vector<std::string>& arguments);

/// The programs that the line starts, to be checked for before the job.
std::vector<std::filesystem::path> needed_programs(const Settings& settings,
                                                   const Programs& programs);

}  // namespace turbidite
