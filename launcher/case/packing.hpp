// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Where the grains are at t = 0, in units of the grain diameter D.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

struct GrainForms;

struct PlacedGrain {
    GrainId id = 0;
    double x = 0.0;                      ///< [D]
    double y = 0.0;                      ///< [D]
    double radius = 0.5;                 ///< circumscribed [D]
    std::int32_t shape = 0;              ///< index of GrainForms
    double angle = 0.0;                  ///< counter-clockwise [rad]
    double vx = 0.0, vy = 0.0;           ///< [u_c]
    double spin = 0.0;                   ///< [1/t_c]
    std::optional<double> density = {};  ///< over the fluid's; grains.density_ratio unless given
    std::int32_t material = 0;           ///< index of material_names
    bool prescribed = false;             ///< keeps its velocity and spin: fixed or driven
};
using Packing = std::vector<PlacedGrain>;

/// The box of the grains; a periodic direction has its opposite sides joined.
struct PackingBox {
    double width = 0.0;   ///< [D]
    double height = 0.0;  ///< [D]
    bool periodic_x = false;
    bool periodic_y = false;
};

/// A rectangle in the lower left corner of the box.
struct PackingRegion {
    double width = 0.0;   ///< [D]
    double height = 0.0;  ///< [D]
};

struct PackingRequest {
    PackingBox box;
    std::optional<PackingRegion> region = {};  ///< what is filled; the whole box unless given
    double compacity = 0.0;  ///< lattice: solid area fraction of the infinite lattice
    std::int64_t count = 0;  ///< random: number of grains
    double jitter = 0.0;     ///< largest displacement along x and along y [D]
    std::uint64_t seed = 1;
    const GrainForms* forms = nullptr;  ///< form 0 is placed; discs of radius 0.5 unless given
    double size_ratio = 1.0;            ///< random: largest radius over the smallest

    PackingRegion filled() const { return region ? *region : PackingRegion{box.width, box.height}; }
};

/// 0.5 for none [D].
double largest_radius(const Packing& grains);

/// A packing, remarks for the user, or the reason why there is none.
struct PackingResult {
    Packing grains;
    std::vector<std::string> notes;
    std::string refusal;  ///< empty when all is well
};

/// Every generator there is, by the name used in `grains.generator`.
struct GeneratorEntry {
    std::string name;
    std::string help;
    PackingResult (*make)(const PackingRequest&);
};
const std::vector<GeneratorEntry>& generator_list();

/// Grains as close as this count as touching, not overlapping [D]: far above rounding, far below
/// what a contact solver sees.
inline constexpr double touching_tolerance = 1e-9;

}  // namespace turbidite
