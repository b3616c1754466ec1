// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The multiplier methods by the values of `fluid.points`. Valid C++17.
#pragma once

#include <string>
#include <vector>

#include "fluid_adapter/multiplier/interior_closed_form.hpp"
#include "fluid_adapter/multiplier/uzawa_cg.hpp"

namespace turbidite {

struct MethodEntry {
    std::string points;  ///< value of `fluid.points`
    std::string description;
    bool boundary_points;
    MultiplierResult (*solve)(SaddlePoint&, const MultiplierSettings&, MultiplierWorkspace&);
};

const std::vector<MethodEntry>& method_list();

/// Throws std::invalid_argument that lists the known values.
const MethodEntry& find_method(const std::string& points);

}  // namespace turbidite
