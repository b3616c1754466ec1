// SPDX-License-Identifier: LGPL-2.1-or-later
#include "fluid_adapter/multiplier/space/interior_constraint.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <sstream>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
namespace {

using Vector = Eigen::Vector3d;

Vector vector(const Vec3& v) {
    return {v[0], v[1], v[2]};
}

Vec3 vec3(const Vector& v) {
    return {v.x(), v.y(), v.z()};
}

/// r x
Eigen::Matrix3d cross_matrix(const Vector& r) {
    Eigen::Matrix3d m;
    m << 0.0, -r.z(), r.y(), r.z(), 0.0, -r.x(), -r.y(), r.x(), 0.0;
    return m;
}

Eigen::Matrix<double, 6, 1> six(const Vec3& linear, const Vec3& angular) {
    Eigen::Matrix<double, 6, 1> both;
    both << vector(linear), vector(angular);
    return both;
}

/// Sums over cells, weighted by V_c over the reference cell's volume: 1, r, and r r^T by its upper
/// triangle.
struct Moments {
    double volume = 0.0;
    Vector first = Vector::Zero();
    Eigen::Matrix3d second = Eigen::Matrix3d::Zero();

    static constexpr int count = 10;
    Eigen::Matrix<double, count, 1> numbers() const {
        Eigen::Matrix<double, count, 1> n;
        n << volume, first, second(0, 0), second(0, 1), second(0, 2), second(1, 1), second(1, 2),
            second(2, 2);
        return n;
    }
};

/// As many of the reference cells, of mass m.
Moments moments_of(const FluidBeyond& beyond, double m) {
    return {beyond.mass / m, beyond.first / m, beyond.second / m};
}

/// Of a run: r = first + c h e_x, c = 0 .. count - 1.
void add_run(Moments& sums, const CellRun& run, double h) {
    for (int c = 0; c < run.count; ++c) {
        const Vector r(run.first.x() + c * h, run.first.y(), run.first.z());
        sums.volume += run.volume;
        sums.first += run.volume * r;
        sums.second += run.volume * r * r.transpose();
    }
}

/// Sums of v and r x v over the cells of a grain, weighted as in Moments.
class ShareSums {
 public:
    explicit ShareSums(double h) : h_(h) {}

    /// Adds a run with `value(c)` in its cell c, where r = first + c h e_x.
    template <class Value>
    void add(const CellRun& run, Value value) {
        Vector of_run = Vector::Zero(), along = Vector::Zero();
        // sum r x v = first x sum v + h e_x x sum c v: no cross product per cell
        for (int c = 0; c < run.count; ++c) {
            const Vector v = value(c);
            of_run += v;
            along += c * v;
        }
        sum_ += run.volume * of_run;
        moment_ += run.volume * (run.first.cross(of_run) + h_ * Vector::UnitX().cross(along));
    }

    /// Both times rho_f V of the reference cell.
    Eigen::Matrix<double, 6, 1> times(double m) const {
        Eigen::Matrix<double, 6, 1> both;
        both << m * sum_, m * moment_;
        return both;
    }

 private:
    double h_;
    Vector sum_ = Vector::Zero(), moment_ = Vector::Zero();
};

/// A from the sums over all ranks.
Eigen::Matrix<double, 6, 6> body_inertia(const ImmersedGrain& grain,
                                         const Eigen::Matrix<double, Moments::count, 1>& sums,
                                         double m) {
    // sum m [r]x; it is not zero, since cells are not symmetric about the centre.
    const Eigen::Matrix3d coupling = m * cross_matrix(sums.segment<3>(1));
    Eigen::Matrix3d second;
    second << sums[4], sums[5], sums[6], sums[5], sums[7], sums[8], sums[6], sums[8], sums[9];
    Eigen::Matrix<double, 6, 6> inertia = Eigen::Matrix<double, 6, 6>::Zero();
    inertia.topLeftCorner<3, 3>().diagonal().setConstant(grain.effective_mass + m * sums[0]);
    inertia.topRightCorner<3, 3>() = -coupling;
    inertia.bottomLeftCorner<3, 3>() = coupling;
    // -[r]x [r]x = r.r 1 - r r^T
    inertia.bottomRightCorner<3, 3>() = -m * second;
    inertia.bottomRightCorner<3, 3>().diagonal().array() +=
        grain.effective_inertia + m * second.trace();
    return inertia;
}

[[noreturn]] void refuse(const ImmersedGrain& grain, const Eigen::Matrix<double, 6, 6>& inertia) {
    // Over mass and moment of inertia of the cells, which A contains besides M - rho_f V.
    const double mass = inertia(0, 0) - grain.effective_mass;
    const double moment = inertia.bottomRightCorner<3, 3>().trace() / 3.0 - grain.effective_inertia;
    Eigen::Matrix<double, 6, 1> scale;
    scale << Vector::Constant(1.0 / std::sqrt(mass)), Vector::Constant(1.0 / std::sqrt(moment));
    const Eigen::Matrix<double, 6, 6> scaled = scale.asDiagonal() * inertia * scale.asDiagonal();
    std::ostringstream text;
    text
        << "grain " << grain.id
        << " is too light for the cells of fluid that it holds: the inertia of both together, over "
           "that of the cells, has the eigenvalue "
        << Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>(scaled).eigenvalues()[0]
        << "; use a larger density, or more fluid.cells_per_diameter";
    throw PhysicsRefused(text.str());
}

}  // namespace

void InteriorConstraint::place(const std::vector<ImmersedGrain>& grains) {
    grains_ = &grains;
    cells_.find(grains);
    std::vector<GrainId> ids;
    for (const ImmersedGrain& grain : grains) ids.push_back(grain.id);
    field_.hold_grains(ids.data(), static_cast<int>(ids.size()));
    sum_bodies();
}

template <class Row>
void InteriorConstraint::sum_over_holders(std::vector<Row>& rows) const {
    double* first = rows.empty() ? nullptr : rows.front().data();
    field_.sum_over_holders(first, static_cast<int>(Row::SizeAtCompileTime));
}

void InteriorConstraint::sum_bodies() {
    const std::vector<ImmersedGrain>& grains = *grains_;
    std::vector<Eigen::Matrix<double, Moments::count, 1>> sums;
    for (std::size_t g = 0; g < grains.size(); ++g) {
        Moments moments;
        for (const CellRun& run : cells_.runs(g)) add_run(moments, run, field_.grid().spacing[0]);
        sums.push_back(moments.numbers());
    }
    // Each rank has the cells of its layers.
    sum_over_holders(sums);
    for (std::size_t g = 0; g < grains.size(); ++g)
        sums[g] += moments_of(grains[g].beyond, field_.reference_mass()).numbers();
    bodies_.resize(grains.size());
    linear_.assign(grains.size(), 0.0);
    angular_.assign(grains.size(), 0.0);
    for (std::size_t g = 0; g < grains.size(); ++g) {
        if (grains[g].prescribed) continue;
        const SixBySix inertia = body_inertia(grains[g], sums[g], field_.reference_mass());
        bodies_[g].compute(inertia);
        if (bodies_[g].info() != Eigen::Success) refuse(grains[g], inertia);
        // For `joint`: cM + sum m, and the mean of the angular diagonal, tr(A_rr)/3
        linear_[g] = inertia(0, 0);
        angular_[g] = inertia.diagonal().tail<3>().mean();
    }
}

/// A^-1 times an impulse; zero where the motion is prescribed.
InteriorConstraint::Six InteriorConstraint::moved(std::size_t grain, const Six& impulse) const {
    if ((*grains_)[grain].prescribed) return Six::Zero();
    return bodies_[grain].solve(impulse);
}

/// sum m (u ; r x u) of every grain, over all ranks.
std::vector<InteriorConstraint::Six> InteriorConstraint::sum_velocity(
    const VelocityPointers& u) const {
    // Columns are equal along x, so that cells of a run are h apart and have one volume.
    const double h = field_.grid().spacing[0], m = field_.reference_mass();
    std::vector<Six> sums(grains_->size());
    for (std::size_t g = 0; g < sums.size(); ++g) {
        ShareSums of_cells(h);
        for (const CellRun& run : cells_.runs(g)) {
            const double *ux = u[0] + run.cell, *uy = u[1] + run.cell, *uz = u[2] + run.cell;
            of_cells.add(run, [&](int c) { return Vector(ux[c], uy[c], uz[c]); });
        }
        sums[g] = of_cells.times(m);
    }
    sum_over_holders(sums);
    return sums;
}

/// Sets this rank's cells to the motions of their grains; returns the impulses, of all ranks, that
/// the fluid loses by it.
std::vector<InteriorConstraint::Six> InteriorConstraint::carry(
    const VelocityPointers& u, const std::vector<Six>& motions) const {
    const double h = field_.grid().spacing[0], m = field_.reference_mass();
    std::vector<Six> lost(grains_->size());
    for (std::size_t g = 0; g < lost.size(); ++g) {
        // u_c = U + omega x r, by one step from cell to cell of a run
        const Vector spin = motions[g].tail<3>();
        const Vector step = h * spin.cross(Vector::UnitX());  // of U + omega x r along a run
        ShareSums off(h);
        for (const CellRun& run : cells_.runs(g)) {
            const Vector first = motions[g].head<3>() + spin.cross(run.first);
            double *ux = u[0] + run.cell, *uy = u[1] + run.cell, *uz = u[2] + run.cell;
            off.add(run, [&](int c) {
                const Vector then(ux[c], uy[c], uz[c]), now = first + c * step;
                ux[c] = now.x(), uy[c] = now.y(), uz[c] = now.z();
                return Vector(then - now);
            });
        }
        lost[g] = off.times(m);
    }
    sum_over_holders(lost);
    return lost;
}

MultiplierResult InteriorConstraint::solve(const VelocityPointers& u) {
    velocity_ = u;
    impulses_.assign(grains_->size(), Six::Zero());
    if (slip_return_) return_slip(u);
    // U = A^-1 (P + J + sum m (u ; r x u)), where J is of the slip that was returned
    motions_ = sum_velocity(u);
    for (std::size_t g = 0; g < motions_.size(); ++g) {
        const ImmersedGrain& grain = (*grains_)[g];
        const Impulse momentum = grain.momentum();
        motions_[g] =
            grain.prescribed
                ? six(grain.contact_motion.velocity, grain.contact_motion.spin)
                : moved(g, motions_[g] + impulses_[g] + six(momentum.linear, momentum.moment));
    }
    return {};
}

void InteriorConstraint::return_slip(const VelocityPointers& u) {
    const std::vector<Vector> moments = slip_return_->play(*grains_, u);
    for (std::size_t g = 0; g < moments.size(); ++g) impulses_[g].tail<3>() = -moments[g];
}

MultiplierResult InteriorConstraint::push(const std::vector<Impulse>& impulses) {
    for (std::size_t g = 0; g < motions_.size(); ++g)
        // Exact, since W is linear and its cells do not change within a window.
        motions_[g] += moved(g, six(impulses[g].linear, impulses[g].moment));
    return {};
}

void InteriorConstraint::impose() {
    // sum m (u - U - omega x r): zero for what has been imposed before, so this may be repeated.
    const std::vector<Six> lost = carry(velocity_, motions_);
    for (std::size_t g = 0; g < lost.size(); ++g) impulses_[g] += lost[g];
}

Twist InteriorConstraint::motion(std::size_t grain) const {
    return {vec3(motions_[grain].head<3>()), vec3(motions_[grain].tail<3>())};
}

Impulse InteriorConstraint::impulse(std::size_t grain) const {
    return {vec3(impulses_[grain].head<3>()), vec3(impulses_[grain].tail<3>())};
}

std::array<double, 21> InteriorConstraint::effective_inertia(std::size_t grain) const {
    std::array<double, 21> inertia{};
    for (std::size_t k = 0; k < 6; ++k)
        inertia[upper_entry(k, k)] = k < 3 ? linear_[grain] : angular_[grain];
    return inertia;
}

Twist InteriorConstraint::moved_by(std::size_t grain, const Impulse& impulse) const {
    return {impulse.linear / linear_[grain], impulse.moment / angular_[grain]};
}

void InteriorConstraint::for_cells(const std::function<void(int)>& visit) const {
    for (std::size_t g = 0; g < grains_->size(); ++g)
        for (const CellRun& run : cells_.runs(g))
            for (int c = 0; c < run.count; ++c) visit(run.cell + c);
}

void InteriorConstraint::clear_covered(double* values) const {
    for (std::size_t g = 0; g < grains_->size(); ++g)
        for (const CellRun& run : cells_.runs(g)) std::fill_n(values + run.cell, run.count, 0.0);
}

void InteriorConstraint::mark_driven(double* values) const {
    for (std::size_t g = 0; g < grains_->size(); ++g)
        if ((*grains_)[g].prescribed)
            for (const CellRun& run : cells_.runs(g))
                std::fill_n(values + run.cell, run.count, 1.0);
}

/// What it does to grains: motions, then impulses.
MultiplierResult InteriorConstraint::make_rigid(const VelocityPointers& change, double,
                                                GrainChange& of_grains) {
    // A change brings no momentum of the grains' own: P = 0, and prescribed ones do not move.
    std::vector<Six> motions = sum_velocity(change);
    for (std::size_t g = 0; g < motions.size(); ++g) motions[g] = moved(g, motions[g]);
    const std::vector<Six> lost = carry(change, motions);
    of_grains.clear();
    for (const std::vector<Six>* list : {&std::as_const(motions), &lost})
        for (const Six& of : *list) of_grains.insert(of_grains.end(), of.begin(), of.end());
    return {};
}

void InteriorConstraint::add(const GrainChange& change, double share) {
    const double* value = change.data();
    for (std::vector<Six>* list : {&motions_, &impulses_})
        for (Six& of : *list)
            for (double& component : of) component += share * *value++;
}

/// Nothing slips.
MultiplierResult InteriorConstraint::settle() {
    impose();
    return {};
}

}  // namespace turbidite
