// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace turbidite {

inline const std::string program = TURBIDITE_PROGRAM;

}  // namespace turbidite
