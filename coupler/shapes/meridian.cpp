// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/shapes/meridian.hpp"

namespace turbidite {

NearestPlace nearest_place(const Meridian& meridian, const BesideAxis& point) {
    const BesideAxis edge = meridian[1] - meridian[0];
    const double length = norm(edge);
    const BesideAxis along = (1.0 / length) * edge, offset = point - meridian[0];
    const double place = dot(along, offset);
    // The foot of the perpendicular lies on the meridian.
    if (place >= 0.0 && place <= length) {
        // The direction from its first end to its second, turned by a quarter.
        const BesideAxis across{-along.height, along.radius};
        const double height = dot(across, offset);
        return {(height < 0.0 ? -1.0 : 1.0) * across, std::abs(height), -1};
    }
    const int end = place < 0.0 ? 0 : 1;
    const BesideAxis from_rim = point - meridian[static_cast<std::size_t>(end)];
    const double distance = norm(from_rim);
    // What lies on the rim may leave along the surface.
    if (!(distance > 0.0)) return {(end == 0 ? -1.0 : 1.0) * along, 0.0, end};
    return {(1.0 / distance) * from_rim, distance, end};
}

}  // namespace turbidite
