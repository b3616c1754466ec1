// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The constraint for spheres in space, in closed form: the cells inside a sphere (sphere_cells.hpp)
// move with it, and there are no points on its surface. With m = rho_f V_c of each cell and r from
// the centre, summed over its cells,
//
//     A  =  [ (cM + sum m) 1        -sum m [r]x         ]      [r]x v = r x v
//           [  sum m [r]x      cI 1 - sum m [r]x [r]x   ]
//     P  =  cM U + (M - m_f) g dt + J - J_h  +  sum m (u ; r x u)
//     (U, omega) = A^-1 P,    u_c = U + omega x r
//
// A is positive definite for spheres of any density that cover enough fluid, also where cM <= 0.
// Before, the fluid gets back what spheres have taken by covering it (slip_return.hpp).
// What is found is exact, so that W is symmetric to rounding and nothing iterates. Valid C++17.
#pragma once

#include <Eigen/Cholesky>
#include <optional>

#include "fluid_adapter/multiplier/constraint.hpp"
#include "fluid_adapter/multiplier/fluid_field.hpp"
#include "fluid_adapter/multiplier/space/slip_return.hpp"
#include "fluid_adapter/multiplier/space/sphere_cells.hpp"

namespace turbidite {

class InteriorConstraint final : public Constraint {
 public:
    /// `field` is kept by reference. `returns_slip`: as slip_return.hpp says, which the paper's
    /// splitting does not.
    explicit InteriorConstraint(FluidField& field, bool returns_slip = true)
        : field_(field), cells_(field.layers()) {
        if (returns_slip) slip_return_.emplace(field, cells_.owners());
    }

    void place(const std::vector<ImmersedGrain>& grains) override;
    MultiplierResult solve(const VelocityPointers& u) override;
    MultiplierResult push(const std::vector<Impulse>& impulses) override;
    void impose() override;
    Twist motion(std::size_t grain) const override;
    Impulse impulse(std::size_t grain) const override;

    /// Of translation and rotation alone, each the same in all directions: what couples them is
    /// left to the rounds of `joint`, of which response and push use the same.
    std::array<double, 21> effective_inertia(std::size_t grain) const override;
    Twist moved_by(std::size_t grain, const Impulse& impulse) const override;

    void for_cells(const std::function<void(int)>& visit) const override;
    void clear_covered(double* values) const override;
    bool has_driven() const override { return any_prescribed(*grains_); }
    void mark_driven(double* values) const override;
    const std::vector<CellSide>& film_sides() override { return cells_.find_wedges().sides(); }
    MultiplierResult make_rigid(const VelocityPointers& change, double reduction,
                                GrainChange& of_grains) override;
    void add(const GrainChange& change, double share) override;
    MultiplierResult settle() override;
    void sum_over_ranks(double* values, int count) const override {
        field_.sum_over_ranks(values, count);
    }

    const SphereCells& cells() const { return cells_; }

 private:
    using Six = Eigen::Matrix<double, 6, 1>;  // linear, angular
    using SixBySix = Eigen::Matrix<double, 6, 6>;

    void sum_bodies();
    void return_slip(const VelocityPointers& u);
    std::vector<Six> sum_velocity(const VelocityPointers& u) const;
    std::vector<Six> carry(const VelocityPointers& u, const std::vector<Six>& motions) const;
    template <class Row>
    void sum_over_holders(std::vector<Row>& rows) const;
    Six moved(std::size_t grain, const Six& impulse) const;

    FluidField& field_;
    SphereCells cells_;
    std::optional<SlipReturn> slip_return_;
    const std::vector<ImmersedGrain>* grains_ = nullptr;
    VelocityPointers velocity_{};
    std::vector<Eigen::LLT<SixBySix>> bodies_;  // A; not of grains of prescribed motion
    std::vector<double> linear_, angular_;      // isotropic A
    std::vector<Six> motions_, impulses_;
};

}  // namespace turbidite
