// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's run: handshake, windows, end. Knows no host code and no MPI; tests give it loopback
// channels.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "coupler/hub/ledger.hpp"
#include "coupler/output/contact_series.hpp"
#include "coupler/output/grain_series.hpp"
#include "coupler/output/progress.hpp"
#include "coupler/output/run_record.hpp"

namespace turbidite {

/// What the hub needs of a resolved case.
struct HubCase {
    Settings settings;
    ShapeTable shapes;
    std::vector<GrainState> population;
};

/// Where the hub writes; names are those of the run folder.
struct HubFiles {
    std::filesystem::path history, series, log, record, stop;
};

class Hub {
 public:
    /// `fluid` is null in dry runs. Channels outlive the hub.
    Hub(HubCase settings, HubFiles files, Channel& grains, Channel* fluid);
    ~Hub();

    /// Plays the whole run. Returns what it also wrote into the run record.
    RunStatus run();

    /// Who works and who waits, one line per rank.
    std::string wait_for_table() const { return watch_.wait_for_table(); }

 private:
    void start();
    void play(std::int64_t index);
    void account(const Window& window, WindowResult result);
    void tell_unconverged();
    void tell_disagreement();
    void end_and_record();
    /// The code to end with when files_.stop is there, which is then removed.
    std::optional<ExitCode> requested_stop() const;
    void end(const Verdict& verdict);
    void await_all(bool (ParticipantLink::*condition)(), double limit);
    Window window(std::int64_t index) const;

    HubCase case_;
    HubFiles files_;
    Progress progress_;
    ParticipantLink grains_;
    std::optional<ParticipantLink> fluid_;
    std::vector<ParticipantLink*> links_;
    Watch watch_;
    std::optional<ExchangePlan> plan_;
    KickRule kick_rule_;
    std::unique_ptr<Scheme> scheme_;
    Ledger ledger_;
    History history_;
    GrainSeries grain_series_;
    ContactSeries contact_series_;
    Motion state_;
    SinceRow since_row_;
    RunStatus status_;
    std::chrono::steady_clock::time_point window_start_;
};

}  // namespace turbidite
