// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing.hpp"

#include <algorithm>

#include "launcher/case/grains/lattice.hpp"
#include "launcher/case/grains/random_packing.hpp"
#include "launcher/case/grains/space_lattice.hpp"
#include "launcher/case/grains/space_packing.hpp"

namespace turbidite {

double largest_radius(const Packing& grains) {
    double largest = grains.empty() ? 0.5 : 0.0;
    for (const PlacedGrain& grain : grains) largest = std::max(largest, grain.radius);
    return largest;
}

const std::vector<GeneratorEntry>& generator_list() {
    static const std::vector<GeneratorEntry> generators = {
        {"lattice", "touching rows of grains.compacity, filled from the lower left corner",
         lattice_packing, space_lattice_packing},
        {"random", "grains.count grains without overlap", random_packing, random_space_packing},
    };
    return generators;
}

}  // namespace turbidite
