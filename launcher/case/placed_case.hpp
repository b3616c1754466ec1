// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A case whose keys are valid, with what its files hold: grains, walls inside the box, a script.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "launcher/case/files/function_objects.hpp"
#include "launcher/case/grains/start_grains.hpp"
#include "launcher/case/walls/inner_walls.hpp"

namespace turbidite {

struct PlacedCase {
    std::optional<GrainForms> forms;  ///< none if the keys that define them were refused
    StartGrains start;
    std::vector<InnerWall> walls;
    std::string script;             ///< text of grains.script; empty if there is none
    FunctionObjectsFile functions;  ///< fluid.functions; empty if there is none
    CaseProblems problems;
};

/// Reads the files that the settings name (paths relative to `folder`) and checks what is in them.
/// `faults` says that other problems were found: keys may then be missing, and checks that need
/// them are left out.
PlacedCase place(const Settings& settings, const CaseEntries& entries,
                 const std::filesystem::path& folder, const GivenGrains& given, bool faults);

/// The run folder contains copies of the grains, walls, script and function objects, and the
/// resolved case names these copies, so that the folder can be moved to another machine.
inline constexpr auto copied_grains = "grains/initial.csv";
void name_copies(Settings& settings);

/// Whether the value of a key is a file that the run folder has a copy of.
bool names_copy(const std::string& key);

}  // namespace turbidite
