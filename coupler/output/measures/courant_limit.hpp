// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Courant number |u| dt/h of a window up to which its motion may be trusted. Transport stays
// stable above it, since it is cut into parts
// (fluid_adapter/box_step/transport/transport_parts.hpp), but the splitting of a window and the
// contacts found at its start do not follow what moves by several cells in it.
#pragma once

#include <string>

namespace turbidite {

/// docs/validation.md, "How large a window may be".
inline constexpr double largest_courant = 1.5;

/// A time step [t_c] that brings this Courant number below the limit, one digit, rounded down.
double step_for_courant(double step, double courant);

/// What it means and what to do; `courant` is above the limit, `step` is in t_c.
std::string courant_advice(double step, double courant);

}  // namespace turbidite
