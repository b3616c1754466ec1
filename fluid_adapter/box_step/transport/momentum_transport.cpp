// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/transport/momentum_transport.hpp"

#include <algorithm>

namespace turbidite {

MomentumTransport::MomentumTransport(const BoxFluid& fluid, const BoxLayers& layers,
                                     std::vector<RowReader>& u, const FaceValues& excess,
                                     const HeldFlux& held)
    : fluid_(fluid),
      layers_(layers),
      u_(u),
      excess_(excess),
      held_(held),
      flux_(layers.nx + 1),
      result_(layers.nx),
      along_(room(layers.nx + 1)),
      below_(room(layers.layer())),
      above_(room(layers.layer())),
      behind_(room(layers.in_space() ? layers.nx : 0)),
      before_(behind_) {}

/// Momentum carried through the faces of row k of layer j normal to an axis, those below and behind
/// it; by the scheme of the case inside the box, with the boundary value on its sides.
void MomentumTransport::carry(int axis, int j, int k, Carried& carried, std::size_t first) {
    const int count = static_cast<int>(layers_.faces_of_row(axis)),
              components = layers_.components();
    VelocityAcross u(components);
    CarriedRows to(components);
    for (int c = 0; c < components; ++c) {
        RowReader& rows = u_[c];
        // Cells -2, -1 are on the low side of the faces, 0 and 1 on the high side.
        const auto at = [&](int n) {
            return axis == 0   ? rows.row(j, k) + n
                   : axis == 1 ? rows.row(j + n, k)
                               : rows.row(j, k + n);
        };
        u[c] = {at(-2), at(-1), at(0), at(1)};
        to[c] = carried[c].data() + first;
    }
    const double* flux = flux_.data();
    if (held_.held)
        flux = held_.flux[axis].data() + layers_.face_row(axis, j, k);
    else
        face_flux(layers_, axis, j, k, 1.0, u_[axis], excess_, flux_.data());
    const FacePlace place = axis == 1 ? layers_.heights.face(j) : FacePlace{};
    if (fluid_.central)
        blended_flux(count, *fluid_.central, place, flux, u, to);
    else
        convective_flux(count, 2.0 / fluid_.limiter, place, flux, u, to);
    // On a side of the box nothing is interpolated: the mean with the image is the boundary value.
    const auto at_side = [&](int i) {
        for (int c = 0; c < components; ++c)
            to[c][i] = 0.5 * flux[i] * (u[c].low[i] + u[c].high[i]);
    };
    if (axis == 0 && !layers_.periodic_x) at_side(0), at_side(layers_.nx);
    if ((axis == 1 && layers_.side_below(j)) || (axis == 2 && layers_.side_behind(k)))
        for (int i = 0; i < count; ++i) at_side(i);
}

/// Adds the flux of momentum by viscosity, -nu du/dx, through the same faces.
void MomentumTransport::diffuse(int axis, int j, int k, Carried& carried, std::size_t first) {
    const double distance = axis == 0   ? layers_.hx
                            : axis == 1 ? layers_.heights.distance(j)
                                        : layers_.hz;
    const int count = static_cast<int>(layers_.faces_of_row(axis));
    for (int c = 0; c < layers_.components(); ++c) {
        const double* high = u_[c].row(j, k);
        const double* low = axis == 0   ? high - 1
                            : axis == 1 ? u_[c].row(j - 1, k)
                                        : u_[c].row(j, k - 1);
        // carried -= nu (high - low)/d; on a side d = h, the distance of the image.
        subtract_difference(count, fluid_.viscosity / distance, low, high,
                            carried[c].data() + first);
    }
}

/// Through the faces below layer j, into above_.
void MomentumTransport::carry_below(int j) {
    for (int k = 0; k < layers_.nz; ++k) {
        const std::size_t first = static_cast<std::size_t>(k) * layers_.nx;
        carry(1, j, k, above_, first);
        if (viscous_) diffuse(1, j, k, above_, first);
    }
}

/// Through the faces of row k of layer j along x, and in space in front of it.
void MomentumTransport::carry_row(int j, int k) {
    carry(0, j, k, along_, 0);
    if (viscous_) diffuse(0, j, k, along_, 0);
    // Row 0 carries the faces behind it as well; later rows have them from the row before.
    for (int face = k == 0 ? 0 : k + 1; layers_.in_space() && face <= k + 1; ++face) {
        behind_.swap(before_);
        carry(2, j, face, before_, 0);
        if (viscous_) diffuse(2, j, face, before_, 0);
    }
}

void MomentumTransport::begin(bool viscous) {
    viscous_ = viscous;
    carry_below(0);
}

void MomentumTransport::advance(int j, double dt, const VelocityPointers& u) {
    // What was above layer j - 1 is below layer j. Layers up to j + 2 are read by now, so that the
    // caller may overwrite layer j.
    below_.swap(above_);
    carry_below(j + 1);
    const int nx = layers_.nx;
    for (int k = 0; k < layers_.nz; ++k) {
        carry_row(j, k);
        for (int c = 0; c < u.size(); ++c) {
            const double *across = along_[c].data(), *below = below_[c].data() + k * nx;
            double* out = u[c] + layers_.row(j, k);
            // u2 = u1 - dt ((F_right - F_left)/hx + (F_above - F_below)/h_j), and the same along z
            advance_row(nx, u_[c].row(j, k), -dt / layers_.hx, across, across + 1,
                        -dt / layers_.heights.size(j), below, above_[c].data() + k * nx, out);
            if (layers_.in_space())
                subtract_difference(nx, dt / layers_.hz, behind_[c].data(), before_[c].data(), out);
        }
    }
}

void MomentumTransport::play(int j, const VelocityStage& stage) {
    below_.swap(above_);
    carry_below(j + 1);
    const int nx = layers_.nx;
    for (int k = 0; k < layers_.nz; ++k) {
        carry_row(j, k);
        const std::size_t first = layers_.row(j, k);
        for (int c = 0; c < layers_.components(); ++c) {
            const double *across = along_[c].data(), *below = below_[c].data() + k * nx;
            const StageRows rows{stage.old,          stage.fresh,          stage.rate,
                                 stage.v[c] + first, stage.now[c] + first, stage.before[c] + first};
            // velocity_stage.hpp has the formula. In space the part of z is subtracted from the
            // result, with the share `fresh` of dt L(u).
            stage_row(nx, rows, u_[c].row(j, k), -stage.dt / layers_.hx, across, across + 1,
                      -stage.dt / layers_.heights.size(j), below, above_[c].data() + k * nx,
                      result_.data());
            if (layers_.in_space())
                subtract_difference(nx, stage.fresh * stage.dt / layers_.hz, behind_[c].data(),
                                    before_[c].data(), result_.data());
            // By way of a row of its own, since the result may be one of the inputs.
            std::copy(result_.begin(), result_.end(), stage.result[c] + first);
            if (!stage.copy.empty())
                std::copy(result_.begin(), result_.end(), stage.copy[c] + first);
        }
    }
}

}  // namespace turbidite
