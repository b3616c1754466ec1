// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Walls inside the box as bodies of step 5 whose motion is given. There are two kinds:
//
//     plane   plates (coupler/protocol/scene/plates.hpp) with the outline that contacts see, their
//             round ends as polygons. They have interior points only: a plate of two cells is
//             tight, but boundary points on both sides of it would take its cells for their
//             stencils and let fluid through.
//     space   plates and round walls (coupler/protocol/scene/space_walls.hpp); the fluid sees their
//             faces fluid.surface_shift farther out, as those of spheres
//
// Valid C++17.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "coupler/protocol/scene/mesh_rows.hpp"
#include "coupler/protocol/scene/plates.hpp"
#include "coupler/protocol/scene/space_walls.hpp"
#include "coupler/shapes/shape.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

class ImmersedWalls {
 public:
    /// Reads run.dimension, run.walls and run.wall_motions, and the rows of cells.
    explicit ImmersedWalls(const Settings& settings);

    /// Appends the bodies for the window [time, time + step], with ids below zero. What they refer
    /// to is kept here until the next call. Throws PhysicsRefused for a wall that is too thin for
    /// the rows that it has reached (coupler/shapes/tight_wall.hpp).
    void append(double time, double step, std::vector<ImmersedGrain>& bodies);

 private:
    struct Strip {
        Plate plate;
        std::shared_ptr<const Shape> outline;
        double radius;  // circumscribed [m]
    };
    struct InSpace {
        SpaceWall wall;
        WallBody body;
    };
    void check_rows(GrainId id, const WallSurface& surface, double thickness) const;

    std::vector<Strip> strips_;
    std::vector<InSpace> in_space_;
    std::optional<MeshRows> stretched_;  ///< where rows are [m]
    double diameter_;                    ///< D [m]
};

}  // namespace turbidite
