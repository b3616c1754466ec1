// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace turbidite {
namespace {

constexpr double slip_reduction = 1e-2;  // of a direction's slip; what is left is part of the flow's

/// a = keep a + share b
void combine(std::vector<double>& a, double keep, double share, const std::vector<double>& b) {
    for (std::size_t c = 0; c < a.size(); ++c) a[c] = keep * a[c] + share * b[c];
}

double dot(const RigidGrains& grains, const std::vector<double>& a, const std::vector<double>& b) {
    return grains.dot(a.data(), b.data());
}

}  // namespace

void RigidPressure::begin(BoxOperators& box, double dt) {
    dt_ = dt;
    p_.assign(step_.pressure(), step_.pressure() + box.size());
}

void RigidPressure::subtract_gradient(BoxOperators& box, double* x, double* y) const {
    box.subtract_gradient(dt_, p_.data(), x, y);
}

void RigidPressure::place_grains(BoxOperators& box, const CollocationPoints& points, double k) {
    outside_.assign(box.size(), 1.0);
    for (const InteriorCell& inside : points.interior) outside_[inside.cell] = 0.0;
    box.keep_excess(k, outside_.data(), step_.excess(0).data(), step_.excess(1).data());
}

/// r = -(D u + div e), with the present p's part of e.
void RigidPressure::divergence(BoxOperators& box, const RigidGrains& grains) {
    residual_.resize(box.size());
    box.divergence(-1.0, SidesHold::velocity, grains.velocity().x, grains.velocity().y, residual_.data());
    box.add_divergence_of_excess(-1.0, step_.excess(0).data(), step_.excess(1).data(),
                                 residual_.data());
    box.add_smoothing(-dt_, outside_.data(), p_.data(), residual_.data());
}

/// z = -(1/dt) laplacian^-1 r
void RigidPressure::precondition() {
    double* values = step_.pressure_solve().values();
    for (std::size_t c = 0; c < residual_.size(); ++c) values[c] = residual_[c] / dt_;
    step_.pressure_solve().solve();
    preconditioned_.assign(values, values + residual_.size());
}

/// image = A d, with W(-dt G d) known.
void RigidPressure::apply(BoxOperators& box) {
    image_.resize(box.size());
    box.divergence(1.0, SidesHold::nothing, rigid_direction_.x.data(), rigid_direction_.y.data(), image_.data());
    box.add_smoothing(dt_, outside_.data(), direction_.data(), image_.data());
}

/// rms of the residual over the cells of all ranks [1/s].
double RigidPressure::rms(const RigidGrains& grains) const {
    return std::sqrt(dot(grains, residual_, residual_) / grains.all_cells());
}

IterationResult RigidPressure::correct(BoxOperators& box, RigidGrains& grains,
                                       const IterationLimit& limit) {
    divergence(box, grains);
    IterationResult result;
    result.residual = rms(grains);
    double rz = 0.0;
    while (result.residual > limit.tolerance && result.iterations < limit.most) {
        precondition();
        const double rz_new = dot(grains, residual_, preconditioned_);
        rigid_.x.assign(box.size(), 0.0);
        rigid_.y.assign(box.size(), 0.0);
        box.subtract_gradient(dt_, preconditioned_.data(), rigid_.x.data(), rigid_.y.data());
        grains.make_rigid(rigid_, slip_reduction);  // W(-dt G z)
        if (result.iterations == 0) {
            direction_ = preconditioned_;
            rigid_direction_ = rigid_;
        } else {
            combine(direction_, rz_new / rz, 1.0, preconditioned_);
            grains.combine(rigid_direction_, rz_new / rz, rigid_);
        }
        rz = rz_new;
        apply(box);
        const double curvature = dot(grains, direction_, image_);
        if (!(curvature > 0.0)) break;
        const double alpha = rz / curvature;
        combine(p_, 1.0, alpha, direction_);
        grains.add(rigid_direction_, alpha);
        combine(residual_, 1.0, -alpha, image_);
        ++result.iterations;
        result.residual = rms(grains);
    }
    result.converged = result.residual <= limit.tolerance;
    if (std::getenv("TURBIDITE_DUMP")) {
        std::FILE* f = std::fopen("/root/sp/dump.bin", "wb");
        for (auto* v : {&residual_, &outside_, &p_}) std::fwrite(v->data(), 8, v->size(), f);
        std::fwrite(grains.velocity().x, 8, p_.size(), f);
        std::fwrite(grains.velocity().y, 8, p_.size(), f);
        std::fclose(f);
    }
    return result;
}

void RigidPressure::end(BoxOperators& box) {
    box.add_to_excess(dt_, outside_.data(), p_.data(), step_.excess(0).data(),
                      step_.excess(1).data());
    std::copy(p_.begin(), p_.end(), step_.pressure());
}

}  // namespace turbidite
