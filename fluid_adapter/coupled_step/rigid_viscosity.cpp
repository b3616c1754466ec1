// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_viscosity.hpp"

#include <algorithm>
#include <utility>

namespace turbidite {

ImpulsesOfWindow& RigidViscosity::begin(double dt, double nu) {
    per_laplacian_ = nu * dt;
    pending_ = 0.0;
    summed_ = true;
    window_.dt = dt;
    return window_;
}

const VelocityRows& RigidViscosity::impulse() {
    // f += share r, put off by move_only until f is read
    const double share = std::exchange(pending_, 0.0);
    for (int axis = 0; share != 0.0 && axis < window_.f.size(); ++axis)
        for (std::size_t c = 0; c < residual_[axis].size(); ++c)
            window_.f[axis][c] += share * residual_[axis][c];
    return window_.f;
}

BoxForce RigidViscosity::sum(const BoxOperators& box) {
    if (!std::exchange(summed_, true))
        for (int axis = 0; axis < box.components(); ++axis)
            window_.sum_f[axis] = box.sum_of_cells(impulse()[axis]);
    return window_.sum_f;
}

IterationResult RigidViscosity::correct(BoxOperators& box, RigidGrains& grains,
                                        const IterationLimit& limit) {
    const ResidualSquare square = find_residual(box, grains);
    if (square.sum == 0.0) return {};
    return iterate(
        // The rms of r/dt, an acceleration [m/s2]
        limit, square.sum, window_.dt * window_.dt * square.cells,
        [&](bool first, double& rz) { choose_direction(box, grains, first, rz, limit); },
        [&] { return apply(box, grains, limit.most > 1); },
        [&](double alpha) { move(grains, alpha, limit.most > 1); });
}

/// r = dt nu L u - f; returns |r|^2.
ResidualSquare RigidViscosity::find_residual(BoxOperators& box, RigidGrains& grains) {
    residual_.resize(box.components(), box.size());
    rigid_residual().u.resize(box.components(), box.size());
    // Includes what is pending: unlike pressure this does not make the change as it reads.
    const VelocityPointers u = grains.velocity();
    const VelocityRows& f = impulse();
    ResidualSquare square;
    for (int axis = 0; axis < u.size(); ++axis) {
        const ViscousSums one =
            box.viscous_residual(per_laplacian_, axis, u[axis], f[axis].data(),
                                 residual_[axis].data(), rigid_residual().u[axis].data());
        square.sum += one.square;
        sum_residual_[axis] = one.sum;
    }
    square.cells = box.volume();
    grains.sum_over_ranks(square.data(), ResidualSquare::count);
    return square;
}

/// z = W r, and d = r + beta d with W d.
void RigidViscosity::choose_direction(const BoxOperators& box, RigidGrains& grains, bool first,
                                      double& rz, const IterationLimit& limit) {
    // The first time find_residual has left a copy of r there.
    if (!first) rigid_residual().u = residual_;
    grains.make_rigid(rigid_residual(), limit.slip_reduction);
    if (first) {
        // d = r, so W d = W r; r.z comes with the image (ImageProducts::step).
        std::swap(rigid_direction_, rigid_residual());
        direction_ = nullptr;
        return;
    }
    const double last = rz;
    rz = 0.0;
    for (int axis = 0; axis < residual_.size(); ++axis)
        rz += box.dot(residual_[axis], rigid_residual().u[axis]);
    grains.sum_over_ranks(&rz, 1);
    // r.W r over that of the last iteration: A = I - dt nu L W is symmetric in the product a.W b.
    const double beta = rz / last;
    for (int axis = 0; axis < residual_.size(); ++axis)
        for (std::size_t c = 0; c < residual_[axis].size(); ++c)
            later_[axis][c] = beta * later_[axis][c] + residual_[axis][c];
    grains.combine(rigid_direction_, beta, rigid_residual());
    direction_ = &later_;
}

/// A d = d - dt nu L W d, kept if there may be another iteration.
ImageProducts RigidViscosity::apply(BoxOperators& box, const RigidGrains& grains, bool keep) {
    if (keep) image().resize(box.components(), box.size());
    const VelocityRows& d = direction_ ? *direction_ : residual_;
    ImageProducts sum;
    for (int axis = 0; axis < d.size(); ++axis) {
        // `direction` is A d . W d: the curvature in that product, without another solve.
        const ImageProducts one =
            box.viscous_image(per_laplacian_, axis, d[axis].data(), rigid_direction_.u[axis].data(),
                              residual_[axis].data(), keep ? image()[axis].data() : nullptr);
        sum.direction += one.direction;
        sum.residual += one.residual;
        sum.itself += one.itself;
        sum.step += one.step;
    }
    grains.sum_over_ranks(sum.data(), ImageProducts::count);
    return sum;
}

/// The same for an only iteration, where d = r and later iterations need neither.
void RigidViscosity::move_only(RigidGrains& grains, double alpha) {
    pending_ = alpha;
    for (int axis = 0; axis < residual_.size(); ++axis)
        window_.sum_f[axis] += alpha * sum_residual_[axis];
    grains.add_later(rigid_direction_, alpha);
}

/// f += alpha d, u += alpha W d, r -= alpha A d.
void RigidViscosity::move(RigidGrains& grains, double alpha, bool again) {
    if (!again) return move_only(grains, alpha);
    const VelocityRows& d = direction_ ? *direction_ : residual_;
    for (int axis = 0; axis < d.size(); ++axis)
        for (std::size_t c = 0; c < d[axis].size(); ++c) window_.f[axis][c] += alpha * d[axis][c];
    summed_ = false;
    grains.add(rigid_direction_, alpha);
    if (!direction_) later_ = residual_;  // the first direction
    const VelocityRows& image = this->image();
    for (int axis = 0; axis < image.size(); ++axis)
        for (std::size_t c = 0; c < image[axis].size(); ++c)
            residual_[axis][c] -= alpha * image[axis][c];
}

}  // namespace turbidite
