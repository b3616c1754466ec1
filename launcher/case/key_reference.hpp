// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The table of keys as Markdown (docs/case-reference.md, `turbidite keys`).
#pragma once

#include <string>

namespace turbidite {

std::string key_reference();

}  // namespace turbidite
