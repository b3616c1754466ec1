// SPDX-License-Identifier: LGPL-2.1-or-later
//
// How far the tangential spring of every contact point is stretched: kept by name from sub-step to
// sub-step while the point is there, and zero for a new one.
#pragma once

#include <vector>

#include "granular_adapter/nscd/problem/byte_stream.hpp"
#include "granular_adapter/soft/overlaps.hpp"

namespace turbidite::soft {

class Slips {
 public:
    /// Keeps those of the given points, which are in ascending order of names, and no others.
    void follow(const std::vector<Overlap>& points);

    /// Of the i-th point of the last follow() [m], as point_force.hpp uses it.
    Vec3& operator[](std::size_t i) { return slips_[i]; }

    void save(nscd::ByteWriter& writer) const;
    void restore(nscd::ByteReader& reader);

 private:
    std::vector<nscd::ContactKey> names_;
    std::vector<Vec3> slips_;
};

}  // namespace turbidite::soft
