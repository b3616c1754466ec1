// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/grains_adapters.hpp"

namespace turbidite {
const std::vector<GrainsAdapter>& grains_adapters() {
    static const std::vector<GrainsAdapter> table = {
#include "launcher/case/grains/grains_adapter_table.def"
    };
    return table;
}

}  // namespace turbidite
