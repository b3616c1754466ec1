// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's books on the grains: how many there must be, that every number is finite, that
// nothing overlaps beyond tolerance, that the fluid stays divergence-free. Each violation ends the
// run with exit code 6.
#pragma once

#include "coupler/hub/scheme.hpp"
#include "coupler/protocol/settings.hpp"

namespace turbidite {

class Ledger {
 public:
    Ledger(const Settings& settings, std::size_t population);

    /// Throws PhysicsRefused.
    void check_start(const Motion& state) const;
    void check(const Window& window, const WindowResult& result);

 private:
    void check_count(const Motion& state) const;
    void check_overlap(const Motion& state) const;
    void check_divergence(const FluidReport& report);

    std::size_t population_;
    std::size_t removed_ = 0;
    double diameter_;
    double rate_;                  ///< u_c / D [1/s]
    double penetration_limit_;     ///< [D]
    std::string against_overlap_;  ///< advice in the terms of the adapter
    int divergent_windows_ = 0;
};

}  // namespace turbidite
