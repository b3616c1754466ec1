// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Contact points of a configuration: candidate pairs by cell lists (broad_phase.hpp), then gaps and
// normals by shape (narrow_phase.hpp), in the order in which solvers visit them
// (contact_order.hpp, cells/cell_order.hpp).
#pragma once

#include <memory>
#include <vector>

#include "granular_adapter/nscd/detection/broad_phase.hpp"
#include "granular_adapter/nscd/detection/contact_order.hpp"
#include "granular_adapter/nscd/detection/narrow_phase.hpp"
#include "granular_adapter/nscd/problem/contact_cells.hpp"
#include "granular_adapter/nscd/problem/periodic_box.hpp"

namespace turbidite::nscd {

/// Contact points in order, and their cells if they are ordered by cells.
struct OrderedPoints {
    std::vector<ContactPoint> points;
    ContactCells cells;
    std::vector<std::size_t> phase_ends;  ///< by phase, the number of cells up to its end
};

/// From the top down, or by cells of eight parities.
enum class ContactOrder { top_down, cells };

class ParityGrid;

class Detection {
 public:
    /// Throws std::invalid_argument naming the shapes for which there is no contact detection.
    /// Results do not depend on the number of threads.
    Detection(const ShapeTable& shapes, const PeriodicBox& box,
              ContactOrder order = ContactOrder::top_down, int threads = 1)
        : narrow_(shapes),
          box_(box),
          order_(order),
          team_(std::make_unique<ThreadTeam>(threads)),
          alone_(std::make_unique<ThreadTeam>(1)) {}

    bool has_corners() const { return narrow_.has_corners(); }
    const NarrowPhase& narrow_phase() const { return narrow_; }

    /// Contact points with a gap below `reach` plus `share` of the sum of both radii (of the
    /// diameter at a wall), except those between fixed bodies. In order; by cells only without
    /// corners.
    std::vector<ContactPoint> points(const Bodies& bodies, const std::vector<Wall>& walls,
                                     const Vec3& gravity, double reach, double share) const;

    /// Bodies and walls, and how far to look.
    struct Search {
        const Bodies& bodies;
        const std::vector<Wall>& walls;
        Vec3 gravity{};
        double reach = 0.0, share = 0.0;
        /// Without the points where a plate or rectangle ends and others lead nearer
        /// (plane/plate_joints.hpp). What acts across gaps goes along by them (common_edges.hpp).
        bool joined = true;
    };
    OrderedPoints ordered_points(const Search& search) const;

    /// The same on one of several ranks, whose own bodies come before those of others: the points
    /// whose body with the lower id is its own, and those of large bodies, in phases.
    OrderedPoints ordered_points(const Search& search, const ParityGrid& grid,
                                 std::size_t own) const;

    /// Largest overlap of all pairs, >= 0 [m].
    double deepest_overlap(const Bodies& bodies, const std::vector<Wall>& walls) const;

    /// The same for the pairs of the given points only, at the present positions of the bodies.
    double deepest_overlap(const Bodies& bodies, const std::vector<Wall>& walls,
                           const std::vector<ContactPoint>& of) const;

 private:
    ThreadTeam& team_for(const Bodies& bodies) const;

    struct Near;
    struct Look;
    template <class Place>
    struct Found;

    void add_pair(const Bodies& bodies, Pair pair, double alert, const PlacedShapes& placed,
                  std::vector<ContactPoint>& points) const;
    void add(const Look& look, const Near& near, std::vector<ContactPoint>& points) const;
    template <class Part, class Visit>
    std::vector<Part> each_near(const Look& look, const Visit& visit) const;
    template <class Wanted>
    std::vector<ContactPoint> unordered(const Look& look, const Wanted& wanted) const;
    template <class Order, class Wanted>
    std::vector<ContactPoint> in_order(const Look& look, Order& order, const Wanted& wanted) const;

    NarrowPhase narrow_;
    PeriodicBox box_;
    ContactOrder order_;
    std::unique_ptr<ThreadTeam> team_, alone_;
};

}  // namespace turbidite::nscd
