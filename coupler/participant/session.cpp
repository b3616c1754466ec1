// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/session.hpp"

#include <unistd.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <utility>

#include "coupler/participant/conversation.hpp"
#include "coupler/protocol/host_name.hpp"

namespace turbidite {

struct Session::Talk {
    Talk(Role role, Channel& channel, Identity who)
        : conversation(role, channel), identity(std::move(who)) {}

    Conversation conversation;
    Identity identity;
    std::optional<Timeline> timeline;
    Outcome outcome;
    std::function<std::string()> other_exception = [] { return "an exception of unknown type"; };
};

Session::Session() = default;
Session::~Session() = default;

const Outcome& Session::outcome() const {
    if (phase_ != Phase::over)
        throw std::logic_error(
            "outcome() was called while the run goes on: call step() until it returns false");
    return talk_->outcome;
}

void Session::explain_other_exceptions(std::function<std::string()> text) {
    talk_->other_exception = std::move(text);
}

template <class Action>
bool Session::guarded(Action action) {
    Conversation& conversation = talk_->conversation;
    Verdict verdict;
    try {
        action();
        return true;
    } catch (const Dismissed& dismissed) {
        // The coupler has ended the run, whatever this side was doing. Nothing to report.
        verdict = dismissed.verdict;
        // Nobody is there to hear of a failure: the caller aborts the job.
    } catch (const CouplerSilent&) {
        throw;
    } catch (const Failure& failure) {
        // Bad input is what the launcher says before a job: within one the program has failed.
        verdict =
            conversation.fail({static_cast<int>(code_in_job(failure.code())), failure.what()});
    } catch (const std::exception& error) {
        verdict = conversation.fail({static_cast<int>(ExitCode::participant_failed), error.what()});
    } catch (...) {
        verdict = conversation.fail(
            {static_cast<int>(ExitCode::participant_failed), talk_->other_exception()});
    }
    phase_ = Phase::over;
    talk_->outcome = {static_cast<ExitCode>(verdict.exit_code), verdict.reason};
    // Also after a failure: the process leaves when all others may (docs/decisions/job.md).
    conversation.say_farewell();
    return false;
}

bool Session::start() {
    if (phase_ != Phase::made)
        throw std::logic_error("start() was called a second time: call it once, then step()");
    // Before begin(): one that fails has had its start.
    phase_ = Phase::started;
    return guarded([this] { begin(); });
}

namespace {

bool between_windows(const FramedMessage& message) {
    return message.envelope.kind == Kind::save || message.envelope.kind == Kind::restore;
}

}  // namespace

bool Session::step() {
    if (phase_ == Phase::made)
        throw std::logic_error("step() was called before start(): call start() once, first");
    if (phase_ == Phase::over)
        throw std::logic_error(
            "step() was called after the end of the run: stop when start() or step() returns "
            "false");
    return guarded([this] {
        // Saves and restores come before `window`; from then on to the last message of the window.
        // A host with its own loop gets the control back exactly between two windows.
        for (bool within = false; !within || talk_->conversation.inside_window();) {
            const FramedMessage message = talk_->conversation.receive();
            within = !between_windows(message);
            if (within)
                take(message);
            else
                checkpoint(message);
        }
        // The host is not inside MPI until the next step: a long last frame would not move.
        talk_->conversation.flush_sent();
    });
}

namespace {

Hello complete(Hello hello, Role role, const Identity& identity) {
    hello.role = role;
    hello.rank = identity.rank;
    hello.ranks = identity.ranks;
    hello.host = host_name();
    hello.pid = getpid();
    hello.log_file = identity.log_file;
    hello.case_hash = identity.case_hash;
    return hello;
}

// The coupler notices a stall first and reports who is silent; a participant gives up only if the
// coupler itself is gone. Between two messages to it the coupler may wait for the other side twice
// (`joint`: grains hear nothing while the fluid answers with its responses and then with its
// kicks), for up to limits.stall_hard each time.
constexpr double margin_over_coupler = 2.5;

template <class Adapter>
class RoleSession : public Session {
 protected:
    RoleSession(Role role, Adapter& adapter, Channel& channel, const Identity& identity)
        : adapter_(adapter), role_(role) {
        talk_ = std::make_unique<Talk>(role, channel, identity);
    }

    Settings shake_hands() {
        Conversation& talk = talk_->conversation;
        talk.send(Kind::hello, complete(adapter_.describe(), role_, talk_->identity));
        // Only after the coupler has found every program of the job compatible.
        Settings settings = decode<Settings>(talk.receive(Kind::settings).payload());
        // From here on both ends check every message against the same list.
        talk.set_window_order(decode<Order>(talk.receive(Kind::order).payload()));
        talk.set_limit(margin_over_coupler * settings.real("limits.stall_hard"));
        if (settings.has("output.timeline") && settings.flag("output.timeline"))
            talk.set_timeline(
                &talk_->timeline.emplace(talk_->identity.run_folder, role_, talk_->identity.rank));
        return settings;
    }

    void checkpoint(const FramedMessage& message) override {
        if (message.envelope.kind == Kind::save)
            return send(Kind::saved, saved(decode<CheckpointPlace>(message.payload())));
        const auto order = decode<RestoreOrder>(message.payload());
        restore(order);
        talk_->conversation.send(Kind::restored);
        // After the answer, which still belongs to "before the first window".
        talk_->conversation.go_on_after(order.windows);
    }

    template <class Record>
    Record receive(Kind kind) {
        return decode<Record>(talk_->conversation.receive(kind).payload());
    }

    template <class Record>
    void send(Kind kind, const Record& record) {
        talk_->conversation.send(kind, record);
    }

    /// A call of the adapter, noted in the timeline.
    template <class Call>
    auto compute(const char* what, Call call) {
        const std::int64_t window = talk_->conversation.window();
        Timeline* timeline = talk_->timeline ? &*talk_->timeline : nullptr;
        enter(timeline, Timeline::Part::compute, what, window);
        // At the end of the call, also of one that throws.
        struct AtEnd {
            Timeline* timeline;
            std::int64_t window;
            ~AtEnd() { enter(timeline, Timeline::Part::transfer, "send", window); }
        } at_end{timeline, window};
        return call();
    }

    bool due(Kind kind) const { return talk_->conversation.due_from_here(kind); }

    /// A message in the order that this library cannot handle.
    [[noreturn]] void refuse(Kind kind) const {
        throw OrderViolation(std::string("the ") + role_name(role_) +
                             " library of protocol version " + std::to_string(protocol_major) +
                             "." + std::to_string(protocol_minor) + " cannot follow \"" +
                             kind_name(kind) + "\"");
    }

    Adapter& adapter_;
    Window window_;  ///< the present one

 private:
    std::filesystem::path in_run_folder(const std::string& folder) const {
        return std::filesystem::path(talk_->identity.run_folder) / folder;
    }

    std::string file_name() const {
        return std::string(role_name(role_)) + ".rank" + std::to_string(talk_->identity.rank);
    }

    /// A state that cannot be saved does not end the run, only this checkpoint.
    SavedPart saved(const CheckpointPlace& place) const {
        try {
            PieceWriter file(in_run_folder(place.folder), file_name());
            save_to(adapter_, file);
            return {file.finish(), ""};
        } catch (const std::exception& error) {
            return {{file_name()}, error.what()};
        } catch (...) {
            return {{file_name()}, talk_->other_exception()};
        }
    }

    void restore(const RestoreOrder& order) {
        const auto folder = in_run_folder(order.folder);
        const Identity& own = talk_->identity;
        // The usual case: this rank's own file. With another number of ranks every rank looks at
        // all files and takes its part.
        if (order.parts.size() == static_cast<std::size_t>(own.ranks)) {
            PieceReader file(folder, order.parts[own.rank]);
            return restore_own(adapter_, file);
        }
        std::vector<PieceReader> files;
        for (const StoredFile& part : order.parts) files.emplace_back(folder, part);
        restore_parts(adapter_, files);
    }

    static void save_to(const FluidAdapter& fluid, PieceWriter& file) { fluid.save_to(file); }
    static void restore_own(FluidAdapter& fluid, PieceReader& file) { fluid.restore_own(file); }
    static void restore_parts(FluidAdapter& fluid, std::vector<PieceReader>& files) {
        fluid.restore_parts(files);
    }

    // The state of grains is small.

    static void save_to(const GrainsAdapter& grains, PieceWriter& file) {
        const SavedState state = grains.save();
        file.write(state.data(), state.size());
    }
    static void restore_own(GrainsAdapter& grains, PieceReader& file) {
        grains.restore(file.all());
    }
    static void restore_parts(GrainsAdapter& grains, std::vector<PieceReader>& files) {
        std::vector<SavedState> states;
        for (PieceReader& file : files) states.push_back(file.all());
        grains.restore_from(states);
    }

    Role role_;
};

using Responses = std::vector<FreeResponse>;

class GrainsSession final : public RoleSession<GrainsAdapter> {
 public:
    GrainsSession(GrainsAdapter& adapter, Channel& channel, const Identity& identity)
        : RoleSession(Role::grains, adapter, channel, identity) {}

 private:
    void begin() override {
        const Settings settings = shake_hands();
        const auto shapes = receive<ShapeTable>(Kind::shapes);
        const auto share = receive<Motion>(Kind::population);
        send(Kind::state, compute("initialise", [&] {
                 if (const std::optional<Abilities> able = adapter_.abilities())
                     refuse_case(beyond(*able, settings, share.grains));
                 return adapter_.initialise(settings, shapes, share.grains);
             }));
    }

    static void refuse_case(const std::string& reason) {
        if (!reason.empty())
            throw std::runtime_error("the program cannot play this case: " + reason);
    }

    void take(const FramedMessage& message) override {
        switch (message.envelope.kind) {
            case Kind::window:
                window_ = decode<Window>(message.payload());
                solved_ = false;
                // `split`: contacts are solved at once, without the fluid. Under `joint` and
                // `sub-iterated` a contact_input comes first.
                if (due(Kind::motion)) send(Kind::motion, solve({}));
                return;
            case Kind::contact_input:
                return send(Kind::motion, solve(decode<Responses>(message.payload())));
            case Kind::kick:
                return send(Kind::state, move(decode<Kicks>(message.payload())));
            default:
                refuse(message.envelope.kind);
        }
    }

    Motion solve(const Responses& responses) {
        solved_ = true;
        return compute("advance", [&] { return adapter_.advance(window_, responses); });
    }

    /// If the order requests no motion (`dry`), the state is the only report of the window.
    Motion move(const Kicks& kicks) {
        // The time of a solve whose motion is never sent goes into the state.
        const double unreported = solved_ ? 0.0 : solve({}).report.wall_seconds;
        Motion state =
            compute("apply_kick", [&] { return adapter_.apply_kick(window_, kicks.kicks); });
        state.report.wall_seconds += unreported;
        return state;
    }

    bool solved_ = false;  ///< contacts have been solved in the present window
};

class FluidSession final : public RoleSession<FluidAdapter> {
 public:
    FluidSession(FluidAdapter& adapter, Channel& channel, const Identity& identity)
        : RoleSession(Role::fluid, adapter, channel, identity) {}

 private:
    void begin() override {
        const Settings settings = shake_hands();
        const auto shapes = receive<ShapeTable>(Kind::shapes);
        send(Kind::domain,
             compute("initialise", [&] { return adapter_.initialise(settings, shapes); }));
    }

    void take(const FramedMessage& message) override {
        switch (message.envelope.kind) {
            case Kind::window:
                window_ = decode<Window>(message.payload());
                // Steps 1 to 3 (Topin 2011), under `split` beside the contacts of the same window.
                return compute("advance", [&] { adapter_.advance(window_); });
            case Kind::bodies: {
                const Motion bodies = decode<Motion>(message.payload());
                compute("let_fall", [&] { adapter_.let_fall(window_, bodies.grains); });
                return respond_if_due();
            }
            case Kind::constraint: {
                const Motion solved = decode<Motion>(message.payload());
                compute("correct", [&] { adapter_.correct(window_, solved.grains); });
                return respond_if_due();
            }
            case Kind::accept:
                return send(Kind::kicks,
                            compute("impose", [&] { return adapter_.impose(window_); }));
            default:
                refuse(message.envelope.kind);
        }
    }

    void respond_if_due() {
        if (due(Kind::response))
            send(Kind::response, compute("respond", [&] { return adapter_.respond(); }));
    }
};

}  // namespace

std::unique_ptr<Session> make_session(GrainsAdapter& adapter, Channel& channel,
                                      const Identity& identity) {
    return std::make_unique<GrainsSession>(adapter, channel, identity);
}

std::unique_ptr<Session> make_session(FluidAdapter& adapter, Channel& channel,
                                      const Identity& identity) {
    return std::make_unique<FluidSession>(adapter, channel, identity);
}

}  // namespace turbidite
