// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/hub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "coupler/hub/handshake.hpp"
#include "coupler/hub/schemes/exchanges.hpp"
#include "coupler/protocol/files/run_files.hpp"
#include "coupler/protocol/files/start_record.hpp"

namespace turbidite {
namespace {

// How long dismissed participants may take to write their output and leave [s]; a participant that
// is already silent is not waited for.
constexpr double farewell_limit = 30.0;
constexpr double farewell_limit_after_stall = 2.0;

// Followed by the wait-for table.
const std::string end_from_outside = "ended from outside; until then";

bool started_by_launcher() {
    return std::getenv("TURBIDITE_PROGRESS") != nullptr;
}

bool on_terminal() {
    return started_by_launcher() && std::getenv("TURBIDITE_PROGRESS") == std::string("terminal");
}

/// What every rank reported about itself; a rank that reported nothing is still identified.
std::vector<Hello> hellos(const std::vector<ParticipantLink*>& links) {
    std::vector<Hello> all;
    for (const ParticipantLink* link : links)
        for (int rank = 0; rank < link->ranks(); ++rank) {
            all.push_back(link->hello(rank));
            all.back().role = link->role();
            all.back().rank = rank;
        }
    return all;
}

Hello preliminary_hello(const StartRecord& record) {
    Hello hello;
    hello.adapter = std::filesystem::path(record.program).filename().string();
    hello.host = record.host;
    hello.pid = record.pid;
    hello.log_file = record.log;
    return hello;
}

}  // namespace

Hub::Hub(HubCase the_case, HubFiles files, Channel& grains, Channel* fluid,
         const SchemeEntry& scheme)
    : case_(std::move(the_case)),
      settings_(hub_settings(case_.settings)),
      files_(std::move(files)),
      progress_(files_.log, on_terminal(), settings_.run),
      participants_(grains, fluid, settings_,
                    [this](const std::string& text) { progress_.say(text); }),
      grain_rules_{std::nullopt, GrainRoster(case_.population),
                   KickRule(settings_.run, case_.shapes, case_.population),
                   MotionRule(case_.settings, case_.shapes, case_.population)},
      order_(scheme),
      scheme_(scheme.make(case_.settings)),
      ledger_(settings_, [this](const std::string& text) { progress_.say(text); }),
      output_(make_output()),
      requests_(files_.root),
      checkpoints_(case_.settings, settings_.run, files_.root, participants_.links,
                   participants_.watch, [this](const std::string& text) { progress_.say(text); }) {}

Hub::~Hub() = default;

RunOutput Hub::make_output() const {
    if (!case_.resumed) return {files_.history, files_.series, settings_.run, case_.shapes};
    OutputState earlier = case_.resumed->state.output;
    if (case_.resumed->state.windows == settings_.run.windows)
        earlier.lengths = earlier.lengths_at_end;
    return {files_.history, files_.series, settings_.run, case_.shapes, earlier};
}

/// One window, from t^n to t^{n+1}.
void Hub::play(const Window& window) {
    WindowResult result = scheme_->play(window, output_.state(), context());
    try {
        ledger_.check(window, result);
    } catch (const PhysicsRefused&) {
        output_.record_refused(result);
        throw;
    }
    // The largest Courant number before this window: a warning belongs to the window that exceeds
    // it.
    const auto fluid = output_.statistics().maxima.fluid;
    output_.record(window, std::move(result), participants_.watch.take_waited());
    if (fluid) warn_of_courant(fluid->courant);
}

/// Once in a run, where it crosses the limit; the end of the run tells the largest.
void Hub::warn_of_courant(double before) {
    const std::string sentence = first_large_courant(before, output_.statistics(), settings_.run);
    if (!sentence.empty()) progress_.say("turbidite: warning: " + sentence);
}

/// Output and checkpoint of a window.
void Hub::finish(const Window& window, bool out_of_turn, bool save_it) {
    if (window.write_output && out_of_turn) return finish_out_of_turn(window, save_it);
    if (window.write_output) write_output(window);
    if (save_it) save();
}

void Hub::save() {
    checkpoints_.write(output_.statistics().windows_done, [this] { return state(); });
}

/// A row out of turn, at the end of this part of the run, is no longer there once a next part plays
/// windows, whose history is to be that of a run in one part: the checkpoint has the lengths
/// without it, and those with it for the case that none is left.
void Hub::finish_out_of_turn(const Window& window, bool save_it) {
    if (!save_it) return write_output(window);
    CouplerState before;
    std::exception_ptr unknown;  // why it is, which must not cost the row
    try {
        before = state();
    } catch (const std::exception&) {
        unknown = std::current_exception();
    }
    const auto without_row = [&] {
        if (unknown) std::rethrow_exception(unknown);
        return before;
    };
    const std::int64_t windows = output_.statistics().windows_done;
    try {
        write_output(window);
    } catch (...) {
        // A row that cannot be written ends the run, but loses no checkpoint.
        checkpoints_.write(windows, without_row);
        throw;
    }
    checkpoints_.write(windows, [&] {
        CouplerState state = without_row();
        state.output.lengths_at_end = output_.lengths();
        return state;
    });
}

void Hub::write_output(const Window& window) {
    auto& timeline = participants_.timeline;
    enter(timeline ? &*timeline : nullptr, Timeline::Part::compute, "output", window.index);
    output_.write();
}

// A run that is asked to stop completes one more window and writes it, so that history, grains and
// fields end at the same time.
void Hub::play_windows() {
    const std::int64_t windows = settings_.run.windows;
    for (std::int64_t index = output_.statistics().windows_done; index < windows; ++index) {
        // Before the window: a request that comes during one is obeyed by the next.
        const Requests asked = requests_.take();
        const bool last = asked.stop || index + 1 == windows;
        // A row asked for by WRITE counts as in turn: it comes before the checkpoint and stays.
        const bool in_turn = (index + 1) % settings_.run.output_every == 0 || asked.write;
        const Window now = window(index, in_turn || last);
        play(now);
        const bool save = asked.checkpoint || asked.stop || checkpoints_.due(index + 1) ||
                          (last && checkpoints_.by_rule());
        finish(now, !in_turn, save);
        progress_.show(output_.row(), now.write_output);
        // One that was seen before the last window has no effect: the run is done.
        if (asked.stop && index + 1 < windows) throw Failure(*asked.stop, stopped_after(index + 1));
    }
}

std::string Hub::stopped_after(std::int64_t windows) const {
    const bool saved = checkpoints_.last() == windows;
    return fmt::format("stopped on request after window {}; its output{} written", windows,
                       saved ? " and a checkpoint are" : " is");
}

Window Hub::window(std::int64_t index, bool written) const {
    Window window;
    window.index = index;
    window.step = settings_.run.step;
    // n dt, not a sum of steps: a resumed run has the same times to the last digit.
    window.time = static_cast<double>(index) * window.step;
    window.write_output = written;
    return window;
}

CouplerState Hub::state() {
    CouplerState state;
    state.windows = output_.statistics().windows_done;
    state.wall_seconds = wall_clock_.seconds();
    state.ledger = ledger_.saved();
    state.owners.assign(grain_rules_.plan->owners().begin(), grain_rules_.plan->owners().end());
    state.output = output_.saved();
    return state;
}

SchemeContext Hub::context() {
    return {participants_.grains, participants_.fluid_or_null(), participants_.watch,
            *grain_rules_.plan,   grain_rules_.roster,           grain_rules_.kick,
            grain_rules_.motion};
}

RunStatus Hub::run() {
    try {
        start();
        play_windows();
    } catch (const EndedFromOutside&) {
        progress_.log(end_from_outside + ("\n" + wait_for_table()));
        throw;
    } catch (const Failure& failure) {
        status_.code = code_in_job(failure.code());
        status_.reason = failure.what();
    } catch (const std::exception& error) {
        status_.code = ExitCode::participant_failed;
        status_.reason = error.what();
    }
    status_.wall_seconds = wall_clock_.seconds();
    status_.checkpoints = {checkpoints_.written(), checkpoints_.seconds()};
    status_.statistics = output_.statistics();
    check_end();
    status_.warnings = run_warnings(status_.statistics, settings_.solves, settings_.run);
    for (const RunWarning& warning : status_.warnings)
        progress_.say("turbidite: warning: " + warning.text);
    end_and_record();
    return status_;
}

/// Whatever ended it, a run is done when all its windows are.
void Hub::check_end() {
    const std::int64_t windows = settings_.run.windows, done = status_.statistics.windows_done;
    if (status_.code != ExitCode::done || done == windows) return;
    status_.code = ExitCode::participant_failed;
    status_.reason = fmt::format("{}{}only {} of {} windows are done", status_.reason,
                                 status_.reason.empty() ? "" : ": ", done, windows);
}

// The record is written first, so that the outcome is known even if a participant does not leave. A
// record that cannot be written must not keep the participants from leaving.
void Hub::end_and_record() {
    try {
        write_run_record(files_.record, status_, hellos(participants_.links));
    } catch (const std::exception& error) {
        if (status_.code == ExitCode::done) status_.code = ExitCode::participant_failed;
        status_.reason += (status_.reason.empty() ? "" : "; ") + std::string(error.what());
    }
    try {
        end({static_cast<int>(status_.code), status_.reason});
    } catch (const Failure& failure) {
        if (status_.code ==
            ExitCode::done) {  // all windows are done, but the farewells are missing
            status_.code = failure.code();
            status_.reason = failure.what();
            write_run_record(files_.record, status_, hellos(participants_.links));
        }
        throw;
    }
}

void Hub::start() {
    if (case_.settings.has("output.timeline") && case_.settings.flag("output.timeline"))
        // In front of the first wait, so that the handshake is in the timeline too.
        participants_.watch.set_timeline(
            &participants_.timeline.emplace(files_.root, Role::coupler, 0));
    participants_.watch.leave_table(wait_table_file(files_.root));
    name_by_start_records();
    // All mismatches of all programs are refused here, before any of them gets its settings.
    shake_hands(participants_.links, case_.settings, case_.shapes, order_, participants_.watch);
    ParticipantLink* const fluid = participants_.fluid_or_null();
    ledger_.name_programs(participants_.grains.program(), fluid ? fluid->program() : "");
    tell_participants();
    std::vector<Box> boxes;
    if (fluid) {
        participants_.watch.wait_for(*fluid, Kind::domain);
        // Where each fluid rank must know the grains: needed to route the first ones.
        boxes = fluid->take<Box>(Kind::domain);
        const Arrival arrival(*fluid, Kind::domain, -1);
        for (int rank = 0; rank < fluid->ranks(); ++rank) arrival.check(rank, boxes[rank]);
    }
    grain_rules_.plan.emplace(std::move(boxes), settings_.run.period);
    checkpoints_.meet_participants();
    SchemeContext scheme_context = context();
    const Capabilities& can = participants_.grains.hello(0).capabilities;
    grain_rules_.motion.expect_substeps(can.native_substeps);
    // Grains that get the fluid's inertia may move with the velocities of their contacts. Under a
    // scheme that repeats windows they get responses too, but must move with the kicks:
    // needs_inertia() is false.
    grain_rules_.motion.expect_responses(
        expectation(Role::grains, case_.settings, case_.shapes, order_).effective_inertia);
    // Also where a run goes on: all programs begin with the case's grains and are restored
    // afterwards.
    Motion initial = receive_start(scheme_context);
    if (case_.resumed)
        go_on_from(*case_.resumed);
    else
        begin_output(std::move(initial));
    // What the start took belongs to no window.
    output_.begin_windows();
    participants_.watch.take_waited();
}

// So that a participant which never sends its hello has a host and a log all the same.
void Hub::name_by_start_records() {
    for (ParticipantLink* link : participants_.links)
        for (int rank = 0; rank < link->ranks(); ++rank)
            if (const auto record = read_start_record(files_.root, link->role(), rank))
                link->set_hello(rank, preliminary_hello(*record));
}

void Hub::begin_output(Motion initial) {
    output_.begin(std::move(initial));
    if (checkpoints_.by_rule()) save();
}

void Hub::go_on_from(const Resumption& earlier) {
    const std::vector<Motion> shares = shares_of(earlier.state, participants_.grains.ranks());
    // The participants first: one that cannot take its state ends the run before the coupler has.
    checkpoints_.restore(earlier.name);
    // Without the grains that left before the checkpoint, which the population still has.
    grain_rules_.roster.resume(shares);
    grain_rules_.plan->gather(shares);
    ledger_.resume(earlier.state.ledger);
    wall_clock_.go_on_after(earlier.state.wall_seconds);
    progress_.begin_at(earlier.state.windows);
    progress_.say(fmt::format("resumed after window {} from {}", earlier.state.windows,
                              CheckpointSets::folder(earlier.name)));
}

void Hub::tell_participants() {
    for (ParticipantLink* link : participants_.links) {
        const Order& order = order_.order(link->role());
        // The coupler's end, checked like the participant's own.
        link->set_window_order(order);
        for (const Hello& hello : hellos({link}))
            progress_.say(fmt::format("{:<14} {} in {} (host {}, pid {})",
                                      link->rank_name(hello.rank), hello.adapter, hello.host_code,
                                      hello.host, hello.pid));
        link->send_all(Kind::settings, case_.settings);
        link->send_all(Kind::order, order);
        link->send_all(Kind::shapes, case_.shapes);
    }
    participants_.grains.send_each(Kind::population,
                                   shares_of(case_.population, participants_.grains.ranks()));
}

void Hub::end(const Verdict& verdict) {
    if (!verdict.reason.empty()) report_end("turbidite: " + verdict.reason);
    // Three rounds: no process may reach MPI_Finalize before all of them have written their output
    // and said farewell, else mpirun hangs or crashes when one of them has to be aborted
    // (docs/decisions/job.md).
    for (ParticipantLink* link : participants_.links) link->dismiss(verdict);
    const double limit =
        status_.code == ExitCode::stalled ? farewell_limit_after_stall : farewell_limit;
    await_all(&ParticipantLink::gone, limit);
    for (ParticipantLink* link : participants_.links) link->release();
    // `release` must have left this process before it goes on to MPI_Finalize itself.
    await_all(&ParticipantLink::flushed, limit);
}

// `turbidite run` prints the reason itself, below everything else.
void Hub::report_end(const std::string& text) {
    if (started_by_launcher())
        progress_.log(text);
    else
        progress_.say(text);
}

void Hub::await_all(bool (ParticipantLink::*condition)(), double limit) {
    Patience patience;
    for (bool waiting = true; waiting; patience.wait()) {
        waiting = false;
        // The condition is asked of every link, since asking is what takes its frames in.
        for (ParticipantLink* link : participants_.links)
            waiting = !(link->*condition)() || waiting;
        if (waiting && patience.seconds() > limit)
            throw Failure(
                status_.code == ExitCode::done ? ExitCode::stalled : status_.code,
                "a participant did not end in time; aborting the job\n" + wait_for_table());
    }
}

}  // namespace turbidite
