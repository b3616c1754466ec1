// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/hub.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include "coupler/hub/domain.hpp"
#include "coupler/hub/handshake.hpp"

namespace turbidite {
namespace {

using Clock = std::chrono::steady_clock;

// How long dismissed participants may take to write their last words [s]; one that is silent
// already gets no second chance.
constexpr double farewell_limit = 30.0;
constexpr double farewell_limit_after_stall = 2.0;

// A fluid rank must know every grain that decides about a point or a cell of its own. A cell of its
// own may be in the stencil of a surface point up to 1.5 cells outside its box (rule 6 of
// multiplier/collocation_points.hpp), and whether that point is kept depends on grains that come
// within one point spacing of it, at most 4 cells (rules 2 and 3): 5.5, and some to spare.
constexpr double stencil_cells = 7.0;

double since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

bool on_terminal() {
    const char* wish = std::getenv("TURBIDITE_PROGRESS");
    return wish != nullptr && std::string(wish) == "terminal";
}

std::string scheme_name(const Settings& settings) {
    return settings.flag("fluid.enabled") ? settings.text("coupling.scheme") : "dry";
}

double routing_margin(const Settings& settings) {
    return stencil_cells * settings.real("run.diameter") /
           settings.real("fluid.cells_per_diameter");
}

}  // namespace

Hub::Hub(HubCase the_case, HubFiles files, Channel& grains, Channel* fluid)
    : case_(std::move(the_case)),
      files_(std::move(files)),
      progress_(files_.log, on_terminal(), case_.settings.integer("run.windows")),
      grains_(Role::grains, grains),
      fluid_(fluid ? std::optional<ParticipantLink>(std::in_place, Role::fluid, *fluid)
                   : std::nullopt),
      links_(fluid_ ? std::vector<ParticipantLink*>{&*fluid_, &grains_}
                    : std::vector<ParticipantLink*>{&grains_}),
      watch_(links_, case_.settings.real("limits.stall_soft"),
             case_.settings.real("limits.stall_hard"),
             [this](const std::string& text) { progress_.say(text); }),
      kick_rule_(case_.settings, case_.shapes),
      scheme_(make_scheme(scheme_name(case_.settings), case_.settings)),
      ledger_(case_.settings, case_.population.size()),
      history_(files_.history, case_.settings, kick_rule_),
      grain_series_(files_.series, case_.shapes),
      contact_series_(files_.series) {}

Hub::~Hub() = default;

RunStatus Hub::run() {
    const auto begin = Clock::now();
    try {
        start();
        for (std::int64_t index = 0; index < case_.settings.integer("run.windows"); ++index)
            play(index);
    } catch (const Failure& failure) {
        status_.code = failure.code();
        status_.reason = failure.what();
    } catch (const std::exception& error) {
        status_.code = ExitCode::participant_failed;
        status_.reason = error.what();
    }
    status_.wall_seconds = since(begin);
    tell_unconverged();
    tell_disagreement();
    end_and_record();
    return status_;
}

void Hub::tell_unconverged() {
    const std::int64_t windows = status_.maxima.unconverged_windows;
    if (windows == 0) return;
    progress_.say(
        fmt::format("turbidite: in {} of {} windows the contact solver used up its {} sweeps "
                    "(contact.iterations) before contact.tolerance = {}; residual up to {:.1e}. "
                    "Allow more sweeps.",
                    windows, status_.windows_done, case_.settings.text("contact.iterations"),
                    case_.settings.text("contact.tolerance"), status_.contact_residuals.largest()));
}

void Hub::tell_disagreement() {
    const auto& joint = status_.maxima.joint;
    if (!joint || joint->unconverged_windows == 0) return;
    progress_.say(fmt::format(
        "turbidite: in {} of {} windows contacts and fluid differ by more than coupling.tolerance "
        "= {} u_c after coupling.iterations = {} rounds, at most by {:.1e} u_c. Allow more rounds.",
        joint->unconverged_windows, status_.windows_done, case_.settings.text("coupling.tolerance"),
        case_.settings.text("coupling.iterations"), joint->mismatch));
}

// The record comes first: should a participant not leave, the verdict is known all the same. One
// that cannot be written must not keep the participants from leaving.
void Hub::end_and_record() {
    try {
        write_run_record(files_.record, status_, links_);
    } catch (const std::exception& error) {
        if (status_.code == ExitCode::done) status_.code = ExitCode::participant_failed;
        status_.reason += (status_.reason.empty() ? "" : "; ") + std::string(error.what());
    }
    try {
        end({static_cast<int>(status_.code), status_.reason});
    } catch (const Failure& failure) {
        if (status_.code ==
            ExitCode::done) {  // all windows are played, but the last words are lost
            status_.code = failure.code();
            status_.reason = failure.what();
            write_run_record(files_.record, status_, links_);
        }
        throw;
    }
}

void Hub::start() {
    shake_hands(links_, case_.settings, case_.shapes, watch_);
    for (ParticipantLink* link : links_) {
        link->set_scheme(scheme_name(case_.settings));
        for (int rank = 0; rank < link->ranks(); ++rank) {
            const Hello& hello = link->hello(rank);
            progress_.say(fmt::format("{:<14} {} in {} (host {}, pid {})", link->rank_name(rank),
                                      hello.adapter, hello.host_code, hello.host, hello.pid));
        }
        link->send_all(Kind::settings, case_.settings);
        link->send_all(Kind::shapes, case_.shapes);
    }
    grains_.send_each(Kind::population, shares_of(case_.population, grains_.ranks()));

    std::vector<Box> boxes;
    if (fluid_) {
        watch_.wait_for(*fluid_, Kind::domain);
        boxes = fluid_->take<Box>(Kind::domain);
    }
    plan_.emplace(std::move(boxes), routing_margin(case_.settings), domain_periods(case_.settings));
    watch_.wait_for(grains_, Kind::state);
    state_ = plan_->gather(grains_.take<Motion>(Kind::state));
    ledger_.check_start(state_);
    Row row;
    row.state = &state_;
    history_.append(row);
    grain_series_.write(0.0, 0, 1.0, state_, {});
}

Window Hub::window(std::int64_t index) const {
    const std::int64_t windows = case_.settings.integer("run.windows");
    const std::int64_t every = case_.settings.integer("run.output_every");
    Window window;
    window.index = index;
    window.step = case_.settings.real("run.step");
    window.time = static_cast<double>(index) * window.step;
    window.write_output = (index + 1) % every == 0 || index + 1 == windows;
    return window;
}

// A run that is asked to stop plays one more window and writes it, so that history, grains and
// fields end together.
void Hub::play(std::int64_t index) {
    const std::optional<ExitCode> stop = requested_stop();
    window_start_ = Clock::now();
    Window now = window(index);
    now.write_output = now.write_output || stop;
    Cast cast{grains_, fluid_ ? &*fluid_ : nullptr, watch_, *plan_, kick_rule_};
    WindowResult result = scheme_->play(now, state_, cast);
    ledger_.check(now, result);
    account(now, std::move(result));
    if (stop && status_.windows_done < case_.settings.integer("run.windows"))
        throw Failure(*stop, fmt::format("stopped on request after window {}, which is written",
                                         status_.windows_done));
}

void Hub::account(const Window& window, WindowResult result) {
    RunMaxima& maxima = status_.maxima;
    const FluidReport& fluid = result.kicks.report;
    const double length = case_.settings.real("run.diameter");
    const double balance =
        kick_rule_.defect(result.kicks.kicks, state_, result.motion, window.step);
    maxima.penetration = std::max(maxima.penetration, result.state.report.max_penetration / length);
    maxima.grain_balance = std::max(maxima.grain_balance, balance);
    maxima.fluid_balance = std::max(maxima.fluid_balance, fluid.momentum_defect);
    maxima.divergence = std::max(
        maxima.divergence, fluid.divergence * length / case_.settings.real("run.velocity_scale"));
    maxima.unconverged_windows += result.motion.report.converged ? 0 : 1;
    status_.contact_residuals.take_in(result.motion.report);
    if (result.joint) maxima.take_in(*result.joint, case_.settings.real("run.velocity_scale"));

    state_ = std::move(result.state);
    status_.windows_done = window.index + 1;
    Row row;
    row.step = window.index + 1;
    row.time = static_cast<double>(row.step) * window.step;
    row.state = &state_;
    row.contact = &result.motion.report;
    row.fluid = fluid_ ? &fluid : nullptr;
    row.joint = result.joint ? &*result.joint : nullptr;
    if (fluid_) row.grain_balance = balance;
    if (window.write_output) {
        grain_series_.write(row.time, row.step, window.step, state_, result.kicks.kicks);
        contact_series_.write(row.time, row.step, window.step, state_);
    }

    WallTimes spent;
    spent.step = since(window_start_);
    spent.fluid = fluid.wall_seconds;
    spent.grains = result.motion.report.wall_seconds + state_.report.wall_seconds;
    spent.coupling = std::max(0.0, spent.step - watch_.take_waited());
    since_row_.take_in(spent, result.motion.report.converged);
    if (window.write_output) {
        row.since = since_row_;
        history_.append(row);
        since_row_ = {};
    }
    progress_.show(row, case_.settings, window.write_output);
}

std::optional<ExitCode> Hub::requested_stop() const {
    int code = static_cast<int>(ExitCode::interrupted);
    {
        std::ifstream stop(files_.stop);
        if (!stop) return std::nullopt;
        stop >> code;
    }
    std::error_code ignored;  // a request is meant once: the same line may be started again
    std::filesystem::remove(files_.stop, ignored);
    const bool terminated = code == static_cast<int>(ExitCode::terminated);
    return terminated ? ExitCode::terminated : ExitCode::interrupted;
}

void Hub::end(const Verdict& verdict) {
    if (!verdict.reason.empty()) progress_.say("turbidite: " + verdict.reason);
    for (ParticipantLink* link : links_) link->dismiss(verdict);
    const double limit =
        status_.code == ExitCode::stalled ? farewell_limit_after_stall : farewell_limit;
    await_all(&ParticipantLink::gone, limit);
    for (ParticipantLink* link : links_) link->release();
    await_all(&ParticipantLink::flushed, limit);
}

void Hub::await_all(bool (ParticipantLink::*condition)(), double limit) {
    Patience patience;
    for (bool waiting = true; waiting; patience.wait()) {
        waiting = false;
        for (ParticipantLink* link : links_) waiting = !(link->*condition)() || waiting;
        if (waiting && patience.seconds() > limit)
            throw Failure(
                status_.code == ExitCode::done ? ExitCode::stalled : status_.code,
                "a participant does not say farewell; ending the job\n" + wait_for_table());
    }
}

}  // namespace turbidite
