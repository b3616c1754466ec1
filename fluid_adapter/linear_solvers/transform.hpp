// SPDX-License-Identifier: GPL-2.0-or-later
//
// The transform that diagonalises the second difference of an axis (separable_operator.hpp), along
// complete rows of values, in place. In FFTW's names:
//
//     ends                  forward     backward    mirror images at the two end faces
//     neumann-neumann       REDFT10     REDFT01     even, even    (DCT-II, DCT-III)
//     dirichlet-dirichlet   RODFT10     RODFT01     odd,  odd     (DST-II, DST-III)
//     neumann-dirichlet     REDFT11     REDFT11     even, odd     (DCT-IV)
//     dirichlet-neumann     RODFT11     RODFT11     odd,  even    (DST-IV)
//     periodic              R2HC        HC2R
//
// R2HC stores frequency k at k and at n - k; sin2(pi k/n) is the same at both. Nothing is
// normalised: a forward and a backward transform multiply by `normalisation`, which is 2n, or n if
// periodic.
//
// FFTW's own plans for these kinds are scalar code. Complex transforms are vectorised, and one of
// them carries two rows, as real and imaginary part (fourier_rows.cpp): 3 to 4 times as fast. Plans
// are made once, by FFTW_ESTIMATE: FFTW_MEASURE decides by timing, and two runs of one case would
// differ in their last bits. Valid C++17.
#pragma once

#include <memory>
#include <vector>

#include "fluid_adapter/linear_solvers/separable_operator.hpp"

namespace turbidite {

class RowTransform {
 public:
    /// For rows of axis.cells values.
    explicit RowTransform(const AxisOperator& axis);
    ~RowTransform();
    RowTransform(const RowTransform&) = delete;
    RowTransform& operator=(const RowTransform&) = delete;

    /// Transforms two rows in place; `second` may be null.
    void forward(double* first, double* second);
    void backward(double* first, double* second);

    /// Factor by which a forward and a backward transform together multiply.
    double normalisation() const { return normalisation_; }

    /// Interface of the transform for one pair of ends.
    class Kind {
     public:
        virtual ~Kind() = default;
        virtual void forward(double* first, double* second) = 0;
        virtual void backward(double* first, double* second) = 0;
    };

 private:
    double* absent_row();

    std::unique_ptr<Kind> kind_;
    std::vector<double> absent_;  // stands in for a missing second row
    double normalisation_;
};

}  // namespace turbidite
