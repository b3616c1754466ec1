// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The conditions on every window: no overlap beyond the limit, a divergence-free fluid, converged
// multiplier problems, the momentum of grains and fluid balanced. A violation ends the run with
// exit code 6. Single messages are checked where they arrive (schemes/exchanges.hpp).
#pragma once

#include <functional>
#include <string>

#include "coupler/hub/hub_settings.hpp"
#include "coupler/output/window_result.hpp"

namespace turbidite {

/// What the checks pass from one window to the next.
struct LedgerState {
    std::int64_t divergent_windows = 0;  ///< in succession
    std::int64_t stopped_windows = 0;    ///< in succession, whose multiplier problem stopped
    bool warned_of_grains = false, warned_of_fluid = false;  ///< of their balances
};

class Ledger {
 public:
    using Print = std::function<void(const std::string&)>;

    /// `warn` gets the text of a warning, at most one per balance and run.
    Ledger(const HubSettings& settings, Print warn);

    /// "grains (my-code)", for error messages.
    void name_programs(std::string grains, std::string fluid);

    LedgerState saved() const;
    void resume(const LedgerState& state);

    /// Throws PhysicsRefused.
    void check(const Window& window, const WindowResult& result);

 private:
    void check_overlap(const Window& window, const Motion& state) const;
    void check_divergence(const FluidReport& report);
    void check_multipliers(const FluidReport& report);

    /// What a balance that is not kept says of the grains.
    std::string meaning(const GrainBalance& balance) const;

    /// One of the balances and whether it was warned of.
    struct Balance {
        const char* column;
        BalanceLimits limits;
        bool warned = false;
    };
    void judge(Balance& balance, double defect, const Window& window, const std::string& meaning);

    HubSettings settings_;
    Print warn_;
    std::string grains_ = "grains", fluid_ = "fluid";
    Balance grain_balance_, fluid_balance_;
    std::int64_t divergent_windows_ = 0;  ///< in succession
    std::int64_t stopped_windows_ =
        0;  ///< in succession, whose multiplier problem stopped at its limit
};

}  // namespace turbidite
