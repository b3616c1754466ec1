// SPDX-License-Identifier: LGPL-2.1-or-later
//
// careless grains RUN, careless fluid -case RUN/fluid: a participant that speaks the protocol
// without the participant library, and takes every message as it comes: neither order nor numbers
// are checked.
#include <string>

#include "coupler/participant/scripted.hpp"
#include "coupler/protocol/call_order.hpp"
#include "coupler/transport/intercomm_channel.hpp"
#include "coupler/transport/world.hpp"

namespace {

using namespace turbidite;

class Careless {
 public:
    explicit Careless(Channel& channel) : channel_(channel) {}

    Message receive() {
        for (Patience patience;; patience.wait())
            if (auto arrived = channel_.try_receive()) return unframe(arrived->bytes);
    }

    /// In the place of the message that it answers.
    void send(Kind kind, const Envelope& place, Bytes payload) {
        channel_.send(0, frame({{kind, place.window, place.iteration, sent_++}, payload}));
    }

    void say_hello(Hello hello, Role role) {
        hello.role = role;
        hello.host = "here";
        send(Kind::hello, {}, encode(hello));
    }

    /// Returns false after the release.
    bool ends(const Message& message) {
        if (message.envelope.kind == Kind::dismiss) send(Kind::farewell, message.envelope, {});
        return message.envelope.kind == Kind::release;
    }

 private:
    Channel& channel_;
    std::int64_t sent_ = 0;
};

void play_grains(Careless& talk) {
    ScriptedGrains grains("careless");
    talk.say_hello(grains.describe(), Role::grains);
    Settings settings;
    ShapeTable shapes;
    Window window;
    for (Message message = talk.receive(); !talk.ends(message); message = talk.receive()) {
        const Envelope& at = message.envelope;
        if (at.kind == Kind::settings) settings = decode<Settings>(message.payload);
        if (at.kind == Kind::shapes) shapes = decode<ShapeTable>(message.payload);
        if (at.kind == Kind::population)
            talk.send(Kind::state, at,
                      encode(grains.initialise(settings, shapes,
                                               decode<Motion>(message.payload).grains)));
        if (at.kind == Kind::window) {
            window = decode<Window>(message.payload);
            talk.send(Kind::motion, at, encode(grains.advance(window, {})));
        }
        if (at.kind == Kind::kick)
            talk.send(Kind::state, at,
                      encode(grains.apply_kick(window, decode<Kicks>(message.payload).kicks)));
        if (at.kind == Kind::save) talk.send(Kind::saved, at, encode(SavedPart{{}, "never"}));
    }
}

void play_fluid(Careless& talk) {
    ScriptedFluid fluid(0.3);
    talk.say_hello(fluid.describe(), Role::fluid);
    Settings settings;
    Window window;
    for (Message message = talk.receive(); !talk.ends(message); message = talk.receive()) {
        const Envelope& at = message.envelope;
        if (at.kind == Kind::settings) settings = decode<Settings>(message.payload);
        if (at.kind == Kind::shapes)
            talk.send(Kind::domain, at,
                      encode(fluid.initialise(settings, decode<ShapeTable>(message.payload))));
        if (at.kind == Kind::window) fluid.advance(window = decode<Window>(message.payload));
        if (at.kind == Kind::constraint)
            fluid.correct(window, decode<Motion>(message.payload).grains);
        if (at.kind == Kind::accept) talk.send(Kind::kicks, at, encode(fluid.impose(window)));
        if (at.kind == Kind::save) talk.send(Kind::saved, at, encode(SavedPart{{}, "never"}));
    }
}

}  // namespace

int main(int argc, char** argv) {
    MpiEnvironment mpi(&argc, &argv);
    const Role role = std::string(argv[1]) == "grains" ? Role::grains : Role::fluid;
    IntercommChannel channel(join_coupler(split_world(role), role));
    Careless talk(channel);
    role == Role::grains ? play_grains(talk) : play_fluid(talk);
    return 0;
}
