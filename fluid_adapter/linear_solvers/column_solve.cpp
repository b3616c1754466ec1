// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/column_solve.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace turbidite {
namespace {

void check(const Helmholtz& problem) {
    if (!(problem.alpha >= 0.0 && problem.beta > 0.0 && std::isfinite(problem.alpha) &&
          std::isfinite(problem.beta)))
        throw std::invalid_argument("alpha = " + std::to_string(problem.alpha) +
                                    ", beta = " + std::to_string(problem.beta) +
                                    ": a separable solve needs alpha >= 0 and beta > 0");
}

}  // namespace

ColumnSolve::ColumnSolve(const AxisOperator& across, const AxisOperator& along, ModeRange modes)
    : across_(across), along_(along), modes_(modes) {
    for (int k = 0; k < modes.count; ++k) mu_.push_back(across.eigenvalue(modes.first + k));
    e_.resize(at(open_length()));
    if (!along_.periodic()) return;
    w_.resize(e_.size());
    closing_.resize(modes.count);
}

void ColumnSolve::factorise(const Helmholtz& problem, double normalisation) {
    check(problem);
    singular_ = problem.alpha == 0.0 && modes_.first == 0 && modes_.count > 0 &&
                across_.has_zero_mode() && along_.has_zero_mode();
    normalisation_ = normalisation;
    scale_ = 1.0 / (problem.beta * along_.coupling() * normalisation);
    eliminate(problem);
    if (along_.periodic()) close_the_ring(problem);
}

void ColumnSolve::eliminate(const Helmholtz& problem) {
    const double per_r = 1.0 / along_.coupling();
    const double shift = problem.alpha / problem.beta;
    for (int j = 0; j < open_length(); ++j) {
        // The last pivot of the mode of constants is zero, and hosts may trap a division by it:
        // its unknown is free.
        const bool free_unknown = singular_ && j == along_.cells - 1;
        if (free_unknown) e_[at(j)] = 0.0;
        for (int k = free_unknown ? 1 : 0; k < modes_.count; ++k) {
            const double d = (shift + mu_[k] + along_.diagonal(j)) * per_r;
            e_[at(j) + k] = 1.0 / (d - (j > 0 ? e_[at(j - 1) + k] : 0.0));
        }
    }
}

void ColumnSolve::close_the_ring(const Helmholtz& problem) {
    const int last = along_.cells - 2;  // of the open part
    const double per_r = 1.0 / along_.coupling();
    const double shift = problem.alpha / problem.beta;
    for (int k = 0; k < modes_.count; ++k) {
        w_[k] = e_[k];
        for (int j = 1; j <= last; ++j)
            w_[at(j) + k] = (w_[at(j - 1) + k] + (j == last ? 1.0 : 0.0)) * e_[at(j) + k];
        for (int j = last - 1; j >= 0; --j) w_[at(j) + k] += e_[at(j) + k] * w_[at(j + 1) + k];
        const double d = (shift + mu_[k] + along_.diagonal(along_.cells - 1)) * per_r;
        const bool free_unknown = singular_ && k == 0;
        closing_[k] = free_unknown ? 0.0 : 1.0 / (d - w_[k] - w_[at(last) + k]);
    }
}

double ColumnSolve::solve(double* values) const {
    const double taken = singular_ ? make_compatible(values) : 0.0;
    forward(values);
    backward(values);
    if (along_.periodic()) spread_last(values);
    if (singular_) remove_mean(values);
    return taken;
}

void ColumnSolve::forward(double* values) const {
    for (int k = 0; k < modes_.count; ++k) values[k] *= scale_ * e_[k];
    for (int j = 1; j < open_length(); ++j) {
        const double* e = e_.data() + at(j);
        const double* below = values + at(j - 1);
        double* row = values + at(j);
        for (int k = 0; k < modes_.count; ++k) row[k] = (scale_ * row[k] + below[k]) * e[k];
    }
}

void ColumnSolve::backward(double* values) const {
    for (int j = open_length() - 2; j >= 0; --j) {
        const double* e = e_.data() + at(j);
        const double* above = values + at(j + 1);
        double* row = values + at(j);
        for (int k = 0; k < modes_.count; ++k) row[k] += e[k] * above[k];
    }
}

void ColumnSolve::spread_last(double* values) const {
    const int n = along_.cells;
    double* last = values + at(n - 1);
    for (int k = 0; k < modes_.count; ++k)
        last[k] = (scale_ * last[k] + values[k] + values[at(n - 2) + k]) * closing_[k];
    for (int j = 0; j < n - 1; ++j) {
        const double* w = w_.data() + at(j);
        double* row = values + at(j);
        for (int k = 0; k < modes_.count; ++k) row[k] += w[k] * last[k];
    }
}

double ColumnSolve::make_compatible(double* values) const {
    double sum = 0.0;
    for (int j = 0; j < along_.cells; ++j) sum += values[at(j)];
    const double mean = sum / along_.cells;
    for (int j = 0; j < along_.cells; ++j) values[at(j)] -= mean;
    return mean / normalisation_;  // mode 0 of a row is its mean times this
}

void ColumnSolve::remove_mean(double* values) const {
    double sum = 0.0;
    for (int j = 0; j < along_.cells; ++j) sum += values[at(j)];
    for (int j = 0; j < along_.cells; ++j) values[at(j)] -= sum / along_.cells;
}

}  // namespace turbidite
