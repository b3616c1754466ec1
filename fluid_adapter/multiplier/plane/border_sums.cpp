// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/border_sums.hpp"

namespace turbidite {

void BorderSums::sum(const FluidField& field, const std::vector<BorderValue>& border,
                     PlaneVector* values) {
    // By local cell, as share_sums wants them. Only cells of the border are ever set, and reset
    // below: a sum costs what the border costs, not the grid.
    x_.resize(field.local_cells(), 0.0);
    y_.resize(field.local_cells(), 0.0);
    for (const BorderValue& at : border) {
        x_[at.cell] = values[at.index].x;
        y_[at.cell] = values[at.index].y;
    }
    // Also with an empty border: all ranks take part.
    field.share_sums(x_.data(), y_.data());
    for (const BorderValue& at : border) {
        values[at.index] = {x_[at.cell], y_[at.cell]};
        x_[at.cell] = y_[at.cell] = 0.0;
    }
}

}  // namespace turbidite
