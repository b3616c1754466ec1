// SPDX-License-Identifier: LGPL-2.1-or-later
//
// From a case file (YAML) to the resolved case: every key with its value, including defaults, the
// placed grains, and the physical values of the run. All problems are collected and thrown together
// (CaseRefused, exit code 2).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"
#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/case_rules.hpp"
#include "launcher/case/files/function_objects.hpp"
#include "launcher/case/grains/packing/packing.hpp"
#include "launcher/case/scales.hpp"

namespace turbidite {

struct ResolvedCase {
    std::string name;                    ///< file name without its ending; names the run folder
    Settings settings;                   ///< all keys and the run.* values, run.hash included
    std::vector<GrainState> population;  ///< run units, in the order of the packing
    ShapeTable shapes;                   ///< GrainState::shape indexes it
    Packing packing;                     ///< the same grains in D
    std::string grains_csv;              ///< the same grains as a grains file
    std::string walls_csv;               ///< walls inside the box; empty if there are none
    std::string script;                  ///< text of grains.script; empty if there is none
    FunctionObjectsFile functions;       ///< fluid.functions; empty if there is none
    std::string yaml;                    ///< resolved case; loads to itself
    std::vector<std::string> notes;      ///< notes for the user, one sentence each
    Scales scales;
    std::filesystem::path file;  ///< the arguments of load_case, for run.json
    std::vector<std::string> overrides;
    std::string from;
    std::vector<std::string> given;  ///< keys that the case file and overrides name
    /// Hash of the case before its grains were poured; empty if they were not.
    std::string hash_before_pouring;
};

/// Whether all shapes of the case are discs.
bool all_round(const ResolvedCase& resolved);

/// Overrides are the arguments of --set, `key=value` with the value in YAML; `from` is the argument
/// of --from, DIR[@time], whose grains replace those of the case.
ResolvedCase load_case(const std::filesystem::path& file,
                       const std::vector<std::string>& overrides = {},
                       const std::string& from = "");

/// A poured case with the grains that its pouring has left (job/pour_grains.hpp).
ResolvedCase load_poured(const ResolvedCase& planned, const std::filesystem::path& pouring);

/// Reads DIR/case.yaml with the grains of DIR/grains/initial.csv: the folder prepared by `turbidite
/// run`. With overrides the case is another one, which the folder does not have yet.
ResolvedCase load_run_folder(const std::filesystem::path& folder,
                             const std::vector<std::string>& overrides = {},
                             Machine machine = Machine::any);

}  // namespace turbidite
