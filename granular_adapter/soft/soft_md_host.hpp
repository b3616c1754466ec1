// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Molecular dynamics of discs, convex polygons and spheres, as a host without any other code. A
// sub-step of length delta is a leap-frog step, with velocities half a sub-step behind positions:
//
//     overlaps at x           the contact engine's detection       overlaps.hpp
//     forces F(x, v, slips)   springs, dashpots, friction          point_force.hpp
//     v <- v + (F/m + g) delta,  x <- x + v delta                  spin and orientation alike
//
// One rank. Every sum has an order given by the ids of the grains, so that a run repeats itself in
// every digit, also from a saved state. Impulses are summed in every window: those that follow from
// the change of momentum differ by rounding, and `sub-iterated` hands them to the fluid, which
// would notice whether a window has output.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "granular_adapter/md/md_host.hpp"
#include "granular_adapter/soft/overlaps.hpp"
#include "granular_adapter/soft/point_force.hpp"
#include "granular_adapter/soft/slips.hpp"

namespace turbidite::soft {

class SoftMdHost final : public MdHost {
 public:
    std::string code() const override { return "none"; }
    std::vector<std::string> shapes() const override;
    std::int32_t dimension() const override { return both_dimensions; }
    bool repeats() const override { return true; }
    void create(const Settings& settings, const ShapeTable& shapes,
                const nscd::Bodies& bodies) override;
    void read(nscd::Bodies& bodies) const override;
    void write(const nscd::Bodies& bodies) override;
    SubstepReport run(const Substeps& substeps, const std::vector<Load>& loads) override;
    void keep(const std::vector<std::uint8_t>& mask) override;
    SavedState save() const override;
    void restore(const SavedState& state) override;

 private:
    void find_forces(const std::vector<Load>& loads, double step);
    void move(double step);
    void watch(SubstepReport& report) const;
    void add_impulses(SubstepReport& report, double step) const;
    std::vector<ContactRecord> touching(double window) const;
    ContactRecord record(const Overlap& overlap, const PointForce& force, double window) const;

    std::optional<SoftLaw> law_;
    std::optional<OverlapFinder> finder_;
    std::vector<std::int32_t> sides_;  ///< of the domain, by index of the wall
    double gravity_ = 0.0;
    nscd::PeriodicBox box_;
    nscd::Bodies bodies_;
    Slips slips_;
    // Of the present sub-step.
    std::vector<PointForce> forces_;  ///< at each overlap
    std::vector<Load> totals_;        ///< of all forces but gravity, on every body
};

}  // namespace turbidite::soft
