// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/plane/polygon_contacts.hpp"

#include <cmath>
#include <limits>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/narrow_phase.hpp"
#include "granular_adapter/nscd/detection/plane/polygon_manifold.hpp"

namespace turbidite::nscd {
namespace {

// Of half a plate: a place that is nearer to its end is the end.
constexpr double end_share = 1e-9;

constexpr double infinite = std::numeric_limits<double>::infinity();

std::int32_t feature_of(std::int32_t corner, bool of_larger_id) {
    return 2 * corner + (of_larger_id ? 1 : 0);
}

/// The side over which a point is highest, and its height.
struct Nearest {
    int side = 0;
    double height = -infinite;
};

Nearest nearest_side(const PolygonView& polygon, double x, double y) {
    Nearest nearest;
    for (int k = 0; k < polygon.sides; ++k) {
        // h_k = n_k . x - support_k; inside the polygon all of them are negative.
        const double height = polygon.nx[k] * x + polygon.ny[k] * y - polygon.support[k];
        if (height > nearest.height) nearest = {k, height};
    }
    return nearest;
}

/// Normal from the polygon to a point, distance (negative inside), feature.
struct Approach {
    Vec3 normal{};
    double distance = 0.0;
    std::int32_t feature = 0;
};

Approach approach(const PolygonView& polygon, const Nearest& nearest, double x, double y) {
    const int k = nearest.side, next = polygon.after(k);
    const Vec3 side_normal{polygon.nx[k], polygon.ny[k], 0.0};
    // Place along the side, (e_z x n) . (p - corner k).
    const auto along = [&](double px, double py) {
        return side_normal[0] * (py - polygon.y[k]) - side_normal[1] * (px - polygon.x[k]);
    };
    const double t = along(x, y);
    const bool beyond = t > along(polygon.x[next], polygon.y[next]);
    // Inside, the side over which the point is highest has the smallest overlap. Outside, the
    // nearest place is on that side or at the corner beyond which the point lies.
    if (nearest.height <= 0.0 || (t >= 0.0 && !beyond)) return {side_normal, nearest.height, 2 * k};
    const int corner = beyond ? next : k;
    const Vec3 line{x - polygon.x[corner], y - polygon.y[corner], 0.0};
    const double distance = norm(line);
    return {(1.0 / distance) * line, distance, 2 * corner + 1};
}

/// The corners of a segment as seen from the side of the body.
struct Plate {
    double x[2], y[2], nx[1], ny[1], support[1] = {0.0};

    Plate(const Wall& wall, const Vec3& normal) : nx{normal[0]}, ny{normal[1]} {
        // End -L and end L along e_z x n, relative to the wall's point.
        for (const int end : {0, 1}) {
            const double place = end == 0 ? -wall.half_length : wall.half_length;
            x[end] = -place * normal[1];
            y[end] = place * normal[0];
        }
    }

    PolygonView view(double half_length) const {
        return {x, y, nx, ny, support, 2, 1, half_length, 0.0};
    }
};

/// Whether a point is none since another plate leads on from the end at which it is
/// (plate_joints.hpp). A point whose normal is that of the plate's own side is always one.
bool leads_on(const WallView& view, const ManifoldPoint& p) {
    if (p.turns_with == 1) return false;
    const Vec3 normal{p.nx, p.ny, 0.0}, middle{p.x, p.y, 0.0};
    // On the plate, along it from its middle.
    const double at = dot(cross({0, 0, 1}, view.wall.normal), middle - 0.5 * p.gap * normal);
    const bool inside = std::abs(at) < view.wall.half_length * (1.0 - end_share);
    return !inside && !view.placed->plates.is_nearest(view.wall_index, at > 0.0, normal);
}

/// A corner of the body that a side of the wall with this normal holds.
ContactPoint held_corner(const WallView& view, int k, double gap, const Vec3& normal,
                         double length) {
    const PolygonView polygon = view.placed->polygons[view.body];
    const Vec3 arm{polygon.x[k], polygon.y[k], 0.0};
    return {-1,     view.body, view.wall_index, feature_of(k, true), gap, normal, Vec3{}, arm,
            length, 1};
}

/// The corners over a plate, whose side holds them with this normal; in a valley also those that
/// are deeper than they are beyond the end.
void corners_over(const WallView& view, const Vec3& normal, std::vector<ContactPoint>& points) {
    const PolygonView polygon = view.placed->polygons[view.body];
    const Vec3 offset = view.bodies.position[view.body] - view.wall.point;
    for (int k = 0; k < polygon.corners; ++k) {
        const Vec3 arm{polygon.x[k], polygon.y[k], 0.0};
        const double gap = dot(normal, offset + arm);
        const double at = dot(cross({0, 0, 1}, view.wall.normal), offset + arm);
        const double beyond = std::abs(at) - view.wall.half_length;
        if (gap < view.alert &&
            (beyond <= 0.0 ||
             (beyond <= -gap && view.placed->plates.is_valley(view.wall_index, at > 0.0, normal))))
            points.push_back(held_corner(view, k, gap, normal, 0.0));
    }
}

void polygon_segment(const WallView& view, std::vector<ContactPoint>& points) {
    const Vec3 offset = view.bodies.position[view.body] - view.wall.point;
    // A plate holds a body on the side on which its centre lies.
    const double sign = dot(view.wall.normal, offset) < 0.0 ? -1.0 : 1.0;
    const Plate plate(view.wall, sign * view.wall.normal);
    const Manifold manifold =
        polygon_manifold(plate.view(view.wall.half_length), view.placed->polygons[view.body],
                         offset[0], offset[1], view.alert);
    // Over a plate's end the shortest way out of it may be along it. Where another plate goes on
    // there is no such way.
    if (manifold.count > 0 && leads_on(view, manifold.points[0]))
        return corners_over(view, sign * view.wall.normal, points);
    for (int i = 0; i < manifold.count; ++i) {
        const ManifoldPoint& p = manifold.points[static_cast<std::size_t>(i)];
        if (leads_on(view, p)) continue;
        const Vec3 normal{p.nx, p.ny, 0.0}, middle{p.x, p.y, 0.0};
        // From the middle of the gap to the surface of the body, where arms at walls end.
        const Vec3 arm = middle + 0.5 * p.gap * normal - offset;
        // Seen from behind, the corners of the plate are exchanged.
        const int corner = !p.of_second && sign < 0.0 ? 1 - p.corner : p.corner;
        points.push_back({-1, view.body, view.wall_index, feature_of(corner, p.of_second), p.gap,
                          normal, Vec3{}, arm, p.length, p.turns_with});
    }
}

void polygon_half_plane(const WallView& view, std::vector<ContactPoint>& points) {
    const PolygonView polygon = view.placed->polygons[view.body];
    const Vec3& normal = view.wall.normal;
    const double centre = signed_distance(view.wall, view.bodies.position[view.body]);
    const auto gap = [&](int k) {
        return centre + normal[0] * polygon.x[k] + normal[1] * polygon.y[k];
    };
    // The side on which it would lie: from the lowest corner to the lower of its neighbours, since
    // no other corner of a convex polygon can be among the two lowest.
    int lowest = 0;
    for (int k = 1; k < polygon.corners; ++k)
        if (gap(k) < gap(lowest)) lowest = k;
    const int before = polygon.before(lowest), after = polygon.after(lowest);
    const int second = gap(before) < gap(after) ? before : after;
    const Vec3 side{polygon.x[second] - polygon.x[lowest], polygon.y[second] - polygon.y[lowest],
                    0};
    // Each of its two ends stands for half of it. Beside a short side a third corner may close too
    // when the polygon turns.
    const double length = gap(second) < view.alert ? 0.5 * norm(side) : 0.0;
    const auto add = [&](int k, double stands_for) {
        if (gap(k) < view.alert) points.push_back(held_corner(view, k, gap(k), normal, stands_for));
    };
    add(lowest, length);
    add(second, length);
    for (int k = 0; k < polygon.corners; ++k)
        if (k != lowest && k != second) add(k, 0.0);
}

}  // namespace

void polygon_polygon(const PairView& view, std::vector<ContactPoint>& points) {
    const bool in_order = view.bodies.id[view.a] < view.bodies.id[view.b];
    // The manifold is that of (smaller id, larger id), so that names and the choice of the
    // reference do not depend on which body the caller calls a. Normal, arms and sides are turned
    // back below.
    const double sign = in_order ? 1.0 : -1.0;
    const PolygonView a = view.placed->polygons[view.a], b = view.placed->polygons[view.b];
    const Manifold manifold =
        polygon_manifold(in_order ? a : b, in_order ? b : a, sign * view.offset[0],
                         sign * view.offset[1], view.alert);
    for (int i = 0; i < manifold.count; ++i) {
        const ManifoldPoint& p = manifold.points[static_cast<std::size_t>(i)];
        const Vec3 from_first{p.x, p.y, 0.0};
        const Vec3 from_second = from_first - sign * view.offset;
        points.push_back({view.a,
                          view.b,
                          -1,
                          feature_of(p.corner, p.of_second),
                          p.gap,
                          {sign * p.nx, sign * p.ny, 0.0},
                          in_order ? from_first : from_second,
                          in_order ? from_second : from_first,
                          p.length,
                          in_order || p.turns_with == 0 ? p.turns_with : 3 - p.turns_with});
    }
}

void disc_polygon(const PairView& view, std::vector<ContactPoint>& points) {
    const double radius = view.bodies.radius[view.a];
    const PolygonView polygon = view.placed->polygons[view.b];
    const double x = -view.offset[0], y = -view.offset[1];
    const Nearest nearest = nearest_side(polygon, x, y);
    // The height over a side is at most the distance from the polygon: most pairs end here.
    if (!(nearest.height - radius < view.alert)) return;
    const Approach to_disc = approach(polygon, nearest, x, y);
    const double gap = to_disc.distance - radius;
    if (!(gap < view.alert)) return;
    const Vec3 arm_a = (-radius - 0.5 * gap) * to_disc.normal;
    // The normal of a corner turns with no side.
    points.push_back({view.a, view.b, -1, to_disc.feature, gap, -1.0 * to_disc.normal, arm_a,
                      arm_a - view.offset, 0.0, to_disc.feature % 2 == 0 ? 2 : 0});
}

void polygon_wall(const WallView& view, std::vector<ContactPoint>& points) {
    if (std::isfinite(view.wall.half_length))
        polygon_segment(view, points);
    else
        polygon_half_plane(view, points);
}

}  // namespace turbidite::nscd
