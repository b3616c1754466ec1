// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/keys/entries.hpp"

#include <algorithm>

namespace turbidite {

const CaseEntry* CaseEntries::find(const std::string& key) const {
    const auto at = std::find_if(entries.begin(), entries.end(),
                                 [&](const CaseEntry& entry) { return entry.key == key; });
    return at == entries.end() ? nullptr : &*at;
}

}  // namespace turbidite
