// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/immersed_walls.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "coupler/protocol/failure.hpp"
#include "coupler/protocol/run_values.hpp"
#include "coupler/shapes/tight_wall.hpp"

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

WallSurface surface_of(const PlacedPlate& placed, double length) {
    const Vec3 half = 0.5 * length * Vec3{std::cos(placed.angle), std::sin(placed.angle), 0.0};
    return surface_of_plate(placed.middle - half, placed.middle + half);
}

std::optional<MeshRows> stretched_rows(const Settings& settings) {
    if (!rows_are_stretched(settings)) return std::nullopt;
    const RunValues run = run_values(settings);
    std::optional<MeshRows> rows = mesh_rows(settings, run.size[1] / run.diameter);
    if (!rows) return std::nullopt;
    rows->height *= run.diameter;
    for (double& height : rows->stretched) height *= run.diameter;
    return rows;
}

}  // namespace

ImmersedWalls::ImmersedWalls(const Settings& settings)
    : stretched_(stretched_rows(settings)), diameter_(run_values(settings).diameter) {
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
        check_rows(strip.plate.id, surface_of(placed, length(strip.plate)), strip.plate.thickness);
        ImmersedGrain body = wall_body(strip.plate.key, placed.twist);
        body.shape = strip.outline.get();
        body.radius = strip.radius;
        body.position = vector(placed.middle);
        body.orientation = matrix(rotation(Vec3{0.0, 0.0, placed.angle}));
        bodies.push_back(body);
    }
    for (InSpace& entry : in_space_) {
        const PlacedWall placed = place(entry.wall, time, step);
        check_rows(entry.wall.id, placed.surface, entry.wall.thickness);
        entry.body.surface = placed.surface;
        ImmersedGrain body = wall_body(entry.wall.key, placed.twist);
        body.wall = &entry.body;
        body.position = vector(placed.pivot);
        bodies.push_back(body);
    }
}

/// At the start of a run `check` has done so; a wall may move or turn to where rows are higher.
void ImmersedWalls::check_rows(GrainId id, const WallSurface& surface, double thickness) const {
    if (!stretched_) return;
    const double least = least_thickness(surface, thickness, *stretched_);
    if (!is_too_thin(thickness, least)) return;
    std::ostringstream why;
    why << "wall " << id
        << " has come to higher rows of cells, where fluid passes through a thickness of "
        << thickness / diameter_ << " D: at least " << least / diameter_
        << " D; use a larger thickness or fluid.stretch_from";
    throw PhysicsRefused(why.str());
}

}  // namespace turbidite
