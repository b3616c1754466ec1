// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/plane_constraint.hpp"

#include <Eigen/Cholesky>

namespace turbidite {
namespace {

/// The plane components (x, y, spin) are 0, 1, 5 of the six in space. The others are fixed; their
/// diagonal entries are set to 1.
std::array<double, 21> in_space(const Eigen::Matrix3d& plane) {
    constexpr std::size_t six[] = {0, 1, 5};
    std::array<double, 21> inertia{};
    for (const std::size_t still : {2, 3, 4}) inertia[upper_entry(still, still)] = 1.0;
    for (int i = 0; i < 3; ++i)
        for (int j = i; j < 3; ++j) inertia[upper_entry(six[i], six[j])] = plane(i, j);
    return inertia;
}

}  // namespace

void PlaneConstraint::place(const std::vector<ImmersedGrain>& grains) {
    grains_ = &grains;
    placement_.place(field_, grains, points_);
}

MultiplierResult PlaneConstraint::solve(const VelocityPointers& u) {
    system_.assemble(field_, *grains_, points_);
    flow_.begin(system_, u, momenta_of(*grains_), prescribed_motions(*grains_));
    const MultiplierResult result = uzawa_cg(flow_, settings_, work_);
    slip_goal_ = result.goal;
    return result;
}

/// To the slip that the window's first solve had to reach.
MultiplierSettings PlaneConstraint::continued() const {
    MultiplierSettings settings = settings_;
    settings.tolerance = slip_goal_ / settings.velocity_scale;
    // The first slip of a later solve may be small: to reduce it by the same factor again would ask
    // for more with every push.
    settings.reduction = 1.0;
    return settings;
}

MultiplierResult PlaneConstraint::push(const std::vector<Impulse>& impulses) {
    pushed_.clear();
    for (const Impulse& of : impulses) pushed_.push_back(planar(of));
    flow_.push(pushed_);
    return uzawa_cg(flow_, continued(), work_);
}

std::array<double, 21> PlaneConstraint::effective_inertia(std::size_t grain) const {
    return in_space(system_.effective_inertia()[grain]);
}

Twist PlaneConstraint::moved_by(std::size_t grain, const Impulse& impulse) const {
    // Positive definite, as SaddleOperator::assemble has demanded.
    return twist(system_.effective_inertia()[grain].llt().solve(planar(impulse)));
}

void PlaneConstraint::for_cells(const std::function<void(int)>& visit) const {
    for (const InteriorCell& point : points_.interior) visit(point.cell);
    // Halo cells are read by import_halo and belong to other ranks.
    for (const StencilCell& at : points_.stencilled)
        if (field_.owns(at.cell)) visit(at.cell);
}

void PlaneConstraint::clear_covered(double* values) const {
    // Cells that boundary points interpolate from are fluid, even if their centres are inside.
    for (const InteriorCell& inside : points_.interior) values[inside.cell] = 0.0;
}

void PlaneConstraint::mark_driven(double* values) const {
    for (std::size_t g = 0; g < grains_->size(); ++g)
        for (int i = points_.interior_begin[g];
             (*grains_)[g].prescribed && i < points_.interior_begin[g + 1]; ++i)
            values[points_.interior[i].cell] = 1.0;
}

MultiplierResult PlaneConstraint::make_rigid(const VelocityPointers& change, double reduction,
                                             GrainChange& of_grains) {
    MultiplierSettings settings = settings_;
    settings.tolerance = 1.0;  // the slip of a change is judged by its own size
    settings.reduction = reduction;
    change_.begin(system_, change);
    const MultiplierResult result = uzawa_cg(change_, settings, work_);
    change_.impose();
    change_.copy_to(of_grains);
    return result;
}

MultiplierResult PlaneConstraint::settle() {
    const MultiplierResult result = uzawa_cg(flow_, continued(), work_);
    flow_.impose();
    return result;
}

}  // namespace turbidite
