// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Positions of the grains at t = 0, in units of the grain diameter D.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/rigid/vec3.hpp"

namespace turbidite {

struct GrainForms;

/// Lets an exact fit survive rounding [D].
constexpr double fit_rounding = 1e-9;

struct PlacedGrain {
    GrainId id = 0;
    double x = 0.0;                       ///< [D]
    double y = 0.0;                       ///< [D]
    double radius = 0.5;                  ///< circumscribed [D]
    std::int32_t shape = 0;               ///< index of GrainForms
    double angle = 0.0;                   ///< counter-clockwise [rad]
    double vx = 0.0, vy = 0.0;            ///< [u_c]
    double spin = 0.0;                    ///< [1/t_c]
    std::optional<double> density = {};   ///< ratio to rho_f; grains.density_ratio unless given
    std::int32_t material = 0;            ///< index of material_names
    bool prescribed = false;              ///< keeps its velocity and spin: fixed or driven
    std::string motion = {};              ///< below domain.motions, which it follows if not empty
    double z = 0.0;                       ///< in space [D]
    double vz = 0.0;                      ///< in space [u_c]
    double wx = 0.0, wy = 0.0;            ///< in space, beside spin about z [1/t_c]
    Quaternion turn{1.0, 0.0, 0.0, 0.0};  ///< orientation in space; in the plane `angle`
};
using Packing = std::vector<PlacedGrain>;

/// The box of the grains.
struct PackingBox {
    double width = 0.0;   ///< [D]
    double height = 0.0;  ///< [D]
    bool periodic_x = false;
    bool periodic_y = false;
    double depth = 0.0;  ///< in space; 0 in the plane [D]
    bool periodic_z = false;

    bool in_space() const { return depth > 0.0; }
};

/// A cylinder in space.
struct PackingCylinder {
    Vec3 from{}, to{};    ///< ends of its axis [D]
    double radius = 0.0;  ///< [D]
};

/// A rectangle in the lower left corner of the box, in space a cuboid in the lower left front one
/// or anywhere, or a cylinder that it encloses.
struct PackingRegion {
    double width = 0.0;                            ///< [D]
    double height = 0.0;                           ///< [D]
    double depth = 0.0;                            ///< in space [D]
    Vec3 corner{};                                 ///< of a region in space [D]
    std::optional<PackingCylinder> cylinder = {};  ///< touches the six sides of the cuboid

    /// In space [D3].
    double volume() const;
    /// Whether a sphere at this place is inside; up to rounding where it touches a side.
    bool holds(const Vec3& place, double radius) const;
};

/// The region of a cylinder, as large as it needs.
PackingRegion enclosing(const PackingCylinder& cylinder);

struct PackingRequest {
    PackingBox box;
    std::optional<PackingRegion> region = {};  ///< region to fill; the whole box unless given
    double compacity = 0.0;                    ///< lattice: solid fraction of the infinite lattice
    std::int64_t count = 0;                    ///< random: number of grains
    double jitter = 0.0;                       ///< largest displacement along each axis [D]
    std::uint64_t seed = 1;
    const GrainForms* forms = nullptr;  ///< form 0 is used; discs of radius 0.5 unless given
    double size_ratio = 1.0;            ///< random: largest radius over the smallest
    std::string lattice = {};           ///< in space: name of a space_lattice

    PackingRegion filled() const {
        return region ? *region : PackingRegion{box.width, box.height, box.depth};
    }
};

/// 0.5 for none [D].
double largest_radius(const Packing& grains);

/// A packing with notes for the user, or the reason for a refusal.
struct PackingResult {
    Packing grains;
    std::vector<std::string> notes;
    std::string refusal;  ///< empty if there is none
};

/// All generators, by the name used in `grains.generator`.
struct GeneratorEntry {
    std::string name;
    std::string help;
    PackingResult (*make)(const PackingRequest&);
    PackingResult (*make_in_space)(const PackingRequest&);
};
const std::vector<GeneratorEntry>& generator_list();

/// Overlaps up to this count as touching [D]: far above rounding, far below what matters to a
/// contact solver.
inline constexpr double touching_tolerance = 1e-9;

}  // namespace turbidite
