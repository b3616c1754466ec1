// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "coupler/protocol/records.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

/// `own`, a rank's part of the fluid [m], widened to where the rank must know every grain: those
/// that affect one of its points or cells.
Box with_reach(Box own, const Settings& settings);

}  // namespace turbidite
