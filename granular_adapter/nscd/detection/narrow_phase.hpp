// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact points of candidate pairs (contact_point.hpp), one function per pair of shapes.
#pragma once

#include <string>
#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/detection/plane/placed_polygons.hpp"
#include "granular_adapter/nscd/detection/plane/plate_joints.hpp"
#include "granular_adapter/nscd/detection/space/rectangle_joints.hpp"
#include "granular_adapter/nscd/detection/space/wall_joints.hpp"

namespace turbidite::nscd {

/// What is found once per configuration: the shapes with corners of all bodies, in world axes, the
/// rims that round walls have in common, and where plates and rectangles end on others.
struct PlacedShapes {
    PlacedPolygons polygons;
    WallJoints joints;
    PlateJoints plates = {};
    RectangleJoints rectangles = {};
};

using PairDetector = void (*)(const PairView&, std::vector<ContactPoint>&);
using WallDetector = void (*)(const WallView&, std::vector<ContactPoint>&);

/// Every supported pair of shapes, by names of shapes/shape_list, first <= second.
struct PairDetectorEntry {
    std::string first;
    std::string second;
    PairDetector detect;
};
const std::vector<PairDetectorEntry>& pair_detector_list();

/// Every shape that can touch walls, by its name.
struct WallDetectorEntry {
    std::string kind;
    WallDetector detect;
    /// Throws std::invalid_argument for a wall that the shape cannot touch.
    void (*check)(const Wall&);
};
const std::vector<WallDetectorEntry>& wall_detector_list();

/// The detectors for the shapes of a run. Throws std::invalid_argument naming a pair that has none.
class NarrowPhase {
 public:
    /// Throws std::invalid_argument naming a shape or a pair of shapes without a detector.
    explicit NarrowPhase(const ShapeTable& shapes);

    /// Throws std::invalid_argument for a wall that these shapes cannot touch (walls.hpp).
    void check(const Wall& wall) const;

    /// Once per configuration; views refer to the result. `joined`: without the points where a
    /// plate or rectangle ends and others lead nearer.
    PlacedShapes place(const Bodies& bodies, const std::vector<Wall>& walls = {},
                       bool joined = false) const {
        PlacedShapes placed{{polygons_, bodies}, WallJoints(walls)};
        if (joined) placed.plates = PlateJoints(walls), placed.rectangles = RectangleJoints(walls);
        return placed;
    }
    bool has_corners() const { return polygons_.any(); }
    bool has_corners(std::int32_t shape) const { return polygons_[shape].corners > 0; }

    /// Append the contact points of a pair or of a body and a wall, if their gap is below the alert
    /// distance.
    void pair(const PairView& view, std::vector<ContactPoint>& points) const;
    void wall(const WallView& view, std::vector<ContactPoint>& points) const;

 private:
    struct PairChoice {
        PairDetector detect;
        bool swapped;  ///< the detector takes b first
    };
    std::size_t kind_of(const Bodies& bodies, std::size_t body) const {
        return kind_.at(static_cast<std::size_t>(bodies.shape[body]));
    }

    PolygonShapes polygons_;
    std::vector<std::size_t> kind_;  ///< by shape
    std::size_t kinds_ = 0;
    std::vector<PairChoice> pairs_;         ///< kind a x kind b
    std::vector<WallDetectorEntry> walls_;  ///< by kind
};

}  // namespace turbidite::nscd
