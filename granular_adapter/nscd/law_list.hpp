// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every contact law there is, by name. A new law: one file pair, one line in law_list.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "granular_adapter/nscd/law.hpp"

namespace turbidite::nscd {

struct LawEntry {
    std::string name;
    std::string description;
    std::unique_ptr<const ContactLaw> (*make)(const LawSettings&);
};
const std::vector<LawEntry>& law_list();

/// Throws std::invalid_argument that lists the known laws.
std::unique_ptr<const ContactLaw> make_law(const std::string& name, const LawSettings& settings);

}  // namespace turbidite::nscd
