// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/wall_images.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "coupler/rigid/vec3.hpp"

namespace turbidite::nscd {
namespace {

/// Smallest and largest shift of a wall along an axis, in periods.
struct Shifts {
    int first = 0, last = 0;
};

/// Those with which [middle - reach, middle + reach] meets [low, high].
Shifts shifts(double middle, double reach, double low, double high, double period) {
    // middle + k period + reach >= low   and   middle + k period - reach <= high
    return {static_cast<int>(std::ceil((low - reach - middle) / period)),
            static_cast<int>(std::floor((high + reach - middle) / period))};
}

/// Where the centres of the bodies are along each axis.
Extent extent(const Bodies& bodies) {
    Extent all{bodies.position.front(), bodies.position.front()};
    for (const Vec3& x : bodies.position)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            all.low[axis] = std::min(all.low[axis], x[axis]);
            all.high[axis] = std::max(all.high[axis], x[axis]);
        }
    return all;
}

Shifts shifts(const Wall& wall, std::size_t axis, const Extent& all, const PeriodicBox& box,
              double reach) {
    if (!box.repeats(static_cast<int>(axis))) return {};
    // An image is as wide as the wall: half its extent adds to the reach.
    const Extent own = extent_of(wall);
    return shifts(0.5 * (own.low[axis] + own.high[axis]),
                  reach + 0.5 * (own.high[axis] - own.low[axis]), all.low[axis], all.high[axis],
                  box.length[axis]);
}

void add_images(const Wall& wall, const Extent& all, const PeriodicBox& box, double reach,
                std::vector<Wall>& images) {
    const Shifts x = shifts(wall, 0, all, box, reach), y = shifts(wall, 1, all, box, reach),
                 z = shifts(wall, 2, all, box, reach);
    for (int i = x.first; i <= x.last; ++i)
        for (int j = y.first; j <= y.last; ++j)
            for (int k = z.first; k <= z.last; ++k) {
                if (i == 0 && j == 0 && k == 0) continue;
                const Vec3 shift{i * box.length[0], j * box.length[1], k * box.length[2]};
                images.push_back(wall);
                images.back().point = wall.point + shift;
                images.back().pivot = wall.pivot + shift;
            }
}

}  // namespace

std::vector<Wall> with_images(const std::vector<Wall>& walls, const Bodies& bodies,
                              const PeriodicBox& box, double reach) {
    std::vector<Wall> all = walls;
    if (bodies.size() == 0 || !box.repeats()) return all;
    const Extent where = extent(bodies);
    for (const Wall& wall : walls)
        if (has_ends(wall)) add_images(wall, where, box, reach, all);
    return all;
}

void name_images(const std::vector<Wall>& walls, std::vector<ContactPoint>& points) {
    std::vector<ContactPoint*> at_walls;
    for (ContactPoint& point : points)
        if (point.wall >= 0) at_walls.push_back(&point);
    const auto wall = [&](const ContactPoint* point) -> const Wall& {
        return walls[static_cast<std::size_t>(point->wall)];
    };
    const auto name = [&](const ContactPoint* point) {
        return std::make_tuple(wall(point).key, point->b, point->feature);
    };
    // Images have the key of their wall, and a polygon, say, may touch two of them with the same
    // corner: equal names follow each other, numbered in the order of the images' places.
    std::sort(at_walls.begin(), at_walls.end(), [&](const auto* p, const auto* q) {
        return std::make_pair(name(p), wall(p).point) < std::make_pair(name(q), wall(q).point);
    });
    std::int32_t same = 0;
    for (std::size_t k = 1; k < at_walls.size(); ++k) {
        ContactPoint& point = *at_walls[k];
        const ContactPoint& before = *at_walls[k - 1];
        // The feature of the one before without the number it has just been given.
        const std::int32_t plain = before.feature - same * features_per_image;
        const bool again =
            wall(&point).key == wall(&before).key && point.b == before.b && point.feature == plain;
        same = again ? same + 1 : 0;
        point.feature += same * features_per_image;
    }
}

}  // namespace turbidite::nscd
