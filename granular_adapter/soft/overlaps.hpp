// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The contact points at which grains overlap each other or a wall, by the contact engine's own
// detection: one point, or two where sides lie on each other, named by a corner
// (nscd/detection/plane/polygon_manifold.hpp).
//
// Every point carries the mass whose spring it has. Two discs, a disc at a wall, or a disc and a
// polygon have one point at most, with the reduced mass m_r. Two polygons, or a polygon at a wall,
// have two where sides lie on each other, each with m_r/2: together they are as stiff as the
// contact of two discs, and when sides meet at an angle the spring of the first point stays what it
// is as the second one comes. (A spring m_r w^2 that is divided between the points there are would
// give or take energy whenever their number changes.)
#pragma once

#include <utility>
#include <vector>

#include "granular_adapter/nscd/detection/narrow_phase.hpp"
#include "granular_adapter/soft/neighbours.hpp"

namespace turbidite::soft {

struct Overlap {
    nscd::ContactKey name;
    nscd::ContactPoint point;
    double mass;  ///< m of the spring m w^2 [kg]
};

class OverlapFinder {
 public:
    /// Throws std::invalid_argument naming a shape without contact detection. `skin` [m].
    OverlapFinder(const ShapeTable& shapes, std::vector<nscd::Wall> walls,
                  const nscd::PeriodicBox& box, double skin)
        : narrow_(shapes), walls_(std::move(walls)), box_(box), neighbours_(box, skin) {}

    void find(const nscd::Bodies& bodies);

    /// Of the last find(), in ascending order of names.
    const std::vector<Overlap>& overlaps() const { return overlaps_; }

    /// To be called when bodies were removed or exchanged.
    void forget() { neighbours_.forget(); }

 private:
    void detect(const nscd::Bodies& bodies, const Near& near, const nscd::PlacedShapes& placed);
    bool has_corners(const nscd::Bodies& bodies, std::int32_t body) const;
    /// A round grain and another one touch at one point, whose spring stays as the point passes
    /// from a side to a corner.
    bool is_of_one_point(const nscd::Bodies& bodies, const Near& near) const;
    double mass_of_point(const nscd::Bodies& bodies, const Near& near) const;

    nscd::NarrowPhase narrow_;
    std::vector<nscd::Wall> walls_;
    nscd::PeriodicBox box_;
    Neighbours neighbours_;
    std::vector<nscd::ContactPoint> points_;  ///< of one pair
    std::vector<Overlap> overlaps_;
};

}  // namespace turbidite::soft
