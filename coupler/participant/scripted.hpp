// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Participants with an exact solution, for testing one side of a job without the other.
//
// Scripted grains fall freely and never touch; the scripted fluid is a linear drag, implicit. J_h:
// announced by grains that hold the fluid's impulse in their sub-steps.
//
//     U^{4/5} = U^n - (M_sub/M_eff) g dt,   q += dt U
//     M_eff (U^{n+1} - U^{4/5}) = -gamma dt U^{n+1} - J_h
//
// so that after n windows U_y = -sum over k = 1..n of a dt b^k, a = (M_sub/M_eff) g, b = 1/(1 +
// gamma dt/M_eff). With grains that it lets fall (`joint`), drag and contact impulse J act
// together:
//
//     M_eff (U^{n+1} - U^n) = -M_sub g dt + J - gamma dt U^{n+1}
//
// i.e. the effective inertia is A = M_eff + gamma dt.
#pragma once

#include <functional>

#include "coupler/participant/adapter.hpp"
#include "coupler/shapes/immersed_bodies.hpp"

namespace turbidite {

/// A hook called at the start of every function with its name and the window: tests throw, sleep or
/// exit there.
using Fault = std::function<void(const std::string& function, std::int64_t window)>;

class ScriptedGrains : public GrainsAdapter {
 public:
    explicit ScriptedGrains(std::string adapter_name, Fault fault = {});

    /// A floor without friction: no grain's lowest point may pass y = `height`. Uses the diagonal
    /// of the inertia given by the fluid.
    void lay_floor(double height) { floor_ = height; }

    /// Whether it says that it saves its state, as it does at first.
    void can_save(bool can) { hello_.capabilities.saves_state = can; }

    Hello describe() const override;
    Motion initialise(const Settings&, const ShapeTable&, const std::vector<GrainState>&) override;
    Motion advance(const Window&, const std::vector<FreeResponse>&) override;
    Motion apply_kick(const Window&, const std::vector<Kick>&) override;
    SavedState save() const override;
    void restore(const SavedState&) override;

 protected:
    Motion motion_;
    Hello hello_;

 private:
    void reach(const char* function, std::int64_t window) const;
    void touch_floor(GrainState& grain, double mass, double step);

    ImmersedBodies bodies_;
    double gravity_ = 0.0;
    double floor_;
    bool answered_ = false;  ///< by the fluid, in this window
    std::vector<Vec3> contact_velocities_;
    std::vector<ContactRecord> contacts_;  ///< of the last advance
    Fault fault_;
};

class ScriptedFluid : public FluidAdapter {
 public:
    /// Rank `rank` of `ranks` owns an equal slice of the domain in x. `drag` is gamma [kg/s].
    ScriptedFluid(double drag, int rank = 0, int ranks = 1, Fault fault = {});

    /// The inertia in its responses is (1 + share) times the true one; under `joint` each round
    /// then multiplies the error by `share`.
    void misjudge_inertia(double share) { response_factor_ = 1.0 + share; }

    Hello describe() const override;
    Box initialise(const Settings&, const ShapeTable&) override;
    void advance(const Window&) override;
    void let_fall(const Window&, const std::vector<GrainState>&) override;
    void correct(const Window&, const std::vector<GrainState>&) override;
    std::vector<FreeResponse> respond() override;
    Kicks impose(const Window&) override;
    SavedState save() const override;
    void restore(const SavedState&) override;

 private:
    /// A grain with drag, and its true effective inertia; `pushed` is the contact impulse contained
    /// in its velocity.
    struct DraggedGrain {
        GrainId id = 0;
        bool prescribed = false;
        Vec3 velocity{}, angular_velocity{};
        double mass = 0.0, inertia = 0.0;
        Vec3 pushed{}, angular_pushed{};
        double mismatch = 0.0;
    };

    void reach(const char* function, std::int64_t window) const;
    bool owns(const GrainState& grain) const;
    /// (M_eff velocity + impulse) / (M_eff + gamma dt).
    DraggedGrain dragged(const GrainState& grain, double step, const Vec3& impulse) const;
    static void push(DraggedGrain& own, const GrainState& solved);
    FreeResponse response(const DraggedGrain& grain) const;

    double drag_;
    int rank_, ranks_;
    double response_factor_ = 1.0;
    std::vector<DraggedGrain> grains_;  ///< of this window, empty before they arrive
    ImmersedBodies bodies_;
    double gravity_ = 0.0;
    Box box_;
    Fault fault_;
};

}  // namespace turbidite
