// SPDX-License-Identifier: LGPL-2.1-or-later
//
// output.slices: planes normal to an axis at which a fluid in space is written, "z = 6.4, x = 3".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupler/protocol/settings.hpp"

namespace turbidite {

struct SlicePlane {
    std::size_t axis = 0;  ///< that the plane is normal to
    double place = 0.0;    ///< along it [D]
};

/// None if the text is no such list. Commas and spaces separate planes; `none` is an empty list.
std::optional<std::vector<SlicePlane>> read_slices(const std::string& text);

/// Those of a case that is valid: `auto` is one through the middle of the depth. Empty in the plane
/// and without a fluid.
std::vector<SlicePlane> slices_of(const Settings& settings);

}  // namespace turbidite
