// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box (coupler/protocol/scene/plates.hpp) as bodies of step 5, with the outline
// that contacts see, their round ends as polygons. They have interior points only: a plate of two
// cells is tight, but boundary points on both sides of it would take its cells for their stencils
// and let fluid through. Valid C++17.
#pragma once

#include <memory>
#include <vector>

#include "coupler/protocol/scene/plates.hpp"
#include "coupler/shapes/shape.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

class ImmersedPlates {
 public:
    /// Reads run.walls and run.wall_motions.
    explicit ImmersedPlates(const Settings& settings);

    /// Bodies for the window [time, time + step], with ids below zero. Their shapes are kept here.
    std::vector<ImmersedGrain> bodies(double time, double step) const;

 private:
    struct Entry {
        Plate plate;
        std::shared_ptr<const Shape> outline;
        double radius;  // circumscribed [m]
    };
    std::vector<Entry> plates_;
};

}  // namespace turbidite
