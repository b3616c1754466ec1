// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Lattices of spheres of diameter D, from the lower left front corner of the box. With touching
// neighbours the edge of the cubic cell is a, with N spheres in it:
//
//     sc    a = 1          N = 1      phi = pi/6             0.5236
//     bcc   a = 2/sqrt 3   N = 2      phi = sqrt 3 pi/8      0.6802
//     fcc   a = sqrt 2     N = 4      phi = pi/(3 sqrt 2)    0.7405, the densest packing of spheres
//
// A smaller compacity stretches the lattice by (phi_densest/phi)^(1/3) in all directions. Every
// site whose sphere is inside the region has one, so that spheres do not meet across cyclic sides.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"
#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

struct SpaceLattice {
    std::string name;  ///< grains.lattice
    std::string help;
    double edge = 1.0;        ///< of the cubic cell when neighbours touch [D]
    std::vector<Vec3> sites;  ///< in the cell, in units of its edge

    double densest() const;  ///< compacity when neighbours touch
};

/// fcc, bcc, sc.
const std::vector<SpaceLattice>& space_lattices();

/// Throws std::invalid_argument for a name that is not one of them.
const SpaceLattice& space_lattice(const std::string& name);

/// Spheres of this radius [D] on the lattice stretched to a compacity, from the corner of the
/// region; the lowest ones if there are more than `most`.
Packing lattice_sites(const SpaceLattice& lattice, const PackingRegion& region, double radius,
                      double compacity, std::size_t most = SIZE_MAX);

/// Values up to 1e-3 above the densest compacity are clamped with a note, larger ones refused.
PackingResult space_lattice_packing(const PackingRequest& request);

/// Sets grains.compacity of a case in space that gives none: that of its lattice.
void choose_compacity(Settings& settings);

}  // namespace turbidite
