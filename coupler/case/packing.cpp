// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/case/packing.hpp"

#include "coupler/case/lattice.hpp"
#include "coupler/case/random_packing.hpp"

namespace turbidite {

const std::vector<GeneratorEntry>& generator_list() {
    static const std::vector<GeneratorEntry> generators = {
        {"lattice", "touching rows of grains.compacity, filled from the lower left corner",
         lattice_packing},
        {"random", "grains.count grains without overlap", random_packing},
    };
    return generators;
}

}  // namespace turbidite
