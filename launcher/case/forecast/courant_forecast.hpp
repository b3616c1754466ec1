// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Courant number that a case will have, before it runs.
#pragma once

#include <string>

#include "launcher/case/case_file.hpp"

namespace turbidite {

/// Of the fastest of: grains that fall alone, with a drag coefficient of one or viscous, and the
/// grains at t = 0. Streams between grains may be several times as fast. 0 without a fluid.
double forecast_courant(const ResolvedCase& resolved);

/// A sentence with the remedy if that is above the limit
/// (coupler/output/measures/courant_limit.hpp); otherwise empty.
std::string courant_warning(const ResolvedCase& resolved);

}  // namespace turbidite
