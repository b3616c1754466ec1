// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/narrow_phase.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/plane/polygon_contacts.hpp"

namespace turbidite::nscd {
namespace {

void disc_disc(const PairView& view, std::vector<ContactPoint>& points) {
    const double radius_a = view.bodies.radius[view.a], radius_b = view.bodies.radius[view.b];
    const double distance = norm(view.offset);
    const double gap = distance - radius_a - radius_b;
    if (!(gap < view.alert)) return;
    // Concentric discs have no normal; any direction separates them.
    const Vec3 normal = distance > 0.0 ? (1.0 / distance) * view.offset : Vec3{1.0, 0.0, 0.0};
    const Vec3 arm_a = (radius_a + 0.5 * gap) * normal;
    const Vec3 arm_b = (-radius_b - 0.5 * gap) * normal;
    points.push_back({view.a, view.b, -1, 0, gap, normal, arm_a, arm_b});
}

/// Beyond the end of a segment the contact is with its corner.
void disc_corner(const WallView& view, double end, std::vector<ContactPoint>& points) {
    const Vec3 tangent{-view.wall.normal[1], view.wall.normal[0], 0.0};
    const Vec3 corner = view.wall.point + end * tangent;
    const Vec3 offset = view.bodies.position[view.body] - corner;
    const double distance = norm(offset), radius = view.bodies.radius[view.body];
    if (!(distance - radius < view.alert)) return;
    // A disc whose centre is the corner may leave along the wall.
    const Vec3 normal =
        distance > 0.0 ? (1.0 / distance) * offset : std::copysign(1.0, end) * tangent;
    points.push_back({-1, view.body, view.wall_index, end > 0.0 ? 1 : 2, distance - radius, normal,
                      Vec3{}, -radius * normal});
}

void disc_wall(const WallView& view, std::vector<ContactPoint>& points) {
    const Vec3& centre = view.bodies.position[view.body];
    const double radius = view.bodies.radius[view.body];
    const double place = along(view.wall, centre), end = view.wall.half_length;
    if (std::abs(place) > end) return disc_corner(view, std::copysign(end, place), points);
    // A half-plane is solid behind its normal; a segment holds grains on both sides.
    const double height = signed_distance(view.wall, centre);
    const double side = std::isfinite(end) && height < 0.0 ? -1.0 : 1.0;
    const double distance = side * height;
    if (!(distance - radius < view.alert)) return;
    const Vec3 normal = side * view.wall.normal;
    points.push_back(
        {-1, view.body, view.wall_index, 0, distance - radius, normal, Vec3{}, -radius * normal});
}

/// The same contact with a and b exchanged.
void swap_bodies(ContactPoint& point) {
    std::swap(point.a, point.b);
    std::swap(point.arm_a, point.arm_b);
    point.normal = -1.0 * point.normal;
    if (point.turns_with != 0) point.turns_with = 3 - point.turns_with;
}

WallDetector find_wall_detector(const std::string& kind) {
    for (const WallDetectorEntry& entry : wall_detector_list())
        if (entry.kind == kind) return entry.detect;
    throw std::invalid_argument("contacts of shape \"" + kind + "\" with walls are not available");
}

PairDetector find_pair_detector(const std::string& first, const std::string& second) {
    for (const PairDetectorEntry& entry : pair_detector_list())
        if (entry.first == first && entry.second == second) return entry.detect;
    throw std::invalid_argument("contacts between shapes \"" + first + "\" and \"" + second +
                                "\" are not available");
}

}  // namespace

const std::vector<PairDetectorEntry>& pair_detector_list() {
    static const std::vector<PairDetectorEntry> entries = {
        {"disc", "disc", disc_disc},
        {"disc", "polygon", disc_polygon},
        {"disc", "triangle", disc_polygon},
        {"polygon", "polygon", polygon_polygon},
        {"polygon", "triangle", polygon_polygon},
        {"triangle", "triangle", polygon_polygon},
    };
    return entries;
}

const std::vector<WallDetectorEntry>& wall_detector_list() {
    static const std::vector<WallDetectorEntry> entries = {
        {"disc", disc_wall}, {"polygon", polygon_wall}, {"triangle", polygon_wall}};
    return entries;
}

NarrowPhase::NarrowPhase(const ShapeTable& shapes) : polygons_(shapes) {
    for (const ShapeRecord& shape : shapes) {
        kinds_.push_back(shape.kind);
        walls_.push_back(find_wall_detector(shape.kind));
    }
    for (const std::string& a : kinds_)
        for (const std::string& b : kinds_)
            pairs_.push_back({find_pair_detector(std::min(a, b), std::max(a, b)), b < a});
}

void NarrowPhase::pair(const PairView& view, std::vector<ContactPoint>& points) const {
    const auto shape_a = static_cast<std::size_t>(view.bodies.shape[view.a]);
    const auto shape_b = static_cast<std::size_t>(view.bodies.shape[view.b]);
    const PairChoice& choice = pairs_.at(shape_a * kinds_.size() + shape_b);
    if (!choice.swapped) return choice.detect(view, points);
    const std::size_t before = points.size();
    choice.detect({view.bodies, view.b, view.a, -1.0 * view.offset, view.alert, view.polygons},
                  points);
    std::for_each(points.begin() + static_cast<std::ptrdiff_t>(before), points.end(), swap_bodies);
}

void NarrowPhase::wall(const WallView& view, std::vector<ContactPoint>& points) const {
    const std::size_t before = points.size();
    const double half = view.wall.half_thickness;
    const WallView of_line{view.bodies,     view.body,         view.wall,
                           view.wall_index, view.alert + half, view.polygons};
    walls_.at(static_cast<std::size_t>(view.bodies.shape[view.body]))(of_line, points);
    for (std::size_t i = before; i < points.size(); ++i) points[i].gap -= half;
}

}  // namespace turbidite::nscd
