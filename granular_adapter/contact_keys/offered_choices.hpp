// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Names of contact laws and solvers as the choices of a key.
#pragma once

#include <vector>

#include "coupler/keys/key_spec.hpp"
#include "granular_adapter/nscd/names/contact_names.hpp"

namespace turbidite {

inline std::vector<Choice> offered(const std::vector<nscd::NamedChoice>& names) {
    std::vector<Choice> choices;
    for (const nscd::NamedChoice& entry : names) choices.push_back({entry.name, entry.description});
    return choices;
}

}  // namespace turbidite
