// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/participant/session.hpp"

#include <unistd.h>

#include <utility>

#include "coupler/participant/conversation.hpp"

namespace turbidite {

struct Session::Talk {
    Talk(Role role, Channel& channel, Identity who)
        : conversation(role, channel), identity(std::move(who)) {}

    Conversation conversation;
    Identity identity;
    Outcome outcome;
    std::string scheme;
};

Session::Session() = default;
Session::~Session() = default;

const Outcome& Session::outcome() const {
    return talk_->outcome;
}

template <class Action>
bool Session::guarded(Action action) {
    Conversation& conversation = talk_->conversation;
    Verdict verdict;
    try {
        action();
        return true;
    } catch (const Dismissed& dismissed) {
        verdict = dismissed.verdict;
    } catch (const CouplerSilent&) {
        throw;
    } catch (const Failure& failure) {
        verdict = conversation.fail({static_cast<int>(failure.code()), failure.what()});
    } catch (const std::exception& error) {
        verdict = conversation.fail({static_cast<int>(ExitCode::participant_failed), error.what()});
    }
    talk_->outcome = {static_cast<ExitCode>(verdict.exit_code), verdict.reason};
    conversation.say_farewell();
    return false;
}

bool Session::start() {
    return guarded([this] { begin(); });
}

bool Session::step() {
    return guarded([this] { play_window(); });
}

namespace {

std::string host_name() {
    char name[256] = {};
    gethostname(name, sizeof name - 1);
    return name;
}

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

// The coupler notices a stall first and says who; a participant gives up only if the coupler itself
// is gone.
constexpr double margin_over_coupler = 1.5;

template <class Adapter>
class RoleSession : public Session {
 protected:
    RoleSession(Role role, Adapter& adapter, Channel& channel, const Identity& identity)
        : adapter_(adapter), role_(role) {
        talk_ = std::make_unique<Talk>(role, channel, identity);
    }

    Settings shake_hands() {
        Conversation& talk = talk_->conversation;
        talk.send(Kind::hello, encode(complete(adapter_.describe(), role_, talk_->identity)));
        Settings settings = decode<Settings>(talk.receive(Kind::settings));
        talk_->scheme = settings.flag("fluid.enabled") ? settings.text("coupling.scheme") : "dry";
        talk.set_scheme(talk_->scheme);
        talk.set_limit(margin_over_coupler * settings.real("limits.stall_hard"));
        return settings;
    }

    template <class Record>
    Record receive(Kind kind) {
        return decode<Record>(talk_->conversation.receive(kind));
    }

    template <class Record>
    void send(Kind kind, const Record& record) {
        talk_->conversation.send(kind, encode(record));
    }

    Adapter& adapter_;

 private:
    Role role_;
};

class GrainsSession final : public RoleSession<GrainsAdapter> {
 public:
    GrainsSession(GrainsAdapter& adapter, Channel& channel, const Identity& identity)
        : RoleSession(Role::grains, adapter, channel, identity) {}

 private:
    void begin() override {
        const Settings settings = shake_hands();
        const auto shapes = receive<ShapeTable>(Kind::shapes);
        const auto share = receive<Motion>(Kind::population);
        send(Kind::state, adapter_.initialise(settings, shapes, share.grains));
    }

    void play_window() override {
        const auto window = receive<Window>(Kind::window);
        if (talk_->scheme == "joint") return play_rounds(window);
        const Motion motion = adapter_.advance(window, {});
        if (talk_->scheme != "dry") send(Kind::motion, motion);
        const auto kicks = receive<Kicks>(Kind::kick);
        Motion state = adapter_.apply_kick(window, kicks.kicks);
        if (talk_->scheme == "dry")  // the window's only report
            state.report.wall_seconds += motion.report.wall_seconds;
        send(Kind::state, state);
    }

    void play_rounds(const Window& window) {
        Message message = talk_->conversation.receive();
        for (; message.envelope.kind == Kind::contact_input;
             message = talk_->conversation.receive()) {
            const auto responses = decode<std::vector<FreeResponse>>(message.payload);
            send(Kind::motion, adapter_.advance(window, responses));
        }
        const auto kicks = decode<Kicks>(message.payload);
        send(Kind::state, adapter_.apply_kick(window, kicks.kicks));
    }
};

class FluidSession final : public RoleSession<FluidAdapter> {
 public:
    FluidSession(FluidAdapter& adapter, Channel& channel, const Identity& identity)
        : RoleSession(Role::fluid, adapter, channel, identity) {}

 private:
    void begin() override {
        const Settings settings = shake_hands();
        const auto shapes = receive<ShapeTable>(Kind::shapes);
        send(Kind::domain, adapter_.initialise(settings, shapes));
    }

    void play_window() override {
        const auto window = receive<Window>(Kind::window);
        adapter_.advance(window);
        const Motion motion =
            talk_->scheme == "joint" ? play_rounds(window) : receive<Motion>(Kind::constraint);
        send(Kind::kicks, adapter_.impose(window, motion.grains));
    }

    /// Returns the constraint that the coupler accepted.
    Motion play_rounds(const Window& window) {
        const auto bodies = receive<Motion>(Kind::bodies);
        send(Kind::response, adapter_.respond(window, bodies.grains));
        Motion motion;
        for (Message message = talk_->conversation.receive();
             message.envelope.kind == Kind::constraint; message = talk_->conversation.receive()) {
            motion = decode<Motion>(message.payload);
            send(Kind::response, adapter_.correct(window, motion.grains));
        }
        return motion;
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
