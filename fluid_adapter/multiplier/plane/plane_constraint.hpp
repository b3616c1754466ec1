// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The constraint in the plane: points inside grains and on their surfaces (collocation_points.hpp),
// and Uzawa's method for the multipliers of the latter (uzawa_cg.hpp). Valid C++17.
#pragma once

#include "fluid_adapter/multiplier/plane/uzawa_cg.hpp"

namespace turbidite {

class PlaneConstraint final : public Constraint {
 public:
    /// `field` is kept by reference.
    PlaneConstraint(FluidField& field, const PointRules& rules, const MultiplierSettings& settings)
        : field_(field), settings_(settings), placement_(rules) {}

    void place(const std::vector<ImmersedGrain>& grains) override;
    MultiplierResult solve(const VelocityPointers& u) override;
    MultiplierResult push(const std::vector<Impulse>& impulses) override;
    void impose() override { flow_.impose(); }
    Twist motion(std::size_t grain) const override { return twist(flow_.motions()[grain]); }
    Impulse impulse(std::size_t grain) const override {
        return turbidite::impulse(flow_.impulses()[grain]);
    }
    std::array<double, 21> effective_inertia(std::size_t grain) const override;
    Twist moved_by(std::size_t grain, const Impulse& impulse) const override;
    void for_cells(const std::function<void(int)>& visit) const override;
    void clear_covered(double* values) const override;
    bool has_driven() const override { return any_prescribed(*grains_); }
    void mark_driven(double* values) const override;
    MultiplierResult make_rigid(const VelocityPointers& change, double reduction,
                                GrainChange& of_grains) override;
    void add(const GrainChange& change, double share) override { flow_.add(change, share); }
    MultiplierResult settle() override;
    void sum_over_ranks(double* values, int count) const override {
        field_.sum_over_ranks(values, count);
    }

    const CollocationPoints& points() const { return points_; }
    const SaddleOperator& system() const { return system_; }
    const ConstrainedFlow& flow() const { return flow_; }

 private:
    MultiplierSettings continued() const;

    FluidField& field_;
    MultiplierSettings settings_;
    double slip_goal_ = 0.0;  // rms slip to reach, set by the window's first solve [m/s]
    const std::vector<ImmersedGrain>* grains_ = nullptr;
    PointPlacement placement_;
    CollocationPoints points_;
    SaddleOperator system_;
    ConstrainedFlow flow_, change_;  // of the window, of a change from outside
    std::vector<Planar> pushed_;
    MultiplierWorkspace work_;
};

}  // namespace turbidite
