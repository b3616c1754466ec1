// SPDX-License-Identifier: LGPL-2.1-or-later
/// \file
/// What balances of momentum are relative to where all of their terms are rounding. Valid C++17.
#pragma once

namespace turbidite {

/// Of a momentum that does not change: its rounding, some 1e-16 to 1e-14 of it, is no defect.
constexpr double beyond_rounding = 1e-7;

}  // namespace turbidite
