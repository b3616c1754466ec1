// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the contacts of one instant say about the packing. The points of a pair that touches along
// an edge are one link: a grain has a neighbour, not two.
//
//     coordination       Z = (2 N_gg + N_gw) / N, links between grains and to walls over the grains
//     that
//                        have a link; grains without any (rattlers, fliers) are counted apart
//     fabric             F = mean of n n^T over links between grains; its principal values F_1 >=
//     F_2
//                        give P(theta) = (1 + a cos 2(theta - theta_1))/(2 pi) with a = 2 (F_1 -
//                        F_2)
//     virial             sum of f l^T over all links [N m]: the contact stress times the area, l
//     from
//                        centre to centre, or from the wall to the centre; compression is positive
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "coupler/protocol/records.hpp"

namespace turbidite {

struct Fabric {
    double anisotropy = 0.0;  ///< a: 0 the same in all directions, 2 all normals parallel
    double angle = 0.0;       ///< theta_1, of the direction that most normals have, (-pi/2, pi/2]
};

/// Plane stress or virial, its symmetric part.
struct PlaneTensor {
    double xx = 0.0, xy = 0.0, yy = 0.0;
};

struct ContactNetwork {
    std::int64_t grain_links = 0;         ///< N_gg
    std::int64_t wall_links = 0;          ///< N_gw
    std::int64_t loose_grains = 0;        ///< grains without a link
    std::optional<double> coordination;   ///< empty without links
    std::optional<Fabric> fabric;         ///< empty without links between grains
    std::optional<double> normal_force;   ///< mean over links between grains [N]
    std::optional<double> sliding_share;  ///< of all contact points, those at the friction limit
    PlaneTensor virial;                   ///< [N m]
};

/// `contacts` in the order of contact_before; `grains` is how many there are, `step` the time that
/// the impulses took [s].
ContactNetwork contact_network(const std::vector<ContactRecord>& contacts, std::size_t grains,
                               double step);

}  // namespace turbidite
