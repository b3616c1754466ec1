// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Calls of a session in a wrong order, as a host code with its own loop may make them: an exception
// names the missing call, and nothing waits.
#include "coupler/participant/session.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

std::string complaint(const std::function<void()>& call) {
    try {
        call();
    } catch (const std::logic_error& error) {
        return error.what();
    }
    return "";
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class SessionCalls : public testing::Test {
 protected:
    decltype(LoopbackChannel::connect(1)) wires = LoopbackChannel::connect(1);
    ScriptedGrains adapter{"scripted"};
    std::unique_ptr<Session> session =
        make_session(adapter, *wires.second[0], {0, 1, "a.log", "0123456789abcdef"});
};

TEST_F(SessionCalls, StepNeedsStart) {
    EXPECT_SAYS(complaint([&] { session->step(); }), "call start() once, first");
}

TEST_F(SessionCalls, TheOutcomeNeedsAnEnd) {
    EXPECT_SAYS(complaint([&] { session->outcome(); }), "call step() until it returns false");
}

// A whole dry run; then everything but the outcome is too late.
TEST_F(SessionCalls, StartComesOnceAndNothingComesAfterTheEnd) {
    const TestFolder folder("session-calls");
    const Settings settings = test_settings("split", false);
    std::thread coupler([&] {
        Hub hub({settings, {{"disc", {}}}, test_population()}, folder.files(), *wires.first,
                nullptr, find_scheme("dry"));
        EXPECT_EQ(hub.run().code, ExitCode::done);
    });
    bool going = session->start();
    EXPECT_SAYS(complaint([&] { session->start(); }), "start() was called a second time");
    while (going) going = session->step();
    coupler.join();
    EXPECT_SAYS(complaint([&] { session->step(); }), "after the end of the run");
    EXPECT_EQ(session->outcome().code, ExitCode::done);
}

}  // namespace
}  // namespace turbidite
