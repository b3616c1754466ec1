// SPDX-License-Identifier: GPL-2.0-or-later
//
// What the steps on rows of a box work with: the fluid, its fluxes through faces, and the impulses
// of a window. Fluxes are face velocities: phi over |S|. Valid C++17.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "fluid_adapter/box_step/box_layers.hpp"
#include "fluid_adapter/box_step/row_reader.hpp"
#include "fluid_adapter/box_step/row_work.hpp"
#include "fluid_adapter/box_step/transport/flux_check.hpp"

namespace turbidite {

struct BoxFluid {
    SeparableOperator velocity, pressure;  ///< grid, and the boundary conditions of u and p
    double viscosity = 0.0;                ///< nu [m2/s]
    double limiter = 1.0;                  ///< k of limitedLinearV (not the k of step 1)
    /// Share of linear interpolation where transport is not limited (convective_flux.hpp).
    std::optional<double> central;
    bool second_order = false;  ///< in time (second_order.hpp)
};

/// Components of a velocity over a rank's cells, an array each: a kernel reads one at a time [m/s].
class VelocityRows {
 public:
    void resize(int components, std::size_t cells) {
        rows_.resize(components);
        for (std::vector<double>& row : rows_) row.resize(cells);
    }

    /// Room for as many rows, which keep their own.
    void have(int components) { rows_.resize(components); }

    /// For those of somebody who has no use for them; their size may be another.
    void swap(std::vector<std::vector<double>>& rows) { rows_.swap(rows); }

    int size() const { return static_cast<int>(rows_.size()); }
    std::vector<double>& operator[](int axis) { return rows_[axis]; }
    const std::vector<double>& operator[](int axis) const { return rows_[axis]; }
    VelocityPointers pointers() {
        VelocityPointers all(size());
        for (int axis = 0; axis < size(); ++axis) all[axis] = rows_[axis].data();
        return all;
    }

 private:
    std::vector<std::vector<double>> rows_;
};

/// One number per component; z is zero in the plane.
using BoxForce = std::array<double, 3>;

/// Impulses of viscosity and pressure, per mass, that a window begins with: f = dt nu L u and
/// -dt G p, with the p kept.
struct ImpulsesOfWindow {
    double dt = 0.0;     ///< [s]
    VelocityRows f;      ///< [m/s]
    BoxForce sum_f{};    ///< over this rank's cells, weighted by volumes
    double sum_u = 0.0;  ///< of all components with them, finite only if each value is [m/s]
};

/// phi1 where it is kept for transport, which otherwise recomputes it as S.u + e.
struct HeldFlux {
    FaceValues flux, last;               ///< this window's; the last one's, in second order
    bool held = false;                   ///< flux is that of this window
    std::optional<double> extrapolated;  ///< by how many windows, while it is found

    /// Makes room for the flux.
    void resize(const BoxLayers& layers) {
        flux.resize(layers.components());
        for (int axis = 0; axis < layers.components(); ++axis)
            flux[axis].resize(layers.faces(axis));
    }

    /// On the faces of layer j normal to an axis, as FaceValues; of y on those below it.
    double* layer(const BoxLayers& layers, int axis, int j) {
        return flux[axis].data() + layers.face_row(axis, j, 0);
    }

    /// When all faces of layer j have their flux.
    void show_layer(const BoxLayers& layers, int j, FluxCheck& check) {
        check.add_layer(j, layer(layers, 0, j), layer(layers, 1, j), layer(layers, 1, j + 1),
                        layers.in_space() ? layer(layers, 2, j) : nullptr);
    }

    /// Of faces of phi1, which begin at `first`.
    void hold_middle(int axis, std::size_t first, int count, const double* faces) {
        if (extrapolated)
            extrapolate(count, *extrapolated, faces, last[axis].data() + first,
                        flux[axis].data() + first);
    }
    /// The same; in first order phi1 itself is held.
    void hold(int axis, std::size_t first, int count, const double* faces) {
        if (extrapolated)
            hold_middle(axis, first, count, faces);
        else
            std::copy_n(faces, count, flux[axis].data() + first);
    }
};

/// flux = S.u + kept e on the faces below, behind or along row k of layer j, of the component u
/// normal to them; S: row_heights.hpp
inline void face_flux(const BoxLayers& layers, int axis, int j, int k, double kept, RowReader& u,
                      const FaceValues& excess, double* flux) {
    const double* e = excess[axis].data() + layers.face_row(axis, j, k);
    const double* low = axis == 1 ? u.row(j - 1, k) : axis == 2 ? u.row(j, k - 1) : u.row(j, k) - 1;
    const RowShares shares = axis == 1 ? layers.heights.volume_shares(j) : halves;
    mean_flux(static_cast<int>(layers.faces_of_row(axis)), shares, low, u.row(j, k), kept, e, flux);
}

}  // namespace turbidite
