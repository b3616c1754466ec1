// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The coupler's run: handshake, windows, end. Independent of host codes and MPI; tests use loopback
// channels.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>

#include "coupler/hub/checkpoints.hpp"
#include "coupler/hub/checks/ledger.hpp"
#include "coupler/hub/hub_settings.hpp"
#include "coupler/hub/participants.hpp"
#include "coupler/hub/requests.hpp"
#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/output/progress.hpp"
#include "coupler/output/run_output.hpp"
#include "coupler/output/run_record.hpp"

namespace turbidite {

/// The checkpoint from which a run goes on.
struct Resumption {
    std::string name;  ///< of its folder in `checkpoints`
    CouplerState state;
};

/// What the hub needs from a resolved case.
struct HubCase {
    Settings settings;
    ShapeTable shapes;
    std::vector<GrainState> population;
    std::optional<Resumption> resumed = {};
};

/// Where the hub writes; the names are those of the run folder, `root`.
struct HubFiles {
    std::filesystem::path history, series, log, record, root;
};

class Hub {
 public:
    /// `fluid` is null in dry runs. `scheme` is find_scheme(run.scheme), or one that is not in the
    /// list.
    Hub(HubCase settings, HubFiles files, Channel& grains, Channel* fluid,
        const SchemeEntry& scheme);
    ~Hub();

    /// Executes the whole run. Returns what it also wrote into the run record. Throws
    /// EndedFromOutside, see end_on.
    RunStatus run();

    /// When `signal` is not 0, `run` writes the wait-for table to its log, and throws: mpirun ends
    /// the job since another program has died, and the table says in which window and phase.
    void end_on(const volatile std::sig_atomic_t& signal) { participants_.watch.end_on(signal); }

    /// When `signal` is not 0, the next window is the last one, and a checkpoint follows.
    void stop_on(const volatile std::sig_atomic_t& signal) { requests_.stop_on(signal); }

    /// Who works and who waits, one line per rank.
    std::string wait_for_table() const { return participants_.watch.wait_for_table(); }

 private:
    /// Who has which grain, and what messages about them have to say.
    struct GrainRules {
        std::optional<ExchangePlan> plan;  ///< once the fluid has told its boxes
        GrainRoster roster;
        KickRule kick;
        MotionRule motion;
    };

    /// Of the whole run, the parts before this one included.
    class WallClock {
     public:
        void go_on_after(double seconds) { earlier_ = seconds; }
        double seconds() const {
            return earlier_ + std::chrono::duration<double>(Clock::now() - begin_).count();
        }

     private:
        using Clock = std::chrono::steady_clock;
        Clock::time_point begin_ = Clock::now();
        double earlier_ = 0.0;
    };

    void start();
    void name_by_start_records();
    void begin_output(Motion initial);
    void go_on_from(const Resumption& earlier);
    void play_windows();
    void play(const Window& window);
    void warn_of_courant(double before);
    void finish(const Window& window, bool out_of_turn, bool save);
    void save();
    void finish_out_of_turn(const Window& window, bool save_it);
    void write_output(const Window& window);
    Window window(std::int64_t index, bool written) const;
    CouplerState state();
    std::string stopped_after(std::int64_t windows) const;
    RunOutput make_output() const;
    SchemeContext context();

    void tell_participants();
    void check_end();
    void end_and_record();
    void end(const Verdict& verdict);
    void report_end(const std::string& text);
    void await_all(bool (ParticipantLink::*condition)(), double limit);

    HubCase case_;
    HubSettings settings_;
    HubFiles files_;
    Progress progress_;
    Participants participants_;
    GrainRules grain_rules_;
    SchemeEntry order_;
    std::unique_ptr<Scheme> scheme_;
    Ledger ledger_;
    RunOutput output_;
    RequestFiles requests_;
    Checkpoints checkpoints_;
    WallClock wall_clock_;
    RunStatus status_;
};

}  // namespace turbidite
