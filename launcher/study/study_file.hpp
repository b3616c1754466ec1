// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A study file (YAML): cases, each with keys that are swept.
//
//     out: runs/dry-column              # default: runs/<name of the file>
//     parts:
//       column:                         # any name
//         case: avalanche-dry.yaml      # path relative to the study file
//         set: {time.end: 20}           # keys of every run of the part
//         full: {fluid.cells_per_diameter: 16}   # and those that hold without --quick ...
//         quick: {fluid.cells_per_diameter: 8}   # ... and with it
//         sweep:                        # every combination of the values is a run
//           grains.compacity: [0.785, 0.9069]
//           random.seed: [1, 2, 3]
//         variants:                     # named sets of keys, each combined with the sweep
//           nscd: {grains.adapter: standalone-nscd}
//           md: {grains.adapter: yade-md}
//
//     figures: paper                    # further figures and a table, by name (docs/studies.md)
//
// A key of `full` or `quick` that is swept as well takes the place of its whole list. A study of
// one part may write the keys of a part without `parts`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"

namespace turbidite {

/// One value of an axis: how the run is called after it, and the keys that it sets.
struct SweepPoint {
    std::string text;                    ///< "0.785", "nscd"
    std::vector<std::string> overrides;  ///< "key=value", as for --set
};

struct SweepAxis {
    std::string key;  ///< "grains.compacity"; "variant" for the named sets
    std::vector<SweepPoint> points;
};

struct StudyPart {
    std::string name;
    std::filesystem::path case_file;     ///< empty if there is none: one of Study::problems
    std::vector<std::string> overrides;  ///< "key=value" of every run
    std::vector<std::string> full;       ///< of every run without --quick
    std::vector<std::string> quick;      ///< of every run with --quick
    std::vector<SweepAxis> axes;         ///< variants first, then the swept keys in their order
};

struct Study {
    std::string name;  ///< of the file, without its ending
    std::filesystem::path out;
    std::string figures;  ///< a set of figures besides those of every study; empty: none
    std::vector<StudyPart> parts;
    std::vector<CaseProblem> problems;  ///< of the file itself
    std::vector<std::string> command;   ///< the words that play it, for study.json
};

/// The file has `parts` or a `case`: it is a study and not a case. False when it cannot be read.
bool is_study(const std::filesystem::path& file);

/// The file has the groups of a case, and is no study. False when it cannot be read.
bool is_case(const std::filesystem::path& file);

/// Whether a part or a run may be called so: it becomes a folder, which must lie in that of the
/// study, and which OpenFOAM must be able to read.
bool is_folder_name(const std::string& name);

/// Cases are not opened. What is wrong with the file goes into `problems`, so that plan_study can
/// name it together with what is wrong with the cases; throws CaseRefused for a file that cannot be
/// read at all.
Study read_study(const std::filesystem::path& file);

}  // namespace turbidite
