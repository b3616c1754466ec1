// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Version and commit that the launcher was built from.
#pragma once

#include <string>

namespace turbidite {

/// "0.1.0".
std::string version();
/// Ten digits of the commit; empty if the sources had no history.
std::string commit();

}  // namespace turbidite
