// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/box_step.hpp"

#include <algorithm>
#include <utility>

namespace turbidite {
namespace {

FaceValues values_on_faces(const BoxLayers& layers) {
    FaceValues values(layers.components());
    for (int axis = 0; axis < layers.components(); ++axis)
        values[axis].assign(layers.faces(axis), 0.0);
    return values;
}

VelocityOnSides at_rest(const BoxLayers& layers) {
    VelocityOnSides sides;
    // Of the sides normal to x, y and z (side_values.hpp); in the plane there are none normal to z.
    const std::size_t sizes[] = {
        static_cast<std::size_t>(layers.ny) * layers.nz, layers.layer(),
        layers.in_space() ? static_cast<std::size_t>(layers.nx) * layers.ny : 0};
    for (SideValues& values : sides)
        for (int side = 0; side < 6; ++side) values[side].assign(sizes[side / 2], 0.0);
    return sides;
}

}  // namespace

BoxStep::BoxStep(const BoxFluid& fluid)
    : BoxStep(fluid, std::make_unique<AllRows>(fluid.pressure)) {}

BoxStep::BoxStep(const BoxFluid& fluid, std::unique_ptr<BoxRows> rows)
    : fluid_(fluid),
      rows_(std::move(rows)),
      layers_(fluid.pressure, *rows_),
      pressure_(fluid.pressure, rows_->pencils()),
      excess_(values_on_faces(layers_)),
      side_velocity_(at_rest(layers_)),
      p_(fluid.pressure, *rows_),
      projection_(layers_, fluid.pressure, *rows_, u_, excess_, held_),
      transport_(fluid_, layers_, u_, excess_, held_),
      forces_(fluid_, layers_, side_velocity_) {
    // -laplacian, whatever dt is: factorised once. That of viscosity waits for the first dt.
    pressure_.factorise({0.0, 1.0});
    for (int axis = 0; axis < layers_.components(); ++axis) {
        viscous_.emplace_back(fluid.velocity, rows_->pencils());
        // Readers know what sides prescribe; the solves take it to be zero (add_side_velocity).
        u_.emplace_back(fluid.velocity, *rows_, &side_velocity_[axis]);
    }
    // phi1 of the last window; 0 counts for nothing where a run begins.
    if (fluid.second_order) held_.last = values_on_faces(layers_);
}

VelocityPointers BoxStep::velocity() {
    VelocityPointers u(layers_.components());
    for (int axis = 0; axis < u.size(); ++axis) u[axis] = velocity(axis);
    return u;
}

VelocityPointers BoxStep::excess_pointers() {
    VelocityPointers e(layers_.components());
    for (int axis = 0; axis < e.size(); ++axis) e[axis] = excess_[axis].data();
    return e;
}

VelocityStage::Values BoxStep::values_of_velocity() {
    const VelocityPointers u = velocity();
    return {u.begin(), u.end()};
}

void BoxStep::begin_velocity(const VelocityStage::Values& u) {
    for (std::size_t axis = 0; axis < u.size(); ++axis) u_[axis].begin(u[axis]);
}

FluxReport BoxStep::project(double dt) {
    return projection_.project(pressure_, velocity(), dt, kept_excess(dt));
}

FluxReport BoxStep::hold_solenoidal_flux(double dt) {
    return projection_.hold_solenoidal_flux(pressure_, velocity(), dt);
}

void BoxStep::transport(double dt, ImpulsesOfWindow* impulses) {
    begin_velocity(values_of_velocity());
    // Of u1, which the readers still have where transport has overwritten a layer.
    if (impulses) begin_impulses(*impulses);
    transport_.begin(false);
    for (int j = 0; j < layers_.ny; ++j) {
        transport_.advance(j, dt, velocity());
        if (impulses) add_impulses(j, *impulses);
    }
}

/// Layers are read before they are written, so u may be the result.
BoxStep::Force BoxStep::play(const VelocityStage& stage) {
    // Before the pass, since the result may be u itself.
    Force force = convective_force(stage.u);
    if (stage.viscous) {
        const Force viscous = forces_.viscous(stage.u);
        for (int axis = 0; axis < 3; ++axis) force[axis] += viscous[axis];
    }
    begin_velocity(stage.u);
    transport_.begin(stage.viscous);
    for (int j = 0; j < layers_.ny; ++j) transport_.play(j, stage);
    return force;
}

void BoxStep::add_impulses(const VelocityStage::Values& u2, ImpulsesOfWindow& impulses) {
    begin_impulses(impulses);
    begin_velocity(values_of_velocity());
    for (int j = 0; j < layers_.ny; ++j) {
        for (std::size_t axis = 0; axis < u2.size(); ++axis) {
            u_[axis].row(j + 1);  // before layer j is written
            std::copy_n(u2[axis] + layers_.row(j, 0), layers_.layer(),
                        velocity(static_cast<int>(axis)) + layers_.row(j, 0));
        }
        add_impulses(j, impulses);
    }
}

void BoxStep::begin_impulses(ImpulsesOfWindow& impulses) {
    impulses.f.resize(layers_.components(), cells());
    impulses.sum_f = {};
    impulses.sum_u = 0.0;
    // Of the last window: p^n is in the step's own array.
    p_.begin(pressure());
}

/// Of layer j, after its transport; u_ still reads u1.
void BoxStep::add_impulses(int j, ImpulsesOfWindow& impulses) {
    const double dt = impulses.dt;
    const RowDifferences differences{layers_};
    for (int k = 0; k < layers_.nz; ++k)
        for (int axis = 0; axis < layers_.components(); ++axis) {
            double* f = impulses.f[axis].data() + layers_.row(j, k);
            double* u = velocity(axis) + layers_.row(j, k);
            // f = dt nu L u1, then u2 + f - dt G p
            differences.laplacian(j, k, fluid_.viscosity * dt, u_[axis], f);
            impulses.sum_f[axis] += layers_.heights.relative(j) * sum_row(layers_.nx, f);
            add_row(layers_.nx, 1.0, f, u);
            differences.correct(axis, j, k, dt, p_, u, u);
            impulses.sum_u += sum_row(layers_.nx, u);
        }
}

double BoxStep::fastest_decay(double dt) const {
    const double hx = layers_.hx, hy = fluid_.pressure.y.spacing, hz = layers_.hz;
    const double across = layers_.in_space() ? 1.0 / (hz * hz) : 0.0;
    return 4.0 * fluid_.viscosity * dt * (1.0 / (hx * hx) + 1.0 / (hy * hy) + across);
}

void BoxStep::hold_flux() {
    held_.resize(layers_);
    begin_velocity(values_of_velocity());
    for (int axis = 0; axis < layers_.components(); ++axis)
        for (int j = 0; j < layers_.ny + (axis == 1); ++j)
            for (int k = 0; k < layers_.nz + (axis == 2); ++k)  // phi1 = S.u1 + e
                face_flux(layers_, axis, j, k, 1.0, u_[axis], excess_,
                          held_.flux[axis].data() + layers_.face_row(axis, j, k));
    held_.held = true;
}

/// What finds phi1 passes each row of it to the flux that is held while it has it in cache.
template <class Find>
FluxReport BoxStep::with_middle(bool begins, const Find& find) {
    held_.resize(layers_);
    held_.extrapolated = begins ? 0.0 : 0.5;  // windows
    const FluxReport report = find();
    held_.extrapolated.reset();
    held_.held = true;
    return report;
}

FluxReport BoxStep::project_and_hold_middle(double dt, bool begins) {
    return with_middle(begins, [&] { return project(dt); });
}

FluxReport BoxStep::hold_solenoidal_middle(double dt, bool begins) {
    return with_middle(begins, [&] { return hold_solenoidal_flux(dt); });
}

void BoxStep::diffuse(double dt, const SeparableSolve::LayerWork& take) {
    // (1 - dt nu laplacian) u3 = u2
    if (factorised_for_ != dt)
        for (SeparableSolve& solve : viscous_) solve.factorise({1.0, fluid_.viscosity * dt});
    factorised_for_ = dt;
    add_side_velocity(dt);
    // The last component hands over its layers: a layer is complete when that is.
    for (std::size_t axis = 0; axis + 1 < viscous_.size(); ++axis) viscous_[axis].solve();
    viscous_.back().solve([](int) {}, take);
}

/// What a prescribed u_b contributes to the right-hand side of step 3: dt nu 2 u_b/h2, since the
/// solve itself takes the image beyond the side to be -u.
void BoxStep::add_side_velocity(double dt) {
    const BoxLayers& l = layers_;
    const auto across = [&](double h) { return 2.0 * fluid_.viscosity * dt / (h * h); };
    // The side is half a cell from the centre, in rows of any height: the flux nu (u_b - u)/(h/2),
    // over h, is nu 2 (u_b - u)/h2.
    const double across_x = across(l.hx), across_z = across(l.hz);
    const double at_bottom = across(l.heights.size(0)), at_top = across(l.heights.size(l.ny - 1));
    for (int axis = 0; axis < l.components(); ++axis) {
        const SideValues& held = side_velocity_[axis];
        for (int row = 0; row < l.ny * l.nz; ++row) {
            double* u = velocity(axis) + static_cast<std::size_t>(row) * l.nx;
            u[0] += across_x * held[0][row];
            u[l.nx - 1] += across_x * held[1][row];
        }
        double *bottom = velocity(axis), *top = velocity(axis) + l.row(l.ny - 1, 0);
        for (std::size_t i = 0; i < l.layer(); ++i) {
            if (!l.open_below) bottom[i] += at_bottom * held[2][i];
            if (!l.open_above) top[i] += at_top * held[3][i];
        }
        for (int j = 0; l.in_space() && j < l.ny; ++j)
            for (int side = 4; side < 6; ++side)
                add_row(l.nx, across_z, held[side].data() + static_cast<std::size_t>(j) * l.nx,
                        velocity(axis) + l.row(j, side == 4 ? 0 : l.nz - 1));
    }
}

BoxStep::Force BoxStep::pressure_force() {
    return forces_.pressure(pressure());
}

BoxStep::Force BoxStep::convective_force() {
    return convective_force(values_of_velocity());
}

BoxStep::Force BoxStep::convective_force(const VelocityStage::Values& u) {
    // Without a held flux only e is there: on a side phi1 is the boundary value of u plus e.
    return forces_.convective(u, held_.held ? held_.flux : excess_, !held_.held);
}

BoxStep::Force BoxStep::viscous_force() {
    return forces_.viscous(values_of_velocity());
}

}  // namespace turbidite
