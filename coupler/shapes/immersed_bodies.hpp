// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The bodies of a case: shapes by their index, in the fluid of its run. Valid C++17.
#pragma once

#include <memory>
#include <vector>

#include "coupler/protocol/run_values.hpp"
#include "coupler/shapes/immersed_body.hpp"

namespace turbidite {

class ImmersedBodies {
 public:
    ImmersedBodies() = default;

    ImmersedBodies(const RunValues& run, const ShapeTable& shapes);

    /// M, I and their effective values in the fluid. Throws std::out_of_range for a shape that is
    /// not in the table.
    ImmersedBody operator()(const GrainState& grain) const;

 private:
    double fluid_density_ = 0.0;  ///< [kg/m3]
    double hydrodynamic_radius_ = 1.0;
    double surface_shift_ = 0.0;
    std::vector<std::shared_ptr<const Shape>> shapes_;
};

}  // namespace turbidite
