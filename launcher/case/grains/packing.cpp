// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/packing.hpp"

#include <algorithm>

#include "launcher/case/grains/lattice.hpp"
#include "launcher/case/grains/pouring.hpp"
#include "launcher/case/grains/random_packing.hpp"
#include "launcher/case/grains/space_lattice.hpp"
#include "launcher/case/grains/space_packing.hpp"

namespace turbidite {

double largest_radius(const Packing& grains) {
    double largest = grains.empty() ? 0.5 : 0.0;
    for (const PlacedGrain& grain : grains) largest = std::max(largest, grain.radius);
    return largest;
}

namespace {

PackingResult not_poured_in_the_plane(const PackingRequest&) {
    PackingResult result;
    result.refusal =
        "Grains of the plane are not poured in this version. Let them fall in a dry run of their "
        "own and start from it with run --from.";
    return result;
}

}  // namespace

const std::vector<GeneratorEntry>& generator_list() {
    static const std::vector<GeneratorEntry> generators = {
        {"lattice", "touching rows of grains.compacity, filled from the lower left corner",
         lattice_packing, space_lattice_packing},
        {"random", "grains.count grains without overlap", random_packing, random_space_packing},
        {"poured", "grains.count spheres that fall and come to rest before the run (dimension: 3)",
         not_poured_in_the_plane, poured_stand_in},
    };
    return generators;
}

}  // namespace turbidite
