// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/pencils.hpp"

#include <fftw3.h>

#include <algorithm>
#include <new>

namespace turbidite {

void ReleaseAligned::operator()(double* values) const {
    fftw_free(values);
}

AlignedValues aligned_values(std::size_t count) {
    // A rank may have no row, and FFTW may return null for zero bytes.
    AlignedValues values(fftw_alloc_real(std::max<std::size_t>(count, 1)));
    if (!values) throw std::bad_alloc();
    std::fill_n(values.get(), count, 0.0);
    return values;
}

WholeGrid::WholeGrid(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      values_(aligned_values(static_cast<std::size_t>(columns) * rows)) {}

}  // namespace turbidite
