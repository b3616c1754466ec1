// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/pencils.hpp"

#include <fftw3.h>

#include <algorithm>
#include <new>

namespace turbidite {

void WholeGrid::Release::operator()(double* values) const {
    fftw_free(values);
}

WholeGrid::WholeGrid(int columns, int rows)
    : columns_(columns),
      rows_(rows),
      values_(fftw_alloc_real(static_cast<std::size_t>(columns) * rows)) {
    if (!values_) throw std::bad_alloc();
    std::fill_n(values_.get(), static_cast<std::size_t>(columns) * rows, 0.0);
}

}  // namespace turbidite
