// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The order in which one window is played, by the names of `coupling.scheme`. A scheme only moves
// messages; what the numbers mean is the participants' business.
#pragma once

#include <memory>
#include <optional>
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

/// How contacts and fluid came to agree (`joint`).
struct JointReport {
    std::int64_t rounds = 0;  ///< contact solves
    double mismatch = 0.0;    ///< largest FreeResponse::mismatch after the last one [m/s]
    bool converged = true;    ///< mismatch within coupling.tolerance
};

/// What a window leaves behind.
struct WindowResult {
    Motion motion;  ///< after step 4
    Kicks kicks;    ///< after step 5; empty in dry runs
    Motion state;   ///< at t^{n+1}
    std::optional<JointReport> joint = {};
};

class Scheme {
 public:
    virtual ~Scheme() = default;
    /// `before` is the state at t^n.
    virtual WindowResult play(const Window& window, const Motion& before, Cast& cast) = 0;
};

struct SchemeEntry {
    const char* name;
    std::unique_ptr<Scheme> (*make)(const Settings&);
};
const std::vector<SchemeEntry>& scheme_list();

/// Throws std::invalid_argument for an unknown name.
std::unique_ptr<Scheme> make_scheme(const std::string& name, const Settings& settings);

std::unique_ptr<Scheme> make_split(const Settings&);
std::unique_ptr<Scheme> make_joint(const Settings&);
std::unique_ptr<Scheme> make_dry(const Settings&);

}  // namespace turbidite
