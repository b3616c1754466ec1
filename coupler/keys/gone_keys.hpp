// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include <string>

namespace turbidite {

/// Why a key that earlier versions knew has gone, as a sentence; empty for all others.
std::string why_gone(const std::string& key);

}  // namespace turbidite
