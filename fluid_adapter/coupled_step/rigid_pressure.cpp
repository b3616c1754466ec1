// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_pressure.hpp"

#include <algorithm>

namespace turbidite {

void RigidPressure::begin(BoxOperators& box, double dt) {
    dt_ = dt;
    p_.assign(step_.pressure(), step_.pressure() + box.size());
}

void RigidPressure::place_grains(BoxOperators& box, const CollocationPoints& points, double k) {
    outside_.assign(box.size(), 1.0);
    for (const InteriorCell& inside : points.interior) outside_[inside.cell] = 0.0;
    box.keep_excess(k, outside_.data(), excess());
}

IterationResult RigidPressure::correct(BoxOperators& box, RigidGrains& grains,
                                       const IterationLimit& limit) {
    const double square = find_residual(box, grains);
    return iterate(
        limit, square, grains.all_cells(),
        [&](bool first, double& rz) { choose_direction(box, grains, first, rz, limit); },
        [&] { return apply(box, grains, limit.most > 1); },
        [&](double alpha) { move(grains, alpha, limit.most > 1); });
}

/// r = -(D u + div e); returns |r|^2.
double RigidPressure::find_residual(BoxOperators& box, const RigidGrains& grains) {
    residual_.resize(box.size());
    const CellVelocity u = grains.velocity();
    double square =
        box.flux_residual(dt_, outside_.data(), p_.data(), u.x, u.y, excess(), residual_.data());
    grains.sum_over_ranks(&square, 1);
    return square;
}

/// z = -(1/dt) laplacian^-1 r
void RigidPressure::precondition() {
    double* values = step_.pressure_solve().values();
    for (std::size_t c = 0; c < residual_.size(); ++c) values[c] = residual_[c] / dt_;
    step_.pressure_solve().solve();
    preconditioned_.assign(values, values + residual_.size());
}

/// d = z + beta d, with W(-dt G d).
void RigidPressure::choose_direction(BoxOperators& box, RigidGrains& grains, bool first, double& rz,
                                     const IterationLimit& limit) {
    precondition();
    rigid_.resize(box.size());
    box.gradient(dt_, preconditioned_.data(), rigid_.x.data(), rigid_.y.data());
    grains.make_rigid(rigid_, limit.slip_reduction);
    if (first) {
        std::swap(direction_, preconditioned_);
        std::swap(rigid_direction_, rigid_);
        return;
    }
    const double last = rz;
    rz = grains.dot(residual_.data(), preconditioned_.data());
    const double beta = rz / last;
    for (std::size_t c = 0; c < direction_.size(); ++c)
        direction_[c] = beta * direction_[c] + preconditioned_[c];
    grains.combine(rigid_direction_, beta, rigid_);
}

/// A d, kept if there may be another iteration.
ImageProducts RigidPressure::apply(BoxOperators& box, const RigidGrains& grains, bool keep) {
    if (keep) image_.resize(box.size());
    ImageProducts products =
        box.flux_image(dt_, outside_.data(), direction_.data(), rigid_direction_.x.data(),
                       rigid_direction_.y.data(), residual_.data(), keep ? image_.data() : nullptr);
    grains.sum_over_ranks(products.data(), ImageProducts::count);
    return products;
}

/// p += alpha d, u += alpha W(-dt G d), r -= alpha A d.
void RigidPressure::move(RigidGrains& grains, double alpha, bool again) {
    for (std::size_t c = 0; c < p_.size(); ++c) p_[c] += alpha * direction_[c];
    grains.add(rigid_direction_, alpha);
    for (std::size_t c = 0; again && c < residual_.size(); ++c) residual_[c] -= alpha * image_[c];
}

void RigidPressure::end(BoxOperators& box) {
    box.add_to_excess(dt_, outside_.data(), p_.data(), excess());
    std::copy(p_.begin(), p_.end(), step_.pressure());
}

}  // namespace turbidite
