// SPDX-License-Identifier: GPL-2.0-or-later
//
// The five row transforms of transform.hpp, by FFTW's complex transforms. A row is the values of
// one y.
//
// Two real rows a, b of n values form one complex row z = a + ib; with Z its transform,
//
//     A_k = (Z_k + conj Z_{n-k})/2,   B_k = (Z_k - conj Z_{n-k})/2i
//
// DCT-II (Makhoul 1980): A of the row reordered, even positions ascending, then odd ones
// descending; then X_k = 2 Re(w A_k), X_{n-k} = -2 Im(w A_k), w = exp(-i pi k/2n). DST-II: the
// signs of odd positions are changed first, and the order of the result is reversed. DCT-IV: one
// complex transform of n/2 values per row, z_j = (x_2j + i x_{n-1-2j}) t_j, t_j = exp(-i pi (8j +
// 1)/8n), and X_2k - i X_{n-1-2k} = 2 t_k Z_k. DST-IV: the row is reversed first, and the signs of
// odd modes are changed in the result. For odd n the last two use FFTW's real plans. Valid C++17.
#pragma once

#include "fluid_adapter/linear_solvers/transform.hpp"

namespace turbidite {

/// Throws std::invalid_argument for a pair of ends that has no transform.
std::unique_ptr<RowTransform::Kind> make_row_kind(const AxisOperator& axis);

}  // namespace turbidite
