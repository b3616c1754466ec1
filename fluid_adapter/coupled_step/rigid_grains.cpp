// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_grains.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {

RigidGrains::RigidGrains(SaddleOperator& system, ConstrainedFlow& flow, CellVelocity velocity,
                         const MultiplierSettings& settings)
    : system_(system),
      flow_(flow),
      velocity_(velocity),
      settings_(settings),
      cells_(system.field().owned_cells()),
      all_cells_(static_cast<double>(cells_)) {
    weigh_rows();
    system.field().sum_over_ranks(&all_cells_, 1);
}

/// The rank's cells are complete rows, in the order of the rows.
void RigidGrains::weigh_rows() {
    const CellGrid& grid = system_.field().grid();
    if (!grid.stretched(1)) return;
    int row = 0;
    while (row < grid.counts[1] && system_.field().cell(0, row, 0) != 0) ++row;
    const std::size_t columns = grid.counts[0];
    for (std::size_t done = 0; done < cells_; done += columns)
        row_weights_.push_back(grid.size(1, row++) / grid.size(1, 0));
    all_cells_ = static_cast<double>(columns) *
                 std::accumulate(row_weights_.begin(), row_weights_.end(), 0.0);
}

void RigidGrains::make_rigid(RigidChange& change, double reduction) {
    MultiplierSettings settings = settings_;
    settings.tolerance = 1.0;  // the slip of a change is judged by its own size
    settings.reduction = reduction;
    change.grains.begin(system_, change.velocity());
    note(uzawa_cg(change.grains, settings, work_));
    change.grains.impose();
}

MultiplierResult RigidGrains::settle() {
    velocity();
    const MultiplierResult result = uzawa_cg(flow_, settings_, work_);
    note(result);
    flow_.impose();
    return result;
}

void RigidGrains::note(const MultiplierResult& result) {
    iterations_ += result.iterations;
    converged_ = converged_ && result.converged;
}

void RigidGrains::combine(RigidChange& change, double keep, const RigidChange& other) const {
    for (std::size_t c = 0; c < cells_; ++c) {
        change.x[c] = keep * change.x[c] + other.x[c];
        change.y[c] = keep * change.y[c] + other.y[c];
    }
    change.grains.scale(keep);
    change.grains.add(other.grains, 1.0);
}

void RigidGrains::add(const RigidChange& change, double share) {
    add_later(change, share);
    velocity();
}

void RigidGrains::add_later(const RigidChange& change, double share) {
    velocity();
    pending_ = {share, change.x.data(), change.y.data()};
    flow_.add(change.grains, share);
}

PendingChange RigidGrains::take_pending() {
    return std::exchange(pending_, {});
}

CellVelocity RigidGrains::velocity() {
    const PendingChange change = take_pending();
    for (std::size_t c = 0; change.share != 0.0 && c < cells_; ++c) {
        velocity_.x[c] += change.share * change.x[c];
        velocity_.y[c] += change.share * change.y[c];
    }
    return velocity_;
}

double RigidGrains::dot(const double* a, const double* b) const {
    using Vector = Eigen::Map<const Eigen::VectorXd>;
    const auto size = static_cast<Eigen::Index>(cells_);
    double sum = row_weights_.empty() ? Vector(a, size).dot(Vector(b, size)) : 0.0;
    const std::size_t columns = row_weights_.empty() ? 0 : cells_ / row_weights_.size();
    for (std::size_t j = 0; j < row_weights_.size(); ++j)
        sum +=
            row_weights_[j] * dot_row(static_cast<int>(columns), a + j * columns, b + j * columns);
    system_.field().sum_over_ranks(&sum, 1);
    return sum;
}

}  // namespace turbidite
