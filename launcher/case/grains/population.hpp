// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains as a CSV file (header `id,x,y[,z][,radius][,shape][,angle][,vx][,vy][,spin][,density]
// [,material][,motion]`, in space `id,x,y,z[,radius][,shape][,qw,qx,qy,qz][,vx][,vy][,vz][,wx][,wy]
// [,wz][,density][,material][,motion]` with a unit quaternion, lengths in D, angles in rad,
// velocities in u_c, spin in 1/t_c; `grains.shape` and its radius unless given; at rest,
// grains.density_ratio, material default, free), and the checks of any population: unique ids,
// positive radii, no grain outside, no overlaps, all with the true shapes.
#pragma once

#include <array>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "coupler/keys/case_error.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "launcher/case/grains/grain_forms.hpp"
#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

/// `source` and `line(i)` are the origin of grain i for error messages.
struct PopulationSource {
    std::string name;        ///< file name; for generators, the case file
    std::vector<int> lines;  ///< line of each grain; empty for generators
};

struct PopulationFile {
    Packing grains;
    PopulationSource source;
    std::vector<CaseProblem> problems;  ///< rows with a fault, which are no grains
};
PopulationFile read_population_csv(const std::filesystem::path& file,
                                   const GrainForms& forms = plain_discs(),
                                   const std::vector<std::string>& materials = {"default"},
                                   const std::vector<std::string>& motions = {});

/// Numbers round-trip exactly. Columns beyond the radius are written only if a grain needs them.
std::string population_csv(const Packing& grains, const GrainForms& forms = plain_discs(),
                           const std::vector<std::string>& materials = {"default"});

/// By side of the box: at a wall the whole grain must be inside, at other sides its centre.
struct SolidSides {
    std::array<bool, box_sides.size()> solid{true, true, true, true, true, true};
};

/// Overlaps up to `overlap` are accepted [D].
std::vector<CaseProblem> check_population(const Packing& grains, const PopulationSource& source,
                                          const PackingBox& box, const SolidSides& walls,
                                          const GrainForms& forms = plain_discs(),
                                          double overlap = 0.0);

}  // namespace turbidite
