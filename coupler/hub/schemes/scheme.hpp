// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A scheme defines one window: the messages that each side sends and receives, as data, and the
// coupler's part in them. It only passes messages on; their numbers are interpreted by the
// participants, which react to messages and do not depend on the scheme. A new scheme is one file
// beside this one and one line in scheme_list.cpp.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "coupler/hub/checks/grain_roster.hpp"
#include "coupler/hub/checks/motion_rule.hpp"
#include "coupler/hub/exchange_plan.hpp"
#include "coupler/hub/kick_rule.hpp"
#include "coupler/hub/watch.hpp"
#include "coupler/output/window_result.hpp"

namespace turbidite {

/// What a scheme works with: the participants of a run, and the rules for what they send.
struct SchemeContext {
    ParticipantLink& grains;
    ParticipantLink* fluid;  ///< null in dry runs
    Watch& watch;
    ExchangePlan& plan;
    GrainRoster& roster;
    KickRule& kick_rule;
    MotionRule& motion_rule;
};

class Scheme {
 public:
    virtual ~Scheme() = default;
    /// `before` is the state at t^n.
    virtual WindowResult play(const Window& window, const Motion& before,
                              SchemeContext context) = 0;
};

struct SchemeEntry {
    const char* name;  ///< of coupling.scheme and run.scheme
    const char* help;  ///< half a sentence, for the list of keys
    Order fluid;       ///< empty when there is no fluid
    Order grains;
    /// Tolerance of the slip over coupling.tolerance: small enough that the mismatch between
    /// contacts and fluid comes from the inertia and not from the multiplier solve; 0:
    /// coupling.tolerance is not used.
    double slip_per_mismatch;
    /// The grains repeat their window with other velocities to come to (restores_within_window),
    /// instead of taking the fluid's inertia into their contacts.
    bool repeats = false;
    double usual_rounds = 1.0;  ///< of a window with several grains, a mean over the studies
    std::unique_ptr<Scheme> (*make)(const Settings&);

    const Order& order(Role role) const { return role == Role::fluid ? fluid : grains; }

    /// Contacts and fluid are solved in turns until they agree.
    bool has_rounds() const;
    /// The fluid answers contact solves with its effective inertia.
    bool has_responses() const;
    /// The grains solve their contacts with that inertia, so that they may be as light as the fluid
    /// and lighter.
    bool needs_inertia() const { return has_responses() && !repeats; }
    /// Fluid and grains of a window compute at the same time.
    bool side_by_side() const { return !fluid.empty() && !has_responses(); }

    /// rms slip at which step 5 is solved [u_c]: run.slip_tolerance.
    double slip_tolerance(const Settings& settings) const;
};

const std::vector<SchemeEntry>& scheme_list();

/// The scheme without a fluid, otherwise coupling.scheme: run.scheme.
std::string scheme_name(const Settings& settings);
/// The first scheme with a fluid that is as asked: with the fluid's inertia, or without rounds.
const SchemeEntry& scheme_with_inertia();
const SchemeEntry& scheme_without_rounds();

/// Throws std::invalid_argument that lists the known schemes.
const SchemeEntry& find_scheme(const std::string& name);

SchemeEntry split_scheme();
SchemeEntry joint_scheme();
SchemeEntry sub_iterated_scheme();
SchemeEntry dry_scheme();

}  // namespace turbidite
