// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Sums over the ranks of what each has for cells that several of them know. Valid C++17.
#pragma once

#include <vector>

#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/plane/boundary_operator.hpp"

namespace turbidite {

/// One of the caller's values that belongs to a cell known to other ranks too.
struct BorderValue {
    int index;  ///< among the values
    int cell;   ///< local index
};

class BorderSums {
 public:
    /// values[index] <- its sum over the ranks, for all of `border`; by every rank, also by one
    /// without values.
    void sum(const FluidField& field, const std::vector<BorderValue>& border, PlaneVector* values);

 private:
    std::vector<double> x_, y_;  // by local cell; zero between calls
};

}  // namespace turbidite
