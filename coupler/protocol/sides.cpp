// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/sides.hpp"

#include "coupler/protocol/failure.hpp"

namespace turbidite {

SideTypes side_types(const Settings& settings) {
    SideTypes types;
    for (std::size_t i = 0; i < types.size(); ++i) {
        types[i] = settings.text(box_sides[i].key);
        if (!holds_grains(types[i]) && types[i] != "free" && types[i] != "cyclic")
            throw Failure(ExitCode::bad_input, std::string(box_sides[i].key) + " = \"" + types[i] +
                                                   "\"; allowed are wall, free, cyclic, inflow");
    }
    for (std::size_t i = 0; i < types.size(); i += 2)
        if ((types[i] == "cyclic") != (types[opposite(i)] == "cyclic"))
            throw Failure(ExitCode::bad_input, std::string(box_sides[i].key) + " and " +
                                                   box_sides[opposite(i)].key +
                                                   " must both be cyclic, or neither");
    return types;
}

}  // namespace turbidite
