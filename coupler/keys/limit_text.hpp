// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace turbidite {

/// A limit as messages name it, with so many significant digits, rounded to the side that is
/// allowed: who writes what a message says is not refused again.
std::string at_most_text(double limit, int digits);
std::string at_least_text(double limit, int digits);

}  // namespace turbidite
