// SPDX-License-Identifier: GPL-2.0-or-later
//
// The contacts of LAMMPS' last sub-step.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "granular_adapter/lammps/lammps_library.hpp"
#include "granular_adapter/lammps/round_grains.hpp"

namespace turbidite::lammps {

struct Overlaps {
    std::int64_t contacts = 0;
    double deepest = 0.0;  ///< [m]
};

/// Of the pairs that this rank computes, each of which is computed by one rank, and of its grains
/// with walls.
Overlaps overlaps(const Library& lammps, const std::vector<std::string>& wall_fixes);

/// The same contacts one by one, sorted; impulses are their forces times `window` [s].
/// The size of the domain tells which wall it is [m]; a contact slides if its friction is at the
/// limit `friction`.
std::vector<ContactRecord> touching(const Library& lammps, const RoundGrains& grains,
                                    const std::vector<std::string>& wall_fixes, const Vec3& size,
                                    double friction, double window);

}  // namespace turbidite::lammps
