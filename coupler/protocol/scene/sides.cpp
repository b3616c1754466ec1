// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/scene/sides.hpp"

#include "coupler/protocol/failure.hpp"

namespace turbidite {

int dimension_of(const Settings& settings) {
    if (!settings.has("run.dimension")) return 2;
    const std::int64_t dimension = settings.integer("run.dimension");
    if (dimension == 2 || dimension == 3) return static_cast<int>(dimension);
    throw Failure(ExitCode::bad_input, "run.dimension = " + std::to_string(dimension) +
                                           "; allowed are 2 (the plane) and 3 (space)");
}

SideTypes side_types(const Settings& settings) {
    const std::size_t count = side_count(dimension_of(settings));
    SideTypes types;
    for (std::size_t i = 0; i < count; ++i) {
        types[i] = settings.text(box_sides[i].key);
        if (!holds_grains(types[i]) && types[i] != "free" && types[i] != "cyclic")
            throw Failure(ExitCode::bad_input, std::string(box_sides[i].key) + " = \"" + types[i] +
                                                   "\"; allowed are wall, free, cyclic, inflow");
    }
    // Opposite sides follow each other in the table.
    for (std::size_t i = 0; i < count; i += 2)
        if ((types[i] == "cyclic") != (types[opposite(i)] == "cyclic"))
            throw Failure(ExitCode::bad_input, std::string(box_sides[i].key) + " and " +
                                                   box_sides[opposite(i)].key +
                                                   " must both be cyclic, or neither");
    return types;
}

}  // namespace turbidite
