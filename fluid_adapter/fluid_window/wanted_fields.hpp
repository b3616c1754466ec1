// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which fields besides u and p a case asks for (output.fields). Valid C++17.
#pragma once

#include <sstream>
#include <string>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

inline bool is_wanted(const Settings& settings, const std::string& field) {
    if (!settings.has("output.fields")) return false;
    std::istringstream names(settings.text("output.fields"));
    for (std::string name; names >> name;)
        if (name == field) return true;
    return false;
}

}  // namespace turbidite
