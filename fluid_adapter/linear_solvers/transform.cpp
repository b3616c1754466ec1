// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/transform.hpp"

#include <fftw3.h>

#include <array>
#include <stdexcept>

namespace turbidite {
namespace {

struct KindEntry {
    End lower, upper;
    fftw_r2r_kind there, back;
};

constexpr std::array<KindEntry, 5> kinds = {{
    {End::neumann, End::neumann, FFTW_REDFT10, FFTW_REDFT01},
    {End::dirichlet, End::dirichlet, FFTW_RODFT10, FFTW_RODFT01},
    {End::neumann, End::dirichlet, FFTW_REDFT11, FFTW_REDFT11},
    {End::dirichlet, End::neumann, FFTW_RODFT11, FFTW_RODFT11},
    {End::periodic, End::periodic, FFTW_R2HC, FFTW_HC2R},
}};

const KindEntry& kind_of(const AxisOperator& axis) {
    for (const KindEntry& entry : kinds)
        if (entry.lower == axis.lower && entry.upper == axis.upper) return entry;
    throw std::invalid_argument("no transform fits the ends of this axis");
}

/// Null for a rank without rows.
fftw_plan plan_rows(int length, int rows, double* values, fftw_r2r_kind kind) {
    if (rows == 0) return nullptr;
    fftw_plan plan = fftw_plan_many_r2r(1, &length, rows, values, nullptr, 1, length, values,
                                        nullptr, 1, length, &kind, FFTW_ESTIMATE);
    if (!plan) throw std::runtime_error("FFTW made no plan for rows of " + std::to_string(length));
    return plan;
}

}  // namespace

struct RowTransform::Plans {
    Plans(const AxisOperator& axis, int rows, double* values)
        : there(plan_rows(axis.cells, rows, values, kind_of(axis).there)),
          back(plan_rows(axis.cells, rows, values, kind_of(axis).back)) {}
    ~Plans() {
        if (there) fftw_destroy_plan(there);
        if (back) fftw_destroy_plan(back);
    }
    fftw_plan there, back;
};

RowTransform::RowTransform(const AxisOperator& axis, int rows, double* values)
    : plans_(std::make_unique<Plans>(axis, rows, values)),
      normalisation_(axis.periodic() ? axis.cells : 2.0 * axis.cells) {}

RowTransform::~RowTransform() = default;

void RowTransform::forward() {
    if (plans_->there) fftw_execute(plans_->there);
}

void RowTransform::backward() {
    if (plans_->back) fftw_execute(plans_->back);
}

}  // namespace turbidite
