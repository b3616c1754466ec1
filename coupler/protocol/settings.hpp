// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// The resolved case as a flat list `key = value`. The coupler sends it to every participant at the
/// start, so that no adapter reads YAML. Keys are those of the case file (`contact.friction`), plus
/// the physical values of the run, in the units of the run:
///
///     run.diameter          D [m]
///     run.velocity_scale    u_c [m/s]
///     run.time_scale        t_c = D/u_c [s]
///     run.gravity           g, along -y [m/s2]
///     run.fluid_density     rho_f; 0 without a fluid [kg/m3]
///     run.viscosity         nu; 0 without a fluid [m2/s]
///     run.grain_weight      m g of a disc of diameter D in air [N/m], in space of a sphere
///                           [N]: the unit of forces in contact laws
///     run.surface_shift     s, by which the fluid sees a sphere larger [m]; missing: 0
///     run.film_cutoff       films of liquid act at smaller gaps [m]; missing: none
///     run.fluid_layers      layers of cells of each rank of the fluid, from the bottom up;
///                           missing with one rank, and with columns of cells
///     run.acceleration_x    fluid.acceleration [m/s2], and likewise run.acceleration_y, in
///                           space run.acceleration_z
///     run.dimension         3 in space; missing in the plane
///     run.size_x            the box [m], and likewise run.size_y and run.size_z, which is D in
///                           the plane
///     run.step              dt, the length of a window [s]
///     run.windows           number of windows of the whole run
///     run.output_every      windows from one output to the next
///     run.fields_every      windows from one output of the fluid's fields to the next;
///                           missing: as run.output_every
///     run.scheme            order of a window: coupling.scheme, or dry
///     run.repeats_windows   whether that repeats windows of the grains
///     run.slip_tolerance    rms slip at which step 5 is solved [u_c]
///     run.hash              of the resolved case: case_hash.hpp
///     run.walls             plates.hpp, in space space_walls.hpp
///     run.wall_motions      prescribed_motion.hpp
///     run.inflow_motions    prescribed_motion.hpp
///     run.grain_motions     prescribed_motion.hpp
///     run.md_frequency      w of the springs k = m_r w^2 [1/s]; this and the next three are
///                           missing for rigid contacts
///     run.md_damping        zeta of their dashpots
///     run.md_substeps       sub-steps per window
///     run.md_tangential_share  of the tangential springs and dashpots in the normal ones
///     run.slices            output.slices: axis (0 to 2) and place [m] of each; missing
///                           without any
///     run.probes            output.probes: x y x y ... [m], in space x y z; missing without
///                           any
///     run.materials         names of materials 1, 2, ..., separated by spaces; coefficients
///                           are contact.materials.NAME.*
///     run.side_material     index of the material of the sides; missing: 0
///
/// Valid C++17.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace turbidite {

/// A key that was asked for is not there.
struct MissingKey : std::out_of_range {
    using std::out_of_range::out_of_range;
};

/// Keys and values, all as texts, with typed look-ups.
class Settings {
 public:
    /// Key and value.
    using Entry = std::pair<std::string, std::string>;

    /// Adds or replaces.
    void set(const std::string& key, const std::string& value);
    void set(const std::string& key, double value);  ///< round-trips exactly
    void set(const std::string& key, std::int64_t value);
    void set(const std::string& key, bool value);

    /// Whether there is such a key.
    bool has(const std::string& key) const;

    /// Any value, as it stands. Throws MissingKey naming the key.
    const std::string& text(const std::string& key) const;
    /// A number. Throws MissingKey, or std::invalid_argument for another text, naming the key.
    double real(const std::string& key) const;
    /// A whole number. Throws as real().
    std::int64_t integer(const std::string& key) const;
    /// `true` or `false`. Throws as real().
    bool flag(const std::string& key) const;

    /// All of them, in the order of the keys.
    const std::vector<Entry>& entries() const { return entries_; }

 private:
    std::vector<Entry> entries_;  // sorted by key
};

}  // namespace turbidite
