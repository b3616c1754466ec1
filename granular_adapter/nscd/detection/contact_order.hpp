// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order in which Gauss-Seidel visits the contacts: from the top down, the direction in which
// weight is transmitted; this needs a third fewer sweeps than the order of detection.
//
// Contacts at one height (layers of a lattice) are taken colour by colour, so that no two
// neighbours follow each other. From left to right each would depend on the one before, and groups
// of four (contact_schedule.hpp) would stay two thirds empty.
#pragma once

#include <vector>

#include "granular_adapter/nscd/detection/contact_point.hpp"
#include "granular_adapter/nscd/threads/thread_team.hpp"

namespace turbidite::nscd {

/// Sorts along gravity; without gravity the order stays as it is. The result depends only on the
/// input.
class TopDownOrder {
 public:
    /// Keeps a reference to the bodies. Heights that differ by less than `band` [m] count as equal.
    TopDownOrder(const Bodies& bodies, const Vec3& gravity, double band);

    /// What decides where a point comes.
    struct Place {
        double layer;        ///< an integer, increasing downwards
        std::int32_t a, b;   ///< bodies of the contact
        std::int32_t point;  ///< index in the order of detection
    };
    Place place(const ContactPoint& point) const;

    void add(Place place);

    /// Indices of the points added so far, in order.
    std::vector<std::int32_t> take(ThreadTeam&);

 private:
    const Bodies& bodies_;
    double band_;
    bool sorts_;
    Vec3 down_{};
    std::vector<Place> places_;
};

/// The points in an order that has none so far (TopDownOrder, CellOrder). Where points are cheaper
/// to find again than to move, add them to the order one by one instead.
template <class Order>
std::vector<ContactPoint> sorted_by(Order& order, const std::vector<ContactPoint>& points,
                                    ThreadTeam& team) {
    for (const ContactPoint& point : points) order.add(order.place(point));
    std::vector<ContactPoint> sorted;
    sorted.reserve(points.size());
    for (const std::int32_t i : order.take(team))
        sorted.push_back(points[static_cast<std::size_t>(i)]);
    return sorted;
}

}  // namespace turbidite::nscd
