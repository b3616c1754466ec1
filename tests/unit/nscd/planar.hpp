// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Components of contact vectors in the plane by matrix index: 0 normal, 1 tangent, 2 roll; and the
// mobilities of a problem of the plane.
#pragma once

#include "granular_adapter/nscd/problem/contact_problem.hpp"

namespace turbidite::nscd::planar {

inline double& component(ContactVector& x, int i) {
    return i == 0 ? x.n : i == 1 ? x.t : x.roll;
}

inline double component(const ContactVector& x, int i) {
    return i == 0 ? x.n : i == 1 ? x.t : x.roll;
}

inline std::vector<PlanarTensor>& bodies(ContactProblem& problem) {
    return std::get<std::vector<PlanarTensor>>(problem.bodies);
}

inline const std::vector<PlanarTensor>& bodies(const ContactProblem& problem) {
    return std::get<std::vector<PlanarTensor>>(problem.bodies);
}

}  // namespace turbidite::nscd::planar
