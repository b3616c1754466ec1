// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/forecast/remarks.hpp"

#include "launcher/case/forecast/courant_forecast.hpp"
#include "launcher/case/forecast/run_cost.hpp"

namespace turbidite {

std::vector<std::string> remarks_of(const ResolvedCase& resolved) {
    std::vector<std::string> remarks;
    for (const std::string& warning :
         {courant_warning(resolved), ranks_warning(resolved), grains_ranks_warning(resolved)})
        if (!warning.empty()) remarks.push_back("warning: " + warning);
    for (const std::string& note : resolved.notes) remarks.push_back("note: " + note);
    return remarks;
}

}  // namespace turbidite
