// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Creates a run folder from a resolved case: case.yaml, grains/initial.csv, run.json, the fluid
// case with its mesh, an empty logs/.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "launcher/case/case_file.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/job/folder/run_lock.hpp"
#include "launcher/job/programs.hpp"

namespace turbidite {

struct RunOrder {
    std::filesystem::path out;  ///< empty: runs/<case name>-<yyyymmdd-hhmmss>
    bool force = false;         ///< empty an existing run folder
    /// Refuse paths that OpenFOAM does not find (openfoam_path.hpp).
    bool for_openfoam = true;
};

/// A run folder, and that nobody else may use it.
struct OwnFolder {
    RunFolder folder;
    std::shared_ptr<RunLock> lock;
};

/// Creates the folder, whose path is absolute. A folder in use is refused (exit code 2), and a
/// non-empty one unless `force`.
OwnFolder own_run_folder(const RunOrder& order, const std::string& case_name);

/// The same for a caller that needs no lock afterwards.
RunFolder make_run_folder(const RunOrder& order, const std::string& case_name);

/// A recorded or scripted fluid needs no mesh.
enum class FluidMesh { built, left_out };

/// `role`: the side that plays, "grains" or "fluid"; the other one is a recording.
FluidMesh mesh_of_replay(const std::string& role);

/// Fills it, and the disk has it. `command` is the launch line, kept in run.json.
void prepare_run(const ResolvedCase& resolved, const RunFolder& folder,
                 const std::vector<std::string>& command, FluidMesh mesh = FluidMesh::built);

/// Adds the script that shows the run in ParaView.
void add_view(const RunFolder& folder, const Programs& programs);

/// The present time, as strftime writes it.
std::string local_time(const char* form);

/// Throws Failure (exit code 2) naming a program of the job, or the compiler of its function
/// objects, that is not built or not installed.
void require_programs(const ResolvedCase& resolved,
                      const std::vector<std::filesystem::path>& needed);

}  // namespace turbidite
