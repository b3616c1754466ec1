// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order in which one window is played, by the names of `coupling.scheme`. A scheme only moves
// messages; what the numbers mean is the participants' business.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coupler/hub/kick.hpp"
#include "coupler/hub/watch.hpp"
#include "coupler/transport/exchange_plan.hpp"

namespace turbidite {

/// Everybody a scheme talks to.
struct Cast {
    ParticipantLink& grains;
    ParticipantLink* fluid;  ///< null in dry runs
    Watch& watch;
    ExchangePlan& plan;
    const KickRule& kick_rule;
};

/// What a window leaves behind.
struct WindowResult {
    Motion motion;  ///< after step 4
    Kicks kicks;    ///< after step 5; empty in dry runs
    Motion state;   ///< at t^{n+1}
};

class Scheme {
 public:
    virtual ~Scheme() = default;
    /// `before` is the state at t^n.
    virtual WindowResult play(const Window& window, const Motion& before, Cast& cast) = 0;
};

struct SchemeEntry {
    const char* name;
    std::unique_ptr<Scheme> (*make)();
};
const std::vector<SchemeEntry>& scheme_list();
std::unique_ptr<Scheme> make_scheme(const std::string& name);

std::unique_ptr<Scheme> make_split();
std::unique_ptr<Scheme> make_joint();
std::unique_ptr<Scheme> make_dry();

}  // namespace turbidite
