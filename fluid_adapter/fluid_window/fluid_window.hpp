// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One window of the fluid, step by step as in the paper (Topin 2011, section 2.1.2):
//
//     project     1  pressure projection: u becomes divergence-free   }
//     transport   2  convection of u                                  }  advance
//     diffuse     3  viscosity                                        }
//     answer      5  the multipliers of the grains, Eqs. 9-10            whenever grains come
//                    (correct_fluid: pressure and viscosity with rigid grains, coupled_step.hpp)
//     impose         writes the u of the multipliers; kicks              ends the window
//
// A StepWatch (step_watch.hpp) runs each step; it knows clocks and names. What crosses the
// boundaries is entered in the ledger (momentum_ledger.hpp). The fields are a store's
// (fluid_store.hpp), whatever program it is. Valid C++17.
#pragma once

#include "fluid_adapter/coupled_step/coupled_step.hpp"
#include "fluid_adapter/fluid_window/fluid_store.hpp"
#include "fluid_adapter/fluid_window/fluid_timings.hpp"
#include "fluid_adapter/fluid_window/momentum_ledger.hpp"
#include "fluid_adapter/fluid_window/step_watch.hpp"
#include "fluid_adapter/multiplier/immersed_step.hpp"

namespace turbidite {

class FluidWindow {
 public:
    /// `store` is kept by reference.
    FluidWindow(FluidStore& store, const Settings& settings, const ShapeTable& shapes);

    /// Steps 1 to 3.
    void advance(const Window& window);

    /// Step 5 for grains without contact forces: they fall from U^n together with the fluid.
    void let_fall(const std::vector<GrainState>& grains);

    /// Step 5 for grains after a contact solve. The first call of a window brings their velocities;
    /// later calls bring contact impulses, which act on fluid and grains together.
    void correct(const std::vector<GrainState>& grains);

    /// Responses of the grains whose centre this rank owns, after let_fall or correct.
    std::vector<FreeResponse> responses();

    /// Writes u back; returns the kicks and the window's report.
    Kicks impose();

    /// Copies what the steps keep internally into the fields, for output, those who look at them
    /// and a saved state.
    void put_fields();

    // What was changed from outside, between windows:

    void velocity_changed();  ///< u of the fields
    void fields_replaced();   ///< all that a saved state holds

    const FluidTimings& timings() const { return timings_; }

 private:
    /// Of the present window.
    struct SoFar {
        bool grains_taken = false;
        bool flows_in = false;  ///< through a side of the box
        bool jumped = false;    ///< bodies or an inflow have set a fluid at rest in motion
    };

    void begin(const Window& window);
    void project();
    void drive();
    void transport();
    void diffuse();
    void check_finite(bool finite, const char* steps) const;
    void check_rows(const std::vector<GrainState>& grains) const;
    template <class Take>
    void answer(const char* name, Take take);
    void begin_in_motion();
    void carry_along();
    void forget_jump();
    bool begins_without_pressure(const CoupledStep& coupled) const;
    void note(const MultiplierResult& result);
    void note(const CoupledReport& result);
    void correct_fluid(CoupledLimits limits);
    void close_ledger();
    double volume() const;
    void write_fields();
    bool fields_due() const;
    bool lambda_is_seen() const;

    const RunValues run_;
    FluidStore& store_;
    StoredField& field_;
    FluidStep& step_;
    double highest_grain_;  // that rows of cells resolve, or the case allows [m]
    MomentumLedger ledger_;
    ImmersedStep multipliers_;
    CoupledLimits coupled_limits_;

    Window window_;  ///< the present one
    SoFar so_far_;
    bool fields_follow_ = true;  ///< the fields hold what the steps know
    StepWatch watch_;
    FluidTimings timings_;
    TransportParts parts_;
    FluidReport report_;
};

}  // namespace turbidite
