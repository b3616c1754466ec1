// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The shapes that grains of a case may have: `grains.shape`, which is form 0, and for grains files
// all other known shapes. `polygon` is among them if `grains.vertices` defines it.
#pragma once

#include <string>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"
#include "coupler/shapes/surface_gap.hpp"
#include "launcher/case/grains/packing/packing.hpp"

namespace turbidite {

struct GrainForm {
    ShapeRecord record;
    std::vector<Point2> outline;  ///< unit circumradius; empty for round ones
    double radius = 0.5;          ///< circumscribed, unless a file gives one [D]
};

struct GrainForms {
    std::vector<GrainForm> forms;
    std::vector<std::string> notes;  ///< changes made to `grains.vertices`
    int dimension = 2;

    /// -1 if there is none.
    std::int32_t index_of(const std::string& kind) const;
};

/// Discs only, radius 0.5 D.
GrainForms plain_discs();

/// The same of space.
GrainForms plain_spheres();

/// Reads dimension, grains.shape, grains.radius and grains.vertices (which must be a convex
/// polygon). Radii unless `grains.radius` is given: 0.5 D, triangles 0.75 D, so that their area is
/// nearly that of a disc (Topin 2011, section 2.3).
GrainForms make_grain_forms(const Settings& settings);

/// The problem with `grains.vertices`; empty if there is none.
std::string outline_fault(const std::vector<double>& vertices);

/// A grain in position [D].
PlacedOutline placed_outline(const PlacedGrain& grain, const GrainForms& forms);

/// The least distance between two parallel lines that enclose it [D].
double least_width(const PlacedGrain& grain, const GrainForms& forms);

/// 4 area/circumference [D]: the diameter of round ones, that of the inscribed circle of triangles
/// and squares.
double mean_diameter(const PlacedGrain& grain, const GrainForms& forms);

/// Removes forms that no grain has and renumbers the grains' shapes.
ShapeTable used_shapes(Packing& grains, const GrainForms& forms);

}  // namespace turbidite
