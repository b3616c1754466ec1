// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the grains of a case come from: a generator, a grains file, or another run.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/keys/entries.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/grains/earlier_run.hpp"
#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/packing.hpp"
#include "launcher/case/grains/population.hpp"

namespace turbidite {

/// The grains of another run, which replace those of the case (--from).
struct EarlierStart {
    EarlierRun run;
    EarlierCase earlier;
    bool poured = false;  ///< the run has poured them: its u_c is sqrt(g D) (packing/pouring.hpp)
};

/// Grains that exist already: those of a run folder, or of another run.
struct GivenGrains {
    std::filesystem::path file = {};
    std::optional<EarlierStart> earlier = {};
};

struct StartGrains {
    Packing grains;
    PopulationSource source;
    std::vector<std::string> notes;
    CaseProblems problems;
};

/// The box of the case, and its sides that whole grains stay inside of.
PackingBox packing_box(const Settings& settings);
SolidSides solid_sides(const Settings& settings);

/// The grains given, else those of grains.file (a path relative to `folder`), else generated ones;
/// to generated ones and to those of another run those of grains.extra_file are added.
/// None if the keys that describe them were refused.
StartGrains start_grains(const Settings& settings, const CaseEntries& entries,
                         const GrainForms& forms, const std::filesystem::path& folder,
                         const GivenGrains& given);

/// Whether the numbers of grains.cylinder describe a cylinder inside the box.
bool is_in_box(const std::vector<double>& cylinder, const PackingBox& box);

/// `file` was named by `key` and does not exist.
CaseProblem missing_file(const CaseEntries& entries, const std::string& key,
                         const std::filesystem::path& file);

}  // namespace turbidite
