// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_pressure.hpp"

#include <algorithm>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {

void RigidPressure::begin(Constraint& constraint, double dt, double k) {
    dt_ = dt;
    work_.images.have(step_.layers().components());
    residual().resize(step_.cells());
    // 0 in covered cells: faces between two carry the rigid motion alone, and in wedges a film
    w_.assign(step_.cells(), k);
    constraint.clear_covered(w_.data());
    film_.begin(constraint.film_sides(), step_.layers(), step_.excess_pointers(), step_.viscosity(),
                step_.cell_area(), dt);
}

IterationResult RigidPressure::correct(BoxOperators& box, RigidGrains& grains,
                                       const IterationLimit& limit) {
    const ResidualSquare square = find_residual(box, grains);
    // rms of r = sqrt(|r|^2/volume). A single iteration needs no image: nothing reads r after it.
    return iterate(
        limit, square.sum, square.cells,
        [&](bool first, double& rz) { choose_direction(box, grains, first, rz, limit); },
        [&] { return apply(box, grains, limit.most > 1); },
        [&](double alpha) { move(grains, alpha, limit.most > 1); });
}

/// r = -(D u + div e); returns |r|^2.
ResidualSquare RigidPressure::find_residual(BoxOperators& box, RigidGrains& grains) {
    const PendingChange change = grains.take_pending();  // made as the velocity is read
    ResidualSquare square;
    square.sum = box.flux_residual(dt_, step_.pressure(), grains.velocity(), excess(), change,
                                   residual().data());
    square.cells = box.volume();
    grains.sum_over_ranks(square.data(), ResidualSquare::count);
    return square;
}

/// z = -(1/dt) laplacian^-1 r, left in the solver; returns r.z.
double RigidPressure::precondition(const RigidGrains& grains) {
    double* z = step_.pressure_solve().values();
    const BoxLayers& layers = step_.layers();
    const std::vector<double>& r = residual();
    double product = 0.0;
    step_.pressure_solve().solve(
        [&](int j) {
            // The solver inverts -laplacian, so z of r/dt is -(1/dt) laplacian^-1 r.
            for (std::size_t c = layers.row(j, 0); c < layers.row(j + 1, 0); ++c) z[c] = r[c] / dt_;
        },
        [&](int j) {
            for (int k = 0; k < layers.nz; ++k)
                // Weighted by volumes, as all products (box_operators.hpp)
                product += layers.heights.relative(j) *
                           dot_row(layers.nx, r.data() + layers.row(j, k), z + layers.row(j, k));
        });
    grains.sum_over_ranks(&product, 1);
    return product;
}

/// d = z + beta d, and W(-dt G d).
void RigidPressure::choose_direction(BoxOperators& box, RigidGrains& grains, bool first, double& rz,
                                     const IterationLimit& limit) {
    // Viscosity may have left another array in its place.
    rigid().u.resize(step_.layers().components(), step_.cells());
    const double last = rz;
    // beta = r.z/(r.z of the last iteration)
    rz = precondition(grains);
    const double* z = step_.pressure_solve().values();
    if (limit.most > 1) {
        later().resize(step_.cells());
        box.direction(dt_, z, first ? 0.0 : rz / last, later().data(), rigid().u.pointers());
        // A copy, since the next preconditioning overwrites z.
        direction_ = later().data();
    } else {
        box.gradient(dt_, z, rigid().u.pointers());
        direction_ = z;
    }
    // Anew for each direction; carrying W(-dt G d) along as W(-dt G z) + beta W(-dt G d) would need
    // an array more per component.
    grains.make_rigid(rigid(), limit.slip_reduction);
}

/// A d, kept if there may be another iteration.
ImageProducts RigidPressure::apply(BoxOperators& box, const RigidGrains& grains, bool keep) {
    if (keep) image_.resize(residual().size());
    ImageProducts products = box.flux_image(dt_, excess(), direction_, rigid().u.pointers(),
                                            residual().data(), keep ? image_.data() : nullptr);
    grains.sum_over_ranks(products.data(), ImageProducts::count);
    return products;
}

/// p += alpha d, u += alpha W(-dt G d), r -= alpha A d.
void RigidPressure::move(RigidGrains& grains, double alpha, bool again) {
    double* p = step_.pressure();
    std::vector<double>& r = residual();
    // u changes by what is rigid, so every iterate is rigid and keeps the momentum.
    for (std::size_t c = 0; c < r.size(); ++c) p[c] += alpha * direction_[c];
    grains.add(rigid(), alpha);
    for (std::size_t c = 0; again && c < r.size(); ++c) r[c] -= alpha * image_[c];
}

}  // namespace turbidite
