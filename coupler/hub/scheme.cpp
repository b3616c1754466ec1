// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/scheme.hpp"

#include <stdexcept>

namespace turbidite {

const std::vector<SchemeEntry>& scheme_list() {
    static const std::vector<SchemeEntry> schemes = {
        {"split", make_split},
        {"joint", make_joint},
        {"dry", make_dry},
    };
    return schemes;
}

std::unique_ptr<Scheme> make_scheme(const std::string& name, const Settings& settings) {
    for (const SchemeEntry& entry : scheme_list())
        if (name == entry.name) return entry.make(settings);
    throw std::invalid_argument("unknown scheme \"" + name + "\"");
}

}  // namespace turbidite
