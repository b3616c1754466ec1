// SPDX-License-Identifier: GPL-2.0-or-later
//
// One axis of a uniform grid and its second difference L, with values at cell centres:
//
//     (L x)_j = (2 x_j - x_{j-1} - x_{j+1})/h2          h  spacing [m], L [1/m2]
//
// L is minus the finite-volume Laplacian per cell length. Beyond an end lies the mirror image that
// gives the end face, half a cell away, its condition:
//
//     neumann     no gradient at the face:  x_{-1} =  x_0     L_00 = 1/h2
//     dirichlet   zero at the face:         x_{-1} = -x_0     L_00 = 3/h2
//     periodic    the opposite end:         x_{-1} = x_{n-1}  L_00 = 2/h2
// which is what OpenFOAM's `Gauss linear` Laplacian does with boundary values at h/2. For every
// pair of ends the eigenvalues of this matrix (not of the differential operator) are known:
//
//     mu_k = (4/h2) sin2(pi (k + s)/(2 n)),  k = 0 .. n-1     s  0, 1, 1/2 for neumann-neumann,
//                                                                dirichlet-dirichlet, mixed
//     mu_k = (4/h2) sin2(pi k/n)                              periodic
//
// Valid C++17.
#pragma once

namespace turbidite {

enum class End { neumann, dirichlet, periodic };

struct AxisOperator {
    int cells = 0;
    double spacing = 0.0;  ///< h [m]
    End lower = End::neumann, upper = End::neumann;

    bool periodic() const { return lower == End::periodic; }

    /// Whether constants are in the kernel: mu_0 = 0.
    bool has_zero_mode() const { return lower != End::dirichlet && upper != End::dirichlet; }

    double coupling() const { return 1.0 / (spacing * spacing); }  ///< -L_{j,j+1} [1/m2]
    double diagonal(int j) const;                                  ///< L_jj [1/m2]
    double eigenvalue(int k) const;                                ///< mu_k [1/m2]
};

/// Throws std::invalid_argument unless there are at least three cells, the spacing is positive, and
/// either both ends or none are periodic.
void check(const AxisOperator& axis);

}  // namespace turbidite
