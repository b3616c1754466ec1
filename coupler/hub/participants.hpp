// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The two participants of a run as the coupler sees them, and how it waits for them.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "coupler/hub/hub_settings.hpp"
#include "coupler/hub/participant_link.hpp"
#include "coupler/hub/watch.hpp"
#include "coupler/protocol/timeline.hpp"

namespace turbidite {

struct Participants {
    /// `fluid_channel` is null in dry runs.
    Participants(Channel& grains_channel, Channel* fluid_channel, const HubSettings& settings,
                 Watch::Print print)
        : grains(Role::grains, grains_channel),
          fluid(fluid_channel
                    ? std::optional<ParticipantLink>(std::in_place, Role::fluid, *fluid_channel)
                    : std::nullopt),
          links(fluid ? std::vector<ParticipantLink*>{&*fluid, &grains}
                      : std::vector<ParticipantLink*>{&grains}),
          watch(links, settings.stall_soft, settings.stall_hard, std::move(print)) {}
    Participants(const Participants&) = delete;
    Participants& operator=(const Participants&) = delete;

    ParticipantLink* fluid_or_null() { return fluid ? &*fluid : nullptr; }

    ParticipantLink grains;
    std::optional<ParticipantLink> fluid;  ///< none in dry runs
    std::vector<ParticipantLink*> links;   ///< all of them, the fluid first
    std::optional<Timeline> timeline;      ///< if the case asks for one
    Watch watch;
};

}  // namespace turbidite
