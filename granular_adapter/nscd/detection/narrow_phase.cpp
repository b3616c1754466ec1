// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/detection/narrow_phase.hpp"

#include <algorithm>
#include <stdexcept>

#include "coupler/rigid/vec3.hpp"
#include "granular_adapter/nscd/detection/plane/planar_walls.hpp"
#include "granular_adapter/nscd/detection/plane/polygon_contacts.hpp"
#include "granular_adapter/nscd/detection/round_contacts.hpp"
#include "granular_adapter/nscd/detection/space/space_walls.hpp"

namespace turbidite::nscd {
namespace {

/// The same contact with a and b exchanged.
void swap_bodies(ContactPoint& point) {
    std::swap(point.a, point.b);
    std::swap(point.arm_a, point.arm_b);
    point.normal = -1.0 * point.normal;
    if (point.turns_with != 0) point.turns_with = 3 - point.turns_with;
}

const WallDetectorEntry& find_wall_detector(const std::string& kind) {
    for (const WallDetectorEntry& entry : wall_detector_list())
        if (entry.kind == kind) return entry;
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
        {"disc", "disc", round_round},
        {"disc", "polygon", disc_polygon},
        {"disc", "triangle", disc_polygon},
        {"polygon", "polygon", polygon_polygon},
        {"polygon", "triangle", polygon_polygon},
        {"sphere", "sphere", round_round},
        {"triangle", "triangle", polygon_polygon},
    };
    return entries;
}

const std::vector<WallDetectorEntry>& wall_detector_list() {
    static const std::vector<WallDetectorEntry> entries = {
        {"disc", disc_wall, check_planar},
        {"polygon", polygon_wall, check_planar},
        {"triangle", polygon_wall, check_planar},
        {"sphere", sphere_wall, check_space_wall}};
    return entries;
}

NarrowPhase::NarrowPhase(const ShapeTable& shapes) : polygons_(shapes) {
    // Few kinds, and as many shapes as a scene has polygons.
    std::vector<std::string> kinds;
    for (const ShapeRecord& shape : shapes) {
        const auto known = std::find(kinds.begin(), kinds.end(), shape.kind);
        kind_.push_back(static_cast<std::size_t>(known - kinds.begin()));
        if (known != kinds.end()) continue;
        kinds.push_back(shape.kind);
        walls_.push_back(find_wall_detector(shape.kind));
    }
    kinds_ = kinds.size();
    // The table has each pair once, in alphabetical order: where b comes first, the detector takes
    // the bodies exchanged, and its points are exchanged back.
    for (const std::string& a : kinds)
        for (const std::string& b : kinds)
            pairs_.push_back({find_pair_detector(std::min(a, b), std::max(a, b)), b < a});
}

void NarrowPhase::check(const Wall& wall) const {
    check_wall(wall);
    for (const WallDetectorEntry& entry : walls_) entry.check(wall);
}

void NarrowPhase::pair(const PairView& view, std::vector<ContactPoint>& points) const {
    const std::size_t a = kind_of(view.bodies, view.a), b = kind_of(view.bodies, view.b);
    const PairChoice& choice = pairs_.at(a * kinds_ + b);
    if (!choice.swapped) return choice.detect(view, points);
    const std::size_t before = points.size();
    // The offset is from the first body to the second, so it is turned with them.
    choice.detect({view.bodies, view.b, view.a, -1.0 * view.offset, view.alert, view.placed},
                  points);
    std::for_each(points.begin() + static_cast<std::ptrdiff_t>(before), points.end(), swap_bodies);
}

void NarrowPhase::wall(const WallView& view, std::vector<ContactPoint>& points) const {
    const std::size_t before = points.size();
    // Detectors see a line or surface without thickness: g = g_line - half_thickness, so they look
    // farther by as much.
    const double half = view.wall.half_thickness;
    const WallView of_line{view.bodies,     view.body,         view.wall,
                           view.wall_index, view.alert + half, view.placed};
    walls_.at(kind_of(view.bodies, view.body)).detect(of_line, points);
    for (std::size_t i = before; i < points.size(); ++i) points[i].gap -= half;
}

}  // namespace turbidite::nscd
