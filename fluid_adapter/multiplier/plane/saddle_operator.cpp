// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/plane/saddle_operator.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <sstream>
#include <string>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

/// Throws unless a grain has a positive inertia together with all the fluid that its multipliers
/// tie to it: it is lighter than the fluid and ties too little of it. The fluid in its interior
/// cells alone need not suffice: S is then indefinite, and so is its preconditioner, whose quotient
/// stays positive.
void demand_positive(const Eigen::Matrix3d& effective, GrainId id) {
    if (effective.llt().info() == Eigen::Success) return;
    std::ostringstream text;
    text << "grain " << id << " and the fluid tied to it have mass " << effective(0, 0)
         << " kg/m and moment of inertia " << effective(2, 2)
         << " kg m, which is not positive definite: use a larger grains.density_ratio, or more "
            "fluid.cells_per_diameter";
    throw PhysicsRefused(text.str());
}

/// Throws where A of a grain of the fluid's density and the fluid in its interior cells is
/// singular: it has no cell of its own, or a single one, about which it turns without inertia.
void demand_regular(const Eigen::Matrix3d& inertia, const Eigen::Matrix3d& effective, GrainId id) {
    // A against A + T^T G^-1 T, which is positive: its eigenvalues have no units.
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> solver(
        inertia, effective, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
    if (solver.eigenvalues().cwiseAbs().minCoeff() > 1e-10) return;
    std::ostringstream text;
    text << "grain " << id
         << " has the fluid's density and too few cells inside its surface points, so that nothing "
            "gives it an inertia: use more fluid.cells_per_diameter, a larger fluid.point_spacing, "
            "or fluid.points: interior";
    throw PhysicsRefused(text.str());
}

}  // namespace

void SaddleOperator::assemble(FluidField& field, const std::vector<ImmersedGrain>& grains,
                              const CollocationPoints& points) {
    field_ = &field;
    grains_ = &grains;
    points_ = &points;
    ids_.clear();
    for (const ImmersedGrain& grain : grains) ids_.push_back(grain.id);
    // The sums over holders below need this announcement, of every rank.
    field.hold_grains(ids_.data(), static_cast<int>(ids_.size()));
    sum_bodies();
    factorise();
}

void SaddleOperator::sum_bodies() {
    sums_.resize(grains_->size());
    for (std::size_t g = 0; g < grains_->size(); ++g)
        sums_[g] = sum_cells(*points_, static_cast<int>(g));
    // A rank has the cells it owns, and A needs those of the whole grain.
    sum_over_holders(sums_);
    for (std::size_t g = 0; g < grains_->size(); ++g)
        sums_[g] += sums_of((*grains_)[g].beyond, field_->reference_mass());
    body_.resize(grains_->size());
    for (std::size_t g = 0; g < grains_->size(); ++g)
        body_[g] = body_inertia((*grains_)[g], sums_[g], field_->reference_mass());
}

void SaddleOperator::factorise() {
    // Which cells are shared comes first: the blocks leave these out of the coupling's rows.
    coupling_.begin(*field_, *points_);
    blocks_.factorise(*field_, *grains_, *points_, coupling_);
    // G^-1 is of one rank's points at a time: where points of a grain on two ranks share cells the
    // sum is an approximation, in the preconditioner and in the effective inertia alike.
    tied_ = blocks_.tied_inertia();
    sum_over_holders(tied_);
    effective_.resize(grains_->size());
    inverse_.resize(grains_->size());
    inverse_effective_.resize(grains_->size());
    for (std::size_t g = 0; g < grains_->size(); ++g) {
        if ((*grains_)[g].prescribed) {
            hold(g);
            continue;
        }
        // Not by Cholesky: A alone may be indefinite, for a light grain with boundary points.
        effective_[g] = body_[g] + tied_[g];
        demand_positive(effective_[g], ids_[g]);
        demand_regular(body_[g], effective_[g], ids_[g]);
        inverse_[g] = body_[g].inverse();
        inverse_effective_[g] = effective_[g].inverse();
    }
}

/// A grain of prescribed motion has A^-1 = (A + T^T G^-1 T)^-1 = 0: no impulse moves it.
void SaddleOperator::hold(std::size_t g) {
    inverse_[g] = inverse_effective_[g] = effective_[g] = Eigen::Matrix3d::Zero();
}

/// S w = G w + T A^-1 T^T w.
void SaddleOperator::apply(const Multipliers& w, double* y) {
    coupling_.apply(*field_, w.values.data(), y);
    by_grain_.resize(grains_->size());
    for (std::size_t g = 0; g < by_grain_.size(); ++g)
        by_grain_[g] = -(inverse_[g] * w.on_grains[g]);
    // y -= T (-A^-1 T^T w)
    BoundaryOperator(*points_).subtract_motion(by_grain_.data(), y);
}

/// G^-1 by blocks, with T A^-1 T^T added by the formula of Woodbury: with s = T^T G^-1 r and
/// q = (A + T^T G^-1 T)^-1 s
///
///     z = G^-1 (r - T q),    T^T z = s - T^T G^-1 T q
void SaddleOperator::precondition(const double* r, Multipliers& z) {
    // z = G^-1 r at first, and its sums by grain are s.
    blocks_.solve(r, z.values.data());
    BoundaryOperator(*points_).sum_by_grain(z.values.data(), z.on_grains.data());
    sum_over_holders(z.on_grains);
    by_grain_.resize(grains_->size());
    for (std::size_t g = 0; g < by_grain_.size(); ++g) {
        by_grain_[g] = inverse_effective_[g] * z.on_grains[g];
        z.on_grains[g] -= tied_[g] * by_grain_[g];
    }
    blocks_.subtract_images(by_grain_.data(), z.values.data());
}

double SaddleOperator::dot(const double* a, const double* b) const {
    using Vector = Eigen::Map<const Eigen::VectorXd>;
    // A point is of one rank alone, so nothing is counted twice.
    double sum = Vector(a, rows()).dot(Vector(b, rows()));
    field_->sum_over_ranks(&sum, 1);
    return sum;
}

double SaddleOperator::points_everywhere() const {
    double count = points_->boundary_points();
    field_->sum_over_ranks(&count, 1);
    return count;
}

}  // namespace turbidite
