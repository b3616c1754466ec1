// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/pressure_projection.hpp"

#include <algorithm>

#include "fluid_adapter/box_step/row_differences.hpp"

namespace turbidite {

PressureProjection::PressureProjection(const BoxLayers& layers, const SeparableOperator& grid,
                                       BoxRows& rows, std::vector<RowReader>& u, FaceValues& excess,
                                       HeldFlux& held)
    : layers_(layers),
      u_(u),
      p_(grid, rows),
      excess_(excess),
      held_(held),
      flux_x_(layers.face_row(0, 1, 0)),
      flux_below_(layers.layer()),
      flux_above_(layers.layer()),
      flux_z_(layers.in_space() ? layers.face_row(2, 1, 0) : 0),
      corrected_below_(layers.layer()),
      corrected_here_(layers.layer()),
      corrected_(3, PaddedLayer(layers.nx, layers.nz)),
      check_(layers),
      held_check_(layers) {}

FluxReport PressureProjection::project(SeparableSolve& pressure, const VelocityPointers& u,
                                       double dt, double k) {
    kept_ = k;
    begin(pressure, u, dt);
    // One layer beyond either end: e on the faces there needs v1 on both sides of them.
    for (int j = -1; j <= layers_.ny; ++j) correct_layer(j, dt, u);
    return report(dt);
}

FluxReport PressureProjection::hold_solenoidal_flux(SeparableSolve& pressure,
                                                    const VelocityPointers& u, double dt) {
    held_.resize(layers_);
    // Here all of e counts: the flux is to be the nearest to S.u + e.
    kept_ = 1.0;
    begin(pressure, u, dt);
    for (int j = 0; j <= layers_.ny; ++j) {
        hold(1, j, dt, flux_above_);
        if (j >= 1) check(j - 1);
        for (int axis = 0; j < layers_.ny && axis < layers_.components(); axis += 2)
            hold(axis, j, dt, axis == 0 ? flux_x_ : flux_z_);
        flux_below_.swap(flux_above_);
    }
    held_.held = true;
    return report(dt);
}

/// The flux of a layer, also into `faces`.
void PressureProjection::hold(int axis, int j, double dt, Values& faces) {
    projected(axis, j, dt, faces.data());
    const std::size_t first = layers_.face_row(axis, j, 0);
    held_.hold(axis, first, static_cast<int>(faces.size()), faces.data());
}

/// Layer j, of which flux_x_ to flux_z_ have all faces.
void PressureProjection::check(int j) {
    check_.add_layer(j, flux_x_.data(), flux_below_.data(), flux_above_.data(),
                     layers_.in_space() ? flux_z_.data() : nullptr);
    if (held_.extrapolated) held_.show_layer(layers_, j, held_check_);
}

FluxReport PressureProjection::report(double dt) const {
    FluxReport found = check_.over(dt);
    if (held_.extrapolated) found.carried_courant = held_check_.over(dt).courant;
    return found;
}

/// Solves for the p that makes S.u + k e solenoidal, and begins to read u and p.
void PressureProjection::begin(SeparableSolve& pressure, const VelocityPointers& u, double dt) {
    const auto begin_velocity = [&] {
        for (int axis = 0; axis < u.size(); ++axis) u_[axis].begin(u[axis]);
    };
    begin_velocity();
    // Layer 0 finds the faces below it, each other layer those above the one before.
    flux(1, 0, flux_below_.data());
    pressure.solve([&](int j) { right_hand_side(j, dt, pressure.values() + layers_.row(j, 0)); },
                   [](int) {});
    // From the first layer again: the solve has read u for the divergence.
    begin_velocity();
    p_.begin(pressure.values());
    check_.begin();
    held_check_.begin();
}

/// S.u + k e on the faces of layer j: below it, or of all its rows along x or z. On the sides of
/// the box k is 0: e is not carried over there.
void PressureProjection::flux(int axis, int j, double* faces) {
    const int rows = axis == 2 ? layers_.nz + 1 : layers_.nz;
    for (int k = 0; k < rows; ++k, faces += layers_.faces_of_row(axis)) {
        const bool side = axis == 1 ? layers_.side_below(j) : axis == 2 && layers_.side_behind(k);
        // With k = 0 a side has the mean with the image, which is the boundary value of u.
        face_flux(layers_, axis, j, k, side ? 0.0 : kept_, u_[axis], excess_, faces);
        if (axis != 0 || layers_.periodic_x) continue;
        const double* u = u_[0].row(j, k);
        faces[0] = 0.5 * (u[-1] + u[0]);
        faces[layers_.nx] = 0.5 * (u[layers_.nx - 1] + u[layers_.nx]);
    }
}

/// -div(S.u + k e)/dt of layer j.
void PressureProjection::right_hand_side(int j, double dt, double* out) {
    const int nx = layers_.nx;
    flux(0, j, flux_x_.data());
    flux(1, j + 1, flux_above_.data());
    if (layers_.in_space()) flux(2, j, flux_z_.data());
    for (int k = 0; k < layers_.nz; ++k, out += nx) {
        const double *along = flux_x_.data() + k * (nx + 1), *behind = flux_z_.data() + k * nx;
        divergence_row(nx, -1.0 / (layers_.hx * dt), along, along + 1,
                       -1.0 / (layers_.heights.size(j) * dt), flux_below_.data() + k * nx,
                       flux_above_.data() + k * nx, out);
        if (layers_.in_space())
            subtract_difference(nx, 1.0 / (layers_.hz * dt), behind, behind + nx, out);
    }
    flux_below_.swap(flux_above_);
}

/// S.u + k e - dt S.grad p on the faces of layer j, as `flux`.
void PressureProjection::projected(int axis, int j, double dt, double* faces) {
    if (axis == 1) {
        for (int k = 0; k < layers_.nz; ++k, faces += layers_.nx) {
            const double* e = excess_[1].data() + layers_.face_row(1, j, k);
            const double* low = u_[1].row(j - 1, k);
            const double* p_low = p_.row(j - 1, k);
            projected_flux(layers_.nx, layers_.heights.volume_shares(j), low, u_[1].row(j, k),
                           layers_.side_below(j) ? 0.0 : kept_, e, dt / layers_.heights.distance(j),
                           p_low, p_.row(j, k), faces);
        }
        return;
    }
    flux(axis, j, faces);
    const int count = static_cast<int>(layers_.faces_of_row(axis));
    const int rows = axis == 2 ? layers_.nz + 1 : layers_.nz;
    for (int k = 0; k < rows; ++k, faces += count) {
        const double* p = p_.row(j, k);
        correct(count, dt / (axis == 0 ? layers_.hx : layers_.hz),
                axis == 0 ? p - 1 : p_.row(j, k - 1), p, faces, faces);
    }
}

/// u1 of layer j, and phi1 and e on the faces below it and of its rows; layer j - 1 then has all
/// its fluxes and is checked.
void PressureProjection::correct_layer(int j, double dt, const VelocityPointers& u) {
    const int nx = layers_.nx, nz = layers_.nz;
    correct_across(j, dt);
    // Before correct_within, which overwrites the fluxes of layer j - 1 along x and z.
    if (j >= 1) check(j - 1);
    if (j >= 0 && j < layers_.ny) {
        for (int axis = 0; axis < u.size(); axis += 2) correct_within(axis, j, dt);
        for (int k = 0; k < nz; ++k) {
            for (int axis = 0; axis < u.size(); axis += 2)
                std::copy_n(corrected_[axis].row(k), nx, u[axis] + layers_.row(j, k));
            std::copy_n(corrected_here_.data() + k * nx, nx, u[1] + layers_.row(j, k));
        }
    }
    flux_below_.swap(flux_above_);
    corrected_below_.swap(corrected_here_);
}

/// v1 of layer j, and phi1 and e on the faces below it.
void PressureProjection::correct_across(int j, double dt) {
    const int nx = layers_.nx;
    for (int k = 0; k < layers_.nz; ++k)  // v1 = v - dt dp/dy
        RowDifferences{layers_}.correct(1, j, k, dt, p_, u_[1].row(j, k),
                                        corrected_here_.data() + k * nx);
    if (j < 0) return;
    // phi1 = S.v + k e - dt dp/dy,   e = phi1 - S.v1
    projected(1, j, dt, flux_above_.data());
    for (int k = 0; k < layers_.nz; ++k) {
        const std::size_t first = layers_.face_row(1, j, k);
        const double* flux = flux_above_.data() + k * nx;
        excess_of(nx, layers_.heights.volume_shares(j), flux, corrected_below_.data() + k * nx,
                  corrected_here_.data() + k * nx, excess_[1].data() + first);
        held_.hold_middle(1, first, nx, flux);
    }
}

/// The component of u1 along x or z, and phi1 and e on the faces normal to it, of layer j.
void PressureProjection::correct_within(int axis, int j, double dt) {
    PaddedLayer& corrected = corrected_[axis];
    double* faces = axis == 0 ? flux_x_.data() : flux_z_.data();
    for (int k = 0; k < layers_.nz; ++k) {  // u1 = u - dt dp/dx
        RowDifferences{layers_}.correct(axis, j, k, dt, p_, u_[axis].row(j, k), corrected.row(k));
        if (axis == 0) u_[0].extend(corrected.row(k), j, k);
    }
    if (axis == 2) u_[2].extend(corrected, j);
    // phi1 = S.u + k e - dt dp/dx,   e = phi1 - S.u1
    projected(axis, j, dt, faces);
    const int count = static_cast<int>(layers_.faces_of_row(axis));
    const int rows = axis == 2 ? layers_.nz + 1 : layers_.nz;
    for (int k = 0; k < rows; ++k, faces += count) {
        const std::size_t first = layers_.face_row(axis, j, k);
        const double* low = axis == 0 ? corrected.row(k) - 1 : corrected.row(k - 1);
        excess_of(count, halves, faces, low, corrected.row(k), excess_[axis].data() + first);
        held_.hold_middle(axis, first, count, faces);
    }
}

}  // namespace turbidite
