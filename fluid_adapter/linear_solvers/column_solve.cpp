// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/linear_solvers/column_solve.hpp"

#include <algorithm>
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

LineSolve::LineSolve(const AxisOperator& across, const AxisOperator& along, ModeRange modes,
                     double mu, std::size_t stride)
    : across_(across),
      along_(along),
      modes_(modes),
      stride_(stride),
      has_constants_(mu == 0.0 && modes.first == 0 && modes.count > 0 && across.has_zero_mode() &&
                     along.has_zero_mode()) {
    // mu_k + mu_l of the modes of this rank, which may hold a part of the line
    for (int k = 0; k < modes.count; ++k) mu_.push_back(across.eigenvalue(modes.first + k) + mu);
    if (!along_.periodic()) return;
    w_.resize(of_w(open_length()));
    closing_.resize(modes.count);
    closed_.resize(modes.count);
}

void LineSolve::factorise(const Helmholtz& problem, double normalisation) {
    singular_ = problem.alpha == 0.0 && has_constants_;
    constants_.assign(singular_ ? along_.cells : 0, 0.0);
    normalisation_ = normalisation;
    // Over r = beta/h2: diagonals (alpha/beta + mu + L_jj) h2, and s = h2/(beta normalisation)
    const double per_r = 1.0 / along_.coupling();
    scale_ = per_r / (problem.beta * normalisation);
    std::vector<double> shift;
    for (const double mu : mu_) shift.push_back((problem.alpha / problem.beta + mu) * per_r);
    if (singular_) shift[0] = 1.0;  // any regular value: mode 0 is replaced later
    rows_ = rows_over_r(per_r);
    if (along_.stretched())
        e_.compute(shift, rows_);
    else
        e_.compute(shift, rows_.front().diagonal, rows_[1].diagonal, rows_.back().diagonal,
                   open_length());
    if (!along_.periodic()) return;
    // d_{n-1}
    for (double& d : shift) d += along_.diagonal(along_.cells - 1) * per_r;
    close_the_ring(shift);
}

/// g_j, a_j and what is left of the diagonal.
std::vector<EliminationRow> LineSolve::rows_over_r(double per_r) const {
    std::vector<EliminationRow> rows;
    for (int j = 0; j < open_length(); ++j) {
        if (!along_.stretched()) {
            rows.push_back({1.0, along_.diagonal(j) * per_r, 1.0});
            continue;
        }
        // g_j = h_j/h, a_j = h/d_j; the face of a dirichlet end is half a cell away: h/(h_j/2)
        const double h = along_.spacing, size = along_.size(j) / h;
        const auto at_end = [&](End end) { return end == End::dirichlet ? 2.0 / size : 0.0; };
        const bool last = j + 1 == along_.cells;
        const double above = last ? 0.0 : h / along_.distance(j);
        const double below = j > 0 ? rows.back().above : at_end(along_.lower);
        rows.push_back({size, below + above + (last ? at_end(along_.upper) : 0.0), above});
    }
    return rows;
}

/// w = T^-1 (e_first + e_last) by the same recurrences, and the divisor for the last unknown.
void LineSolve::close_the_ring(const std::vector<double>& diagonal) {
    const int last = open_length() - 1;
    for (int j = 0; j <= last; ++j)
        e_.for_row(j, [&](int begin, int end, const double* e) {
            // e_first + e_last: the neighbours of the last unknown on both sides of it
            const double given = j == 0 || j == last ? 1.0 : 0.0;
            for (int k = begin; k < end; ++k)
                w_[of_w(j) + k] = ((j > 0 ? w_[of_w(j - 1) + k] : 0.0) + given) * e[k - begin];
        });
    for (int j = last - 1; j >= 0; --j) substitute(j, w_.data() + of_w(j), w_.data() + of_w(j + 1));
    for (int k = 0; k < modes_.count; ++k)
        closing_[k] = 1.0 / (diagonal[k] - w_[k] - w_[of_w(last) + k]);
}

void LineSolve::up(int j, double* values) {
    // f of the mode of constants, before the recurrence overwrites it
    if (singular_) constants_[j] = values[at(j)];
    if (j >= open_length()) return;
    double* row = values + at(j);
    const double* below = j > 0 ? values + at(j - 1) : nullptr;
    const double scale = rows_[j].size * scale_, a = j > 0 ? rows_[j - 1].above : 0.0;
    // z_j = (g_j s f_j + a_{j-1} z_{j-1}) e_j
    e_.for_row(j, [&](int begin, int end, const double* e) {
        if (below)
            for (int k = begin; k < end; ++k)
                row[k] = (scale * row[k] + a * below[k]) * e[k - begin];
        else
            for (int k = begin; k < end; ++k) row[k] *= scale * e[k - begin];
    });
}

/// Back substitution: x_j = z_j + a_j e_j x_{j+1}.
void LineSolve::substitute(int j, double* row, const double* above) const {
    const double a = rows_[j].above;
    e_.for_row(j, [&](int begin, int end, const double* e) {
        for (int k = begin; k < end; ++k) row[k] += e[k - begin] * (a * above[k]);
    });
}

double LineSolve::turn(double* values) {
    if (along_.periodic()) close_last(values);
    return singular_ ? solve_constants() : 0.0;
}

/// x_{n-1} of a periodic axis, which needs all of z.
void LineSolve::close_last(double* values) {
    const int n = along_.cells;
    // Down to z_0, so that `down` has only x' = z + w x_{n-1} left to do.
    for (int j = n - 3; j >= 0; --j) substitute(j, values + at(j), values + at(j + 1));
    double* last = values + at(n - 1);
    // x_{n-1} = (s f_{n-1} + z_0 + z_{n-2})/(d_{n-1} - w_0 - w_{n-2})
    for (int k = 0; k < modes_.count; ++k)
        last[k] = (scale_ * last[k] + values[k] + values[at(n - 2) + k]) * closing_[k];
    std::copy_n(last, modes_.count, closed_.begin());
}

void LineSolve::down(int j, double* values) {
    const int last = along_.cells - 1;
    if (along_.periodic() && j < last) {
        const double* w = w_.data() + of_w(j);
        double* row = values + at(j);
        for (int k = 0; k < modes_.count; ++k) row[k] += w[k] * closed_[k];  // x' = z + w x_{n-1}
    } else if (j < last) {
        substitute(j, values + at(j), values + at(j + 1));
    }
    if (!singular_) return;
    // Nothing reads row j + 1 any more: mode 0 gets the solution that `turn` has found.
    if (j < last) values[at(j + 1)] = constants_[j + 1];
    if (j == 0) values[0] = constants_[0];
}

/// The mode of constants, with D_j = a_j (x_{j+1} - x_j) = D_{j-1} - g_j s f_j summed twice from
/// one end. There is no D_{-1} beyond a neumann end; on a periodic axis the D sum to zero.
double LineSolve::solve_constants() {
    const int n = along_.cells;
    const auto size = [&](int j) { return along_.stretched() ? rows_[j].size : 1.0; };
    double mean = 0.0, length = 0.0;
    for (int j = 0; j < n; ++j) length += size(j);
    // Only an f without mean has a solution; the mean is what `turn` returns.
    for (int j = 0; j < n; ++j) mean += size(j) * constants_[j] / length;
    double slope = 0.0, total = 0.0;
    for (int j = 0; j < n; ++j) {
        slope -= size(j) * scale_ * (constants_[j] - mean);
        constants_[j] = slope;
        total += slope;
    }
    // D_{-1}: the D_j = D_{-1} + slope_j of a ring sum to zero.
    const double first = along_.periodic() ? -total / n : 0.0;
    double x = 0.0, sum = 0.0;
    for (int j = 0; j < n; ++j) {
        const double slope_above = constants_[j];
        constants_[j] = x;
        sum += size(j) * x;
        if (j + 1 == n) break;
        x = along_.stretched() ? x + slope_above / rows_[j].above : x + slope_above + first;
    }
    // x has zero mean too, weighted with heights.
    for (double& value : constants_) value -= sum / length;
    return mean / normalisation_;  // mode 0 of a row is its mean times the normalisation
}

ColumnSolve::ColumnSolve(const SeparableOperator& grid, ModeRange modes) : cells_(grid.y.cells) {
    const int nx = grid.x.cells, end = modes.first + modes.count;
    for (int first = modes.first; first < end;) {
        // A rank's modes may begin and end within a line.
        const int line = first / nx, next = std::min(end, (line + 1) * nx);
        lines_.push_back({LineSolve(grid.x, grid.y, {first - line * nx, next - first},
                                    grid.z.eigenvalue(line), modes.count),
                          static_cast<std::size_t>(first - modes.first)});
        first = next;
    }
}

void ColumnSolve::factorise(const Helmholtz& problem, double normalisation) {
    check(problem);
    for (Line& line : lines_) line.solve.factorise(problem, normalisation);
}

void ColumnSolve::up(int j, double* values) {
    for (Line& line : lines_) line.solve.up(j, values + line.first);
}

/// Only one line has the mode of constants.
double ColumnSolve::turn(double* values) {
    double taken = 0.0;
    for (Line& line : lines_) taken += line.solve.turn(values + line.first);
    return taken;
}

void ColumnSolve::down(int j, double* values) {
    for (Line& line : lines_) line.solve.down(j, values + line.first);
}

double ColumnSolve::solve(double* values) {
    for (int j = 0; j < cells_; ++j) up(j, values);
    const double taken = turn(values);
    for (int j = cells_ - 1; j >= 0; --j) down(j, values);
    return taken;
}

}  // namespace turbidite
