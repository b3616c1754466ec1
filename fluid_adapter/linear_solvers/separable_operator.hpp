// SPDX-License-Identifier: GPL-2.0-or-later
//
// One axis of a grid and its second difference L, with values at cell centres:
//
//     (L x)_j = (2 x_j - x_{j-1} - x_{j+1})/h2          h  spacing [m], L [1/m2]
//
// or, where the cells of an axis have sizes h_j of their own (a stretched axis) and their centres
// distances d_j = (h_j + h_{j+1})/2,
//
//     (L x)_j = ((x_j - x_{j-1})/d_{j-1} + (x_j - x_{j+1})/d_j)/h_j
//
// L is minus the finite-volume Laplacian per cell length. Beyond an end lies the mirror image that
// gives the end face, half a cell away, its condition:
//
//     neumann     no gradient at the face:  x_{-1} =  x_0     L_00 = 1/h2
//     dirichlet   zero at the face:         x_{-1} = -x_0     L_00 = 3/h2
//     periodic    the opposite end:         x_{-1} = x_{n-1}  L_00 = 2/h2
// which is what OpenFOAM's `Gauss linear` Laplacian does with boundary values at h/2; a stretched
// axis is not periodic. For every pair of ends of an axis with equal cells the eigenvalues of this
// matrix (not of the differential operator) are known:
//
//     mu_k = (4/h2) sin2(pi (k + s)/(2 n)),  k = 0 .. n-1     s  0, 1, 1/2 for neumann-neumann,
//                                                                dirichlet-dirichlet, mixed
//     mu_k = (4/h2) sin2(pi k/n)                              periodic
//
// Valid C++17.
#pragma once

#include <vector>

namespace turbidite {

enum class End { neumann, dirichlet, periodic };

struct AxisOperator {
    int cells = 0;
    double spacing = 0.0;  ///< h; of a stretched axis that of its equal cells [m]
    End lower = End::neumann, upper = End::neumann;
    std::vector<double> sizes = {};  ///< h_j of a stretched axis [m]; empty: all cells are equal

    bool stretched() const { return !sizes.empty(); }
    double size(int j) const { return stretched() ? sizes[j] : spacing; }   ///< h_j [m]
    double distance(int j) const { return 0.5 * (size(j) + size(j + 1)); }  ///< d_j [m]

    bool periodic() const { return lower == End::periodic; }

    /// Whether constants are in the kernel: mu_0 = 0.
    bool has_zero_mode() const { return lower != End::dirichlet && upper != End::dirichlet; }

    double diagonal(int j) const;  ///< L_jj [1/m2]

    // Of equal cells:
    double coupling() const { return 1.0 / (spacing * spacing); }  ///< -L_{j,j+1} [1/m2]
    double eigenvalue(int k) const;                                ///< mu_k [1/m2]
};

/// The sum of the operators of all axes of a grid. The cells of one y are a layer, numbered i + nx
/// k: nz rows along x, a single one in the plane.
struct SeparableOperator {
    AxisOperator x, y;
    AxisOperator z = {1, 1.0, End::periodic, End::periodic};  ///< that of the plane: no difference

    bool in_space() const { return z.cells > 1; }
    int layer() const { return x.cells * z.cells; }  ///< number of cells of one y
    bool has_zero_mode() const {
        return x.has_zero_mode() && y.has_zero_mode() && z.has_zero_mode();
    }
};

/// Throws std::invalid_argument unless there are at least three cells, the spacing is positive, and
/// either both ends or none are periodic. A stretched axis has a positive size for every cell, and
/// is not periodic.
void check(const AxisOperator& axis);

/// Throws std::invalid_argument if an axis is refused, but for the single cell of the plane, or if
/// x or z is stretched.
void check(const SeparableOperator& grid);

}  // namespace turbidite
