// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of grains adapters with one additional entry, for programs that link this file instead
// of the case library's table.
#include "launcher/case/grains/grains_adapters.hpp"

namespace turbidite {

const std::vector<GrainsAdapter>& grains_adapters() {
    static const std::vector<GrainsAdapter> table = {
#include "launcher/case/grains/grains_adapter_table.def"
        {.name = "falling",
         .help = "grains that touch nothing",
         .file = "turbidite-falling-grains",
         .shapes = {"disc"}},
    };
    return table;
}

}  // namespace turbidite
