// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_viscosity.hpp"

#include <cmath>

namespace turbidite {
namespace {

constexpr double slip_reduction = 1e-2;  // of a direction's slip; what is left is part of the flow's

double dot(const RigidGrains& grains, const RowsOfTwo& a, const std::vector<double>& x,
           const std::vector<double>& y) {
    return grains.dot(a.x.data(), x.data()) + grains.dot(a.y.data(), y.data());
}

double norm(const RigidGrains& grains, const RowsOfTwo& a) {
    return std::sqrt(dot(grains, a, a.x, a.y));
}

/// a = keep a + share b
void combine(RowsOfTwo& a, double keep, double share, const RowsOfTwo& b) {
    for (std::size_t c = 0; c < a.x.size(); ++c) {
        a.x[c] = keep * a.x[c] + share * b.x[c];
        a.y[c] = keep * a.y[c] + share * b.y[c];
    }
}

}  // namespace

/// out = dt nu L u
void RigidViscosity::laplacian(BoxOperators& box, SidesHold sides, const CellVelocity& u,
                               RowsOfTwo& out) {
    out.resize(box.size());
    box.laplacian(per_laplacian_, 0, sides, u.x, out.x.data());
    box.laplacian(per_laplacian_, 1, sides, u.y, out.y.data());
}

void RigidViscosity::start_from(BoxOperators& box, const CellVelocity& velocity) {
    laplacian(box, SidesHold::velocity, velocity, impulse_);
}

IterationResult RigidViscosity::correct(BoxOperators& box, RigidGrains& grains,
                                        const IterationLimit& limit) {
    laplacian(box, SidesHold::velocity, grains.velocity(), residual_);
    const double scale = norm(grains, residual_);
    combine(residual_, 1.0, -1.0, impulse_);  // r = dt nu L u - f
    IterationResult result;
    double rz = 0.0;
    while (scale > 0.0) {
        rigid_residual_.x = residual_.x;
        rigid_residual_.y = residual_.y;
        grains.make_rigid(rigid_residual_, slip_reduction);  // z = W r
        const double rz_new = dot(grains, residual_, rigid_residual_.x, rigid_residual_.y);
        if (result.iterations == 0) {
            direction_ = residual_;
            rigid_direction_ = rigid_residual_;
        } else {
            combine(direction_, rz_new / rz, 1.0, residual_);
            grains.combine(rigid_direction_, rz_new / rz, rigid_residual_);
        }
        rz = rz_new;
        laplacian(box, SidesHold::nothing, rigid_direction_.velocity(), image_);
        combine(image_, -1.0, 1.0, direction_);  // A d = d - dt nu L W d
        const double curvature = dot(grains, image_, rigid_direction_.x, rigid_direction_.y);
        if (!(curvature > 0.0)) break;
        const double alpha = rz / curvature;
        combine(impulse_, 1.0, alpha, direction_);
        grains.add(rigid_direction_, alpha);
        combine(residual_, 1.0, -alpha, image_);
        ++result.iterations;
        result.residual = norm(grains, residual_) / scale;
        result.converged = result.residual <= limit.tolerance;
        if (result.converged || result.iterations >= limit.most) break;
    }
    return result;
}

}  // namespace turbidite
