// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// Valid C++17.
#pragma once

#include <string>

namespace turbidite {

/// The name of this machine, as hellos, logs and start records have it.
std::string host_name();

}  // namespace turbidite
