// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's run: handshake, windows, end. Independent of host codes and MPI; tests use loopback
// channels.
#pragma once

#include <filesystem>
#include <optional>

#include "coupler/hub/hub_settings.hpp"
#include "coupler/hub/ledger.hpp"
#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/output/progress.hpp"
#include "coupler/output/run_output.hpp"
#include "coupler/output/run_record.hpp"

namespace turbidite {

/// What the hub needs from a resolved case.
struct HubCase {
    Settings settings;
    ShapeTable shapes;
    std::vector<GrainState> population;
};

/// Where the hub writes; the names are those of the run folder.
struct HubFiles {
    std::filesystem::path history, series, log, record, stop;
};

class Hub {
 public:
    /// `fluid` is null in dry runs. `scheme` is find_scheme(run.scheme), or one that is not in the
    /// list.
    Hub(HubCase settings, HubFiles files, Channel& grains, Channel* fluid,
        const SchemeEntry& scheme);
    ~Hub();

    /// Executes the whole run. Returns what it also wrote into the run record. Throws
    /// EndedFromOutside, see heed.
    RunStatus run();

    /// When `signal` is not 0, `run` writes the wait-for table to its log, and throws: mpirun ends
    /// the job since another program has died, and the table says in which window and phase.
    void heed(const volatile std::sig_atomic_t& signal) { watch_.heed(signal); }

    /// Who works and who waits, one line per rank.
    std::string wait_for_table() const { return watch_.wait_for_table(); }

 private:
    void start();
    void play_windows();
    void play(const Window& window);
    Window window(std::int64_t index, bool last) const;
    Cast cast();

    void tell_participants();
    void end_and_record();
    void end(const Verdict& verdict);
    void report_end(const std::string& text);
    void await_all(bool (ParticipantLink::*condition)(), double limit);
    /// The exit code to end with if files_.stop exists, which is then removed.
    std::optional<ExitCode> requested_stop() const;

    HubCase case_;
    HubSettings settings_;
    HubFiles files_;
    Progress progress_;
    ParticipantLink grains_;
    std::optional<ParticipantLink> fluid_;
    std::vector<ParticipantLink*> links_;
    Watch watch_;
    std::optional<ExchangePlan> plan_;
    GrainRoster roster_;
    KickRule kick_rule_;
    SchemeEntry order_;
    std::unique_ptr<Scheme> scheme_;
    Ledger ledger_;
    RunOutput output_;
    RunStatus status_;
};

}  // namespace turbidite
