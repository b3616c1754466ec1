// SPDX-License-Identifier: GPL-2.0-or-later
#include "fluid_adapter/box_step/wedge_flow.hpp"

#include <tuple>

namespace turbidite {
namespace {

constexpr double thickness = 0.5;  // delta/h

}  // namespace

void WedgeFlow::begin(const std::vector<CellSide>& sides, const BoxLayers& layers,
                      const VelocityPointers& e, double viscosity, double cell_area,
                      const std::array<double, 3>& a, double dt) {
    layers_ = &layers;
    // k = 1/(1 + 12 nu dt/delta^2)
    const double k = 1.0 / (1.0 + 12.0 * viscosity * dt / (thickness * thickness * cell_area));
    driven_ = k * thickness;
    faces_.resize(layers.ny);
    for (std::vector<Face>& faces : faces_) faces.clear();
    for (const CellSide& of : sides) {
        const int i = of.cell % layers.nx, row = of.cell / layers.nx;
        const int j = row / layers.nz, depth = row % layers.nz;
        // The face beyond is that of the next cell, row or layer (box_layers.hpp).
        const int next = of.side > 0 ? 1 : 0;
        const std::size_t place = layers.face_row(of.axis, j + (of.axis == 1 ? next : 0),
                                                  depth + (of.axis == 2 ? next : 0)) +
                                  i + (of.axis == 0 ? next : 0);
        const double driven = of.held ? driven_ * dt * a[of.axis] : 0.0;
        faces_[j].push_back(
            {i, depth, static_cast<int>(place), of.axis, of.side, k * e[of.axis][place] + driven});
    }
}

/// Of the cells of layer j along an axis [m].
double WedgeFlow::width(int axis, int j) const {
    return axis == 0 ? layers_->hx : axis == 1 ? layers_->heights.size(j) : layers_->hz;
}

/// dp/dn, away from the cell.
double WedgeFlow::slope(const Face& face, int j, RowReader& p) const {
    const auto [i, k, axis, side] = std::tie(face.i, face.k, face.axis, face.side);
    const double here = p.row(j, k)[i];
    if (axis == 0) return (p.row(j, k)[i + side] - here) / layers_->hx;
    if (axis == 2) return (p.row(j, k + side)[i] - here) / layers_->hz;
    return (p.row(j + side, k)[i] - here) / layers_->heights.distance(side > 0 ? j + 1 : j);
}

void WedgeFlow::add_kept(int j, double share, double* out) const {
    for (const Face& face : faces_[j])
        out[face.i + layers_->nx * face.k] += share * face.side * face.kept / width(face.axis, j);
}

void WedgeFlow::add_driven(int j, double step, RowReader& p, double* out) const {
    for (const Face& face : faces_[j])
        out[face.i + layers_->nx * face.k] -=
            driven_ * step * slope(face, j, p) / width(face.axis, j);
}

void WedgeFlow::update(int j, double step, RowReader& p, const VelocityPointers& e) const {
    // Both cells of a face write the same, since `kept` is of the last window.
    for (const Face& face : faces_[j])
        e[face.axis][face.place] = face.kept - driven_ * step * face.side * slope(face, j, p);
}

}  // namespace turbidite
