// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Partners with an exact answer, to test one side of a job without the other.
//
// Scripted grains fall freely and never touch:      U^{4/5} = U^n - (M_sub/M_eff) g dt,   q += dt U
// The scripted fluid is a linear drag, implicit:    M_eff (U^{n+1} - U^{4/5}) = -gamma dt U^{n+1}
//
// so that after n windows U_y = -sum over k = 1..n of a dt b^k, a = (M_sub/M_eff) g, b = 1/(1 +
// gamma dt/M_eff). Under `joint` drag and contact impulse J act at once:
//
//     M_eff (U^{n+1} - U^n) = -M_sub g dt + J - gamma dt U^{n+1}
//
// that is effective inertia A = M_eff + gamma dt.
#pragma once

#include <functional>
#include <unordered_map>

#include "coupler/participant/adapter.hpp"
#include "coupler/shapes/immersed_body.hpp"

namespace turbidite {

/// A hook called at the start of every function with its name and the window: tests throw, sleep or
/// exit there.
using Fault = std::function<void(const std::string& function, std::int64_t window)>;

/// Bodies as a scripted side needs them: inertia from the settings' densities.
class ScriptedBodies {
 public:
    void initialise(const Settings& settings, const ShapeTable& shapes);
    ImmersedBody body(const GrainState& grain) const;
    double gravity() const { return gravity_; }

 private:
    std::vector<std::shared_ptr<const Shape>> shapes_;
    double fluid_density_ = 0.0, hydrodynamic_radius_ = 1.0, gravity_ = 0.0;
};

class ScriptedGrains : public GrainsAdapter {
 public:
    explicit ScriptedGrains(std::string adapter_name, Fault fault = {});

    /// A floor without friction: no grain's lowest point may pass y = `height`. Uses the diagonal
    /// of the inertia that the fluid tells.
    void lay_floor(double height) { floor_ = height; }

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

    ScriptedBodies bodies_;
    double floor_;
    bool joint_ = false;
    std::vector<Vec3> contact_velocities_;
    std::vector<ContactRecord> contacts_;  ///< of the last advance
    Fault fault_;
};

class ScriptedFluid : public FluidAdapter {
 public:
    /// Rank `rank` of `ranks` owns an equal slice of the domain in x. `drag` is gamma [kg/s].
    ScriptedFluid(double drag, int rank = 0, int ranks = 1, Fault fault = {});

    /// Under `joint` the inertia it tells is (1 + share) times the true one; `correct` then has
    /// something to correct: each round leaves `share` of the error.
    void misjudge_inertia(double share) { told_ = 1.0 + share; }

    Hello describe() const override;
    Box initialise(const Settings&, const ShapeTable&) override;
    void advance(const Window&) override;
    std::vector<FreeResponse> respond(const Window&, const std::vector<GrainState>&) override;
    std::vector<FreeResponse> correct(const Window&, const std::vector<GrainState>&) override;
    Kicks impose(const Window&, const std::vector<GrainState>&) override;
    SavedState save() const override;
    void restore(const SavedState&) override;

 private:
    /// A grain without contacts under `joint`, and its true effective inertia.
    struct FreeGrain {
        Vec3 velocity{}, angular_velocity{};
        double mass = 0.0, inertia = 0.0;
    };

    void reach(const char* function, std::int64_t window) const;
    bool owns(const GrainState& grain) const;
    FreeGrain fall(const GrainState& grain, double step) const;
    /// The same with the grain's contact impulses.
    FreeGrain pushed(const GrainState& grain) const;
    FreeResponse response(GrainId id, const FreeGrain& motion) const;

    double drag_;
    int rank_, ranks_;
    double told_ = 1.0;
    std::unordered_map<GrainId, FreeGrain> free_;  ///< of this window
    ScriptedBodies bodies_;
    Box box_;
    bool joint_ = false;
    Fault fault_;
};

}  // namespace turbidite
