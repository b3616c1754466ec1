// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The grains as a ParaView series: grains/grains.pvd and one VTK PolyData file per output with a
// point per grain. Apply a glyph (sphere, scaled by `radius` with factor 2) to see discs. If shapes
// have corners, a second part of the same series, outlines_<step>.vtp, contains these grains as
// polygons.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "coupler/output/vtk_files.hpp"
#include "coupler/protocol/records.hpp"

namespace turbidite {

class GrainSeries {
 public:
    /// In the folder of the series.
    static constexpr const char* collection_name = "grains.pvd";

    GrainSeries(std::filesystem::path folder, const ShapeTable& shapes);

    /// Goes on with the series of an earlier part of the run.
    GrainSeries(std::filesystem::path folder, const ShapeTable& shapes, std::int64_t length);

    vtk::Collection& collection() { return collection_; }

    /// Points in run units with id, shape, material, prescribed (0, 1), radius, density,
    /// orientation (quaternion w, x, y, z), velocity, angular_velocity, force, contact_force. The
    /// series file is complete after every call. `time` is in run units, `window` the step over
    /// which contact impulses were summed.
    void write(double time, std::int64_t step, double window, const Motion& state,
               const std::vector<Kick>& kicks);

 private:
    using Outline = std::vector<std::array<double, 2>>;  ///< Shape::outline

    GrainSeries(std::filesystem::path folder, const ShapeTable& shapes, vtk::Collection series);

    void write_points(const std::string& name, double window, const Motion& state,
                      const std::vector<Kick>& kicks) const;
    void write_outlines(const std::string& name, const Motion& state) const;

    std::filesystem::path folder_;
    std::vector<Outline> outlines_;  ///< per shape; empty for round ones
    vtk::Collection collection_;
};

}  // namespace turbidite
