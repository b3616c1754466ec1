// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grains as a ParaView series: grains/grains.pvd over one VTK PolyData file per output. Apply a
// glyph (sphere, scaled by `radius` with factor 2) to see them.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

class GrainSeries {
 public:
    explicit GrainSeries(std::filesystem::path folder);

    /// Points in run units with id, radius, density, velocity, angular_velocity, force,
    /// contact_force. The series file is complete after every call. `time` is in run units.
    void write(double time, std::int64_t step, double window, const Motion& state,
               const std::vector<Kick>& kicks);

 private:
    void add_to_collection(double time, const std::string& name);

    std::filesystem::path folder_;
    std::ofstream collection_;
};

}  // namespace turbidite
