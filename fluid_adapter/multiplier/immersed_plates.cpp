// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/immersed_plates.hpp"

#include <cmath>
#include <numbers>

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

}  // namespace

ImmersedPlates::ImmersedPlates(const Settings& settings) {
    for (const Plate& plate : plates_of(settings)) {
        const double half_length = 0.5 * length(plate), half_thickness = 0.5 * plate.thickness;
        plates_.push_back(
            {plate, strip(half_length, half_thickness), half_length + half_thickness});
    }
}

std::vector<ImmersedGrain> ImmersedPlates::bodies(double time, double step) const {
    std::vector<ImmersedGrain> bodies;
    for (const Entry& entry : plates_) {
        const PlacedPlate placed = place(entry.plate, time, step);
        ImmersedGrain body;
        // Below zero, where no grain has its id.
        body.id = -1 - entry.plate.key;
        body.shape = entry.outline.get();
        body.radius = entry.radius;
        body.position = {placed.middle[0], placed.middle[1], 0.0};
        body.orientation = matrix(rotation(Vec3{0.0, 0.0, placed.angle}));
        body.contact_motion = placed.twist;
        body.has_boundary_points = false;
        // No mass is set: a prescribed motion needs none (A^-1 = 0).
        body.prescribed = true;
        bodies.push_back(body);
    }
    return bodies;
}

}  // namespace turbidite
