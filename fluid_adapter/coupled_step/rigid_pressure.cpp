// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/coupled_step/rigid_pressure.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "fluid_adapter/box_step/row_work.hpp"

namespace turbidite {
namespace {

// Of r dt, the part of its volume that a cell would gain in a window.
constexpr double rounding = 1e-12;

}  // namespace

void RigidPressure::begin(Constraint& constraint, double dt, double k,
                          const std::array<double, 3>& a) {
    dt_ = dt;
    work_.images.have(step_.layers().components());
    residual().resize(step_.cells());
    // 0 in covered cells: faces between two carry the rigid motion alone, and in wedges a film
    w_.assign(step_.cells(), k);
    constraint.clear_covered(w_.data());
    // Found anew at each call
    const std::vector<CellSide>& films = constraint.film_sides();
    film_.begin(films, step_.layers(), step_.excess_pointers(), step_.viscosity(),
                step_.cell_area(), a, dt);
    find_enclosed(constraint, films);
}

/// Cells of which W G d and e are zero for any d.
void RigidPressure::find_enclosed(const Constraint& constraint,
                                  const std::vector<CellSide>& films) {
    enclosed_.clear();
    double ranks = constraint.has_driven() ? 1.0 : 0.0;
    constraint.sum_over_ranks(&ranks, 1);
    has_driven_ = ranks > 0.0;
    if (!has_driven_) return;
    std::vector<double>& marks = residual();  // not in use yet
    std::fill(marks.begin(), marks.end(), 0.0);
    constraint.mark_driven(marks.data());
    enclosed_ = step_.operators().enclosed(marks.data());
    // A film passes into a cell and out of it.
    std::set<int> shut(enclosed_.begin(), enclosed_.end());
    for (const CellSide& side : films) shut.erase(side.cell);
    enclosed_.assign(shut.begin(), shut.end());
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
    if (has_driven_) leave_out_enclosed(box, grains, square);
    return square;
}

/// In a box without a free side the other cells take what is left out, since r must sum to zero.
void RigidPressure::leave_out_enclosed(BoxOperators& box, const RigidGrains& grains,
                                       ResidualSquare& square) {
    std::vector<double>& r = residual();
    const BoxLayers& layers = step_.layers();
    const auto volume = [&](int cell) {
        return layers.heights.relative(cell / static_cast<int>(layers.layer()));
    };
    double sums[] = {0.0, 0.0, 0.0};  // cells that matter; r and volume of the enclosed
    for (const int cell : enclosed_) {
        sums[0] += std::abs(r[cell]) * dt_ > rounding ? 1.0 : 0.0;
        sums[1] += volume(cell) * r[cell];
        sums[2] += volume(cell);
    }
    grains.sum_over_ranks(sums, 3);
    if (sums[0] == 0.0) return;
    const double share = step_.is_closed() ? sums[1] / (square.cells - sums[2]) : 0.0;
    for (double& value : r) value += share;
    for (const int cell : enclosed_) r[cell] = 0.0;
    square.sum = box.dot(r, r);
    grains.sum_over_ranks(&square.sum, 1);
}

/// z = -(1/dt) laplacian^-1 r, left in the solver; `take(j)` has layer j of it in cache.
void RigidPressure::precondition(const SeparableSolve::LayerWork& take) {
    double* z = step_.pressure_solve().values();
    const BoxLayers& layers = step_.layers();
    const std::vector<double>& r = residual();
    step_.pressure_solve().solve(
        [&](int j) {
            // The solver inverts -laplacian, so z of r/dt is -(1/dt) laplacian^-1 r.
            for (std::size_t c = layers.row(j, 0); c < layers.row(j + 1, 0); ++c) z[c] = r[c] / dt_;
        },
        take);
}

/// The same, and r.z.
double RigidPressure::precondition_with_product(const RigidGrains& grains) {
    const double* z = step_.pressure_solve().values();
    const BoxLayers& layers = step_.layers();
    const std::vector<double>& r = residual();
    double product = 0.0;
    precondition([&](int j) {
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
    if (first)  // r.z comes with the image (ImageProducts::step)
        precondition([](int) {});
    else  // beta = r.z/(r.z of the last iteration)
        rz = precondition_with_product(grains);
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
