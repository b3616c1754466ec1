// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Components of contact vectors in the plane by matrix index: 0 normal, 1 tangent, 2 roll.
#pragma once

#include "granular_adapter/nscd/problem/contact_vector.hpp"

namespace turbidite::nscd::planar {

inline double& component(ContactVector& x, int i) {
    return i == 0 ? x.n : i == 1 ? x.t : x.roll;
}

inline double component(const ContactVector& x, int i) {
    return i == 0 ? x.n : i == 1 ? x.t : x.roll;
}

}  // namespace turbidite::nscd::planar
