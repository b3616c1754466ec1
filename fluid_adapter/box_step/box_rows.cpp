// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/box_rows.hpp"

#include <algorithm>

namespace turbidite {

void AllRows::exchange(const double* edges, double* outside) {
    if (!periodic_) return;
    const std::size_t two_rows = static_cast<std::size_t>(beyond) * columns_;
    std::copy_n(edges + two_rows, two_rows, outside);
    std::copy_n(edges, two_rows, outside + two_rows);
}

}  // namespace turbidite
