// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The conditions on every window: no grain lost, no overlap beyond the limit, a divergence-free
// fluid, converged multiplier problems. A violation ends the run with exit code 6. Numbers are
// checked to be finite where they arrive (schemes/exchanges.hpp).
#pragma once

#include "coupler/hub/hub_settings.hpp"
#include "coupler/output/window_result.hpp"

namespace turbidite {

class Ledger {
 public:
    Ledger(const HubSettings& settings, std::size_t population);

    /// Throws PhysicsRefused.
    void check_start(const Motion& state) const;
    void check(const WindowResult& result);

 private:
    void check_count(const Motion& state) const;
    void check_overlap(const Motion& state) const;
    void check_divergence(const FluidReport& report);
    void check_multipliers(const FluidReport& report);

    std::size_t population_;
    std::size_t removed_ = 0;
    HubSettings settings_;
    int divergent_windows_ = 0;  ///< in succession
    int stopped_windows_ = 0;    ///< in succession, whose multiplier problem stopped at its limit
};

}  // namespace turbidite
