// SPDX-License-Identifier: GPL-2.0-or-later
//
// The transform that turns the second difference of an axis (separable_operator.hpp) into its
// eigenvalues, along complete rows of values, in place. FFTW's names:
//
//     ends                  there       back        mirror images at the two end faces
//     neumann-neumann       REDFT10     REDFT01     even, even    (DCT-II, DCT-III)
//     dirichlet-dirichlet   RODFT10     RODFT01     odd,  odd     (DST-II, DST-III)
//     neumann-dirichlet     REDFT11     REDFT11     even, odd     (DCT-IV)
//     dirichlet-neumann     RODFT11     RODFT11     odd,  even    (DST-IV)
//     periodic              R2HC        HC2R
//
// R2HC stores frequency k at k and at n - k; sin2(pi k/n) is the same at both.
// FFTW does not normalise: there and back multiplies by `normalisation`, 2n or, periodic, n.
//
// Plans are made once, by FFTW_ESTIMATE. FFTW_MEASURE was 1.05 (rows of 96) to 1.25 times (rows of
// 320, 1600) as fast, but chooses by its clock: two runs of one case would differ in their last
// bits. Valid C++17.
#pragma once

#include <memory>

#include "fluid_adapter/linear_solvers/separable_operator.hpp"

namespace turbidite {

class RowTransform {
 public:
    /// For `rows` rows of axis.cells values, one after the other at `values`, which must outlive
    /// it.
    RowTransform(const AxisOperator& axis, int rows, double* values);
    ~RowTransform();
    RowTransform(const RowTransform&) = delete;
    RowTransform& operator=(const RowTransform&) = delete;

    void forward();
    void backward();
    double normalisation() const { return normalisation_; }

 private:
    struct Plans;
    std::unique_ptr<Plans> plans_;
    double normalisation_;
};

}  // namespace turbidite
