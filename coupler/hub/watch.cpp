// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "coupler/protocol/failure.hpp"

namespace turbidite {
Watch::Watch(std::vector<ParticipantLink*> links, double soft, double hard, Print print)
    : links_(std::move(links)), soft_(soft), hard_(hard), print_(std::move(print)) {}

void Watch::leave_table(const std::filesystem::path& file) {
    table_ = std::make_unique<KeptLines>(file);
}

void Watch::keep_table() {
    if (!table_) return;
    std::size_t first = 0;
    for (ParticipantLink* link : links_) {
        // Only what has changed: a line costs a call of the system, and there may be many ranks.
        for (const int rank : link->take_changed())
            table_->set(first + static_cast<std::size_t>(rank), "  " + link->state_of(rank));
        first += static_cast<std::size_t>(link->ranks());
    }
}

void Watch::wait_for(ParticipantLink& link, Kind kind) {
    double next_notice = soft_;
    const bool fluid = link.role() == Role::fluid;
    enter(timeline_, Timeline::Part::wait, fluid ? "wait for the fluid" : "wait for the grains",
          link.window());
    Patience patience;
    // Frames are looked for before every look at the clock, so that what has come is never called
    // late.
    for (;; patience.wait(any_in_transit())) {
        if (signal_ && *signal_) throw EndedFromOutside{};
        // Of all participants, not only the one that is waited for: its partner's failure ends the
        // wait.
        for (ParticipantLink* other : links_) other->pump();
        keep_table();
        if (link.ready(kind)) break;
        if (patience.seconds() > hard_)
            throw Failure(ExitCode::stalled,
                          fmt::format("stalled: no \"{}\" from {} for {:.0f} s\n{}",
                                      kind_name(kind), link.silent(kind), hard_, wait_for_table()));
        if (patience.seconds() > next_notice) {
            print_(fmt::format("still waiting for \"{}\" from {} after {:.0f} s\n{}",
                               kind_name(kind), role_name(link.role()), patience.seconds(),
                               wait_for_table()));
            // soft, 2 soft, 4 soft, ...: a long stall does not fill the log.
            next_notice *= 2.0;
        }
    }
    waited_ += patience.seconds();
    enter(timeline_, Timeline::Part::compute, "check and route", link.window());
}

bool Watch::any_in_transit() const {
    return std::any_of(links_.begin(), links_.end(),
                       [](const ParticipantLink* link) { return link->in_transit(); });
}

std::string Watch::wait_for_table() const {
    std::string table;
    for (const ParticipantLink* link : links_)
        for (int rank = 0; rank < link->ranks(); ++rank)
            table += (table.empty() ? "  " : "\n  ") + link->state_of(rank);
    return table;
}

double Watch::take_waited() {
    return std::exchange(waited_, 0.0);
}

}  // namespace turbidite
