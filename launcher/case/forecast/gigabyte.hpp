// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

namespace turbidite {

constexpr double gigabyte = 1e9;  // bytes

}  // namespace turbidite
