// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/immersed_walls.hpp"

#include <cmath>
#include <numbers>

#include "coupler/protocol/run_values.hpp"

namespace turbidite {
namespace {

using std::numbers::pi;
constexpr int corners_of_end = 9;

/// A strip along x with a half circle at each end, with half its whole length as unit.
std::shared_ptr<const Shape> strip(double half_length, double half_thickness) {
    const double radius = half_length + half_thickness;
    std::vector<double> vertices;
    for (const double end : {1.0, -1.0})
        for (int k = 0; k < corners_of_end; ++k) {
            // From -90 to +90 degrees about the end at +x; the other end is that turned by 180
            // degrees, so the corners follow each other counter-clockwise.
            const double angle = pi * (k / (corners_of_end - 1.0) - 0.5);
            vertices.push_back(end * (half_length + half_thickness * std::cos(angle)) / radius);
            vertices.push_back(end * half_thickness * std::sin(angle) / radius);
        }
    return make_shape({"polygon", vertices});
}

/// What is common to all: no mass is set, since a prescribed motion needs none (A^-1 = 0).
ImmersedGrain wall_body(std::int32_t key, const Twist& twist) {
    ImmersedGrain body;
    // Below zero, where no grain has its id.
    body.id = -1 - key;
    body.contact_motion = twist;
    body.has_boundary_points = false;
    body.prescribed = true;
    return body;
}

Eigen::Vector3d vector(const Vec3& x) {
    return {x[0], x[1], x[2]};
}

}  // namespace

ImmersedWalls::ImmersedWalls(const Settings& settings) {
    if (dimension_of(settings) == 3) {
        const double shift = run_values(settings).surface_shift;
        for (const SpaceWall& wall : space_walls_of(settings))
            in_space_.push_back({wall, {{}, 0.5 * wall.thickness + shift}});
        return;
    }
    for (const Plate& plate : plates_of(settings)) {
        const double half_length = 0.5 * length(plate), half_thickness = 0.5 * plate.thickness;
        strips_.push_back(
            {plate, strip(half_length, half_thickness), half_length + half_thickness});
    }
}

void ImmersedWalls::append(double time, double step, std::vector<ImmersedGrain>& bodies) {
    for (const Strip& strip : strips_) {
        const PlacedPlate placed = place(strip.plate, time, step);
        ImmersedGrain body = wall_body(strip.plate.key, placed.twist);
        body.shape = strip.outline.get();
        body.radius = strip.radius;
        body.position = vector(placed.middle);
        body.orientation = matrix(rotation(Vec3{0.0, 0.0, placed.angle}));
        bodies.push_back(body);
    }
    for (InSpace& entry : in_space_) {
        const PlacedWall placed = place(entry.wall, time, step);
        entry.body.surface = placed.surface;
        ImmersedGrain body = wall_body(entry.wall.key, placed.twist);
        body.wall = &entry.body;
        body.position = vector(placed.pivot);
        bodies.push_back(body);
    }
}

}  // namespace turbidite
