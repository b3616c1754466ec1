// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The velocity that a case prescribes on a side of the fluid: of a wall that slides along itself
// (domain.SIDE_motion of a wall), or of the fluid that enters (the same of an inflow). An inflow
// has a profile across the side (domain.SIDE_profile), a wall is uniform:
//
//     uniform     v                  v: rate of the motion over a window, prescribed_motion.hpp
//     parabolic   6 v s (1 - s)      s: place along the side, 0 to 1; v is the mean; in the plane
//
// Faces take the mean of the profile over their length, so that the flux through the side does not
// depend on the mesh. Valid C++17.
#pragma once

#include <array>
#include <memory>

#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "coupler/protocol/scene/sides.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct SideMotion {
    std::shared_ptr<const PrescribedMotion> motion;  ///< null: at rest
    bool parabolic = false;

    /// v of the window [time, time + step] [m/s].
    Vec3 velocity(double time, double step) const;

    /// Mean of the profile over [from, to], places along the side, in units of v.
    double share(double from, double to) const;
};

/// What sides with a motion do in a window.
struct MovedSides {
    bool any = false;  ///< there are such sides
    double through =
        0.0;  ///< largest speed of fluid through one [m/s]; walls slide along themselves

    /// v: of a side in the order of box_sides.
    void add(std::size_t side, const Vec3& v);
};

/// Of every side of the box. Throws std::invalid_argument for motions of another format, and for
/// an unknown profile of an inflow.
std::array<SideMotion, box_sides.size()> side_motions(const Settings& settings);

}  // namespace turbidite
