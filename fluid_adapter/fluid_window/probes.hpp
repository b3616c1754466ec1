// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Pressure and velocity at the points of output.probes.
#pragma once

#include <vector>

#include "coupler/protocol/settings.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"

namespace turbidite {

class Probes {
 public:
    /// Reads run.probes: x and y, in space also z, of each point, one after the other [m].
    explicit Probes(const Settings& settings);

    /// p/rho_f [m2/s2], u, v and in space w [m/s] at each point, from the fields; the same on all
    /// ranks.
    std::vector<double> values(const StoredField& field, const RankGroup& ranks) const;

 private:
    int dimension_;
    std::vector<Vec3> points_;  // [m]
};

}  // namespace turbidite
