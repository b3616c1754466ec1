// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Planes of the fluid in space at every output, fluid/slices (output.slices):
//
//     p        pressure over rho_f, linear between the cell centres on both sides [m2/s2]
//     U        velocity, the same [m/s]
//     covered  share of the cell's cut by the plane that spheres cover, with their hydrodynamic
//              radii, or of the cell that walls inside the box do
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupler/protocol/run_values.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/fluid_window/slice_file.hpp"
#include "fluid_adapter/multiplier/cell_stencil.hpp"
#include "fluid_adapter/multiplier/immersed_grain.hpp"

namespace turbidite {

/// Where the cells of the grid along an axis begin and end [m].
std::vector<double> edges_along(const CellGrid& grid, int axis);

class Slices {
 public:
    /// Reads run.slices: axis (0 to 2) and place [m] of each plane, one after the other.
    Slices(const Settings& settings, const CellGrid& grid, std::filesystem::path fluid_case);

    /// After so many windows; by all ranks. Throws Failure when the disk is full.
    void write(const StoredField& field, const RankGroup& ranks,
               const std::vector<ImmersedGrain>& grains, std::int64_t windows) const;

 private:
    struct Plane {
        int normal, across, up;  ///< axes: cells lie `across` fastest, then `up`
        double place;            ///< [m]
        AxisStencil stencil;     ///< the layers of cells on both sides
        int layer;               ///< the one that the plane cuts
        std::string name;        ///< "z6.4", in D
    };

    Plane plane(const CellGrid& grid, int normal, double place) const;
    std::vector<double> sampled(const Plane& plane, const StoredField& field) const;
    void cover(const Plane& plane, const StoredField& field, const ImmersedGrain& grain,
               std::vector<double>& values) const;
    void cover(const Plane& plane, const StoredField& field, const WallBody& wall,
               std::vector<double>& values) const;
    static void add_covered(const Plane& plane, const CellGrid& grid,
                            const std::array<int, 3>& cell, double share,
                            std::vector<double>& values);
    SliceEdges edges(const Plane& plane, const CellGrid& grid) const;

    RunValues run_;
    std::filesystem::path folder_;
    std::vector<Plane> planes_;
};

}  // namespace turbidite
