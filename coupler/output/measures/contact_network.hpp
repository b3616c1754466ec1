// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Averages over the contacts at one time. The points of a pair that touches along an edge count as
// one link: they connect the grain to a single neighbour.
//
//     coordination   Z = (2 N_gg + N_gw)/N: links between grains and to walls over the number of
//                    grains with a link; grains without one (rattlers, fliers) are counted apart
//     fabric         F = mean of n n^T over links between grains; in the plane its principal values
//                    F_1 >= F_2 give P(theta) = (1 + a cos 2(theta - theta_1))/(2 pi),
//                    a = 2 (F_1 - F_2). In space P(n) = (1 + n^T A n)/(4 pi), A = (15/2) dev F, and
//                    a = sqrt(3/2) |A|, for a fabric with an axis 3/2 of A's value along it
//     virial         sum of f l^T over all links [N m]: contact stress times area, l from centre
//                    to centre, or from the wall to the centre; compression is positive
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "coupler/protocol/records.hpp"
#include "coupler/rigid/symmetric3.hpp"

namespace turbidite {

struct Fabric {
    /// a: 0 the same in all directions; all normals parallel: 2, in space 7.5.
    double anisotropy = 0.0;
    /// theta_1, the preferred direction of the normals, (-pi/2, pi/2]; of no meaning in space.
    double angle = 0.0;
};

struct ContactNetwork {
    std::int64_t grain_links = 0;         ///< N_gg
    std::int64_t wall_links = 0;          ///< N_gw
    std::int64_t loose_grains = 0;        ///< grains without a link
    std::optional<double> coordination;   ///< empty without links
    std::optional<Fabric> fabric;         ///< empty without links between grains
    std::optional<double> normal_force;   ///< mean over links between grains [N]
    std::optional<double> sliding_share;  ///< of all contact points, those at the friction limit
    Symmetric3 virial;                    ///< its symmetric part [N m]
    bool has_branches = true;             ///< without them the virial is of no meaning
};

/// `contacts` in the order of contact_before; `grains` is the number of grains, `step` the time
/// over which the impulses acted [s].
ContactNetwork contact_network(const std::vector<ContactRecord>& contacts, std::size_t grains,
                               double step, int dimension = 2);

}  // namespace turbidite
