// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/engine/dimension.hpp"

#include <stdexcept>

#include "coupler/shapes/shape.hpp"

namespace turbidite::nscd {

void check_dimension(int dimension, const ShapeTable& shapes) {
    if (dimension != 2 && dimension != 3)
        throw std::invalid_argument("dimension = " + std::to_string(dimension) +
                                    " must be 2 (the plane) or 3 (space)");
    for (const ShapeRecord& shape : shapes)
        if (const int own = make_shape(shape)->dimension(); own != dimension)
            throw std::invalid_argument(
                "shape \"" + shape.kind + "\" is of dimension " + std::to_string(own) +
                ", but the contacts are of dimension " + std::to_string(dimension) +
                (dimension == 3 ? ": in space grains are spheres (grains.shape: sphere)"
                                : ": spheres need dimension: 3"));
}

void check_solver(int dimension, const std::string& name, const ContactSolver& solver) {
    if (dimension == 3 && !solver.solves_space())
        throw std::invalid_argument("contact solver \"" + name +
                                    "\" is of the plane only; in space use nlgs");
}

void check_films(const std::string& name, const ContactSolver& solver) {
    if (!solver.solves_films())
        throw std::invalid_argument("contact solver \"" + name +
                                    "\" solves no films of liquid; with films use nlgs");
}

void check_ranks(const std::string& name, const ContactSolver& solver) {
    if (!solver.solves_on_ranks())
        throw std::invalid_argument("contact solver \"" + name +
                                    "\" works on one rank only; on several use nlgs");
}

}  // namespace turbidite::nscd
