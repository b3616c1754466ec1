// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grains of another run at one of its outputs, as the start of a new case: `turbidite run CASE
// --from DIR[@time]`. They keep position, orientation, velocity, spin, size, density, shape and
// material in units of D, u_c and t_c, to the nine digits of the series.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/settings.hpp"
#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/packing.hpp"
#include "launcher/case/scales.hpp"

namespace turbidite {

/// The part of the earlier case that describes its grains files.
struct EarlierCase {
    Scales scales;
    ShapeTable shapes;                   ///< by the index in the files
    std::vector<std::string> materials;  ///< by the index in the files
};

struct EarlierGrains {
    Packing grains;      ///< shapes and materials of the new case
    std::string source;  ///< file they came from
    double time = 0.0;   ///< [t_c] of the earlier run
};

/// DIR and the time after the last @; without a time the end is meant. Throws Failure (bad input)
/// if DIR is not a run folder or the time is not a number.
struct EarlierRun {
    std::filesystem::path folder;
    std::optional<double> time;  ///< [t_c]
};
EarlierRun parse_earlier_run(const std::string& text);

/// Of a start from an earlier run (bad input): what is wrong with it, and what to do.
Failure start_refused(const std::string& fault, const std::string& remedy);

/// Throws Failure (bad input) naming the problem: no series, no output at that time (with the
/// nearest one), a shape or material that the new case does not have.
EarlierGrains read_earlier_grains(const EarlierRun& run, const EarlierCase& earlier,
                                  const GrainForms& forms,
                                  const std::vector<std::string>& materials);

}  // namespace turbidite
