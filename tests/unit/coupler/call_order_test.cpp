// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/protocol/call_order.hpp"

namespace turbidite {
namespace {

constexpr bool from_coupler = true;

// Both ends of one conversation, driven along the table.
struct Ends {
    CallOrder coupler, participant;
    explicit Ends(Role role) : coupler(role, "participant"), participant(role, "coupler") {}

    Envelope pass(Kind kind) {
        const bool down = coupler.due().front().from_coupler;
        CallOrder& sender = down ? coupler : participant;
        CallOrder& receiver = down ? participant : coupler;
        const Envelope envelope = sender.next_sent(kind, down);
        receiver.received(envelope, down);
        return envelope;
    }

    void start(Role role, const std::string& scheme) {
        coupler.set_scheme(scheme);
        participant.set_scheme(scheme);
        for (const Step& step : start_order(role)) pass(step.kind);
    }
};

struct Table {
    Role role;
    const char* scheme;
    std::vector<Kind> window;
};

class EveryOrder : public testing::TestWithParam<Table> {};

TEST_P(EveryOrder, CountsWindowsOnBothSides) {
    const Table& table = GetParam();
    Ends ends(table.role);
    ends.start(table.role, table.scheme);
    for (int window = 0; window < 3; ++window)
        for (const Kind kind : table.window) EXPECT_EQ(ends.pass(kind).window, window);
    EXPECT_EQ(ends.coupler.due_text(), "\"window\"");
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, EveryOrder,
    testing::Values(
        Table{Role::fluid, "split", {Kind::window, Kind::constraint, Kind::kicks}},
        Table{Role::grains, "split", {Kind::window, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::fluid, "joint",
              {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::response, Kind::accept,
               Kind::kicks}},
        Table{Role::fluid, "joint",
              {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::response, Kind::constraint,
               Kind::response, Kind::accept, Kind::kicks}},
        Table{Role::grains, "joint",
              {Kind::window, Kind::contact_input, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::grains, "joint",
              {Kind::window, Kind::contact_input, Kind::motion, Kind::contact_input, Kind::motion,
               Kind::contact_input, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::grains, "dry", {Kind::window, Kind::kick, Kind::state}}));

// What stands before the rounds is iteration 0, a round and what follows it carry its number.
TEST(CallOrder, IterationCountsTheRoundsOfAWindow) {
    Ends fluid(Role::fluid), grains(Role::grains);
    fluid.start(Role::fluid, "joint");
    grains.start(Role::grains, "joint");
    for (int window = 0; window < 2; ++window) {
        for (const Kind kind : {Kind::window, Kind::bodies, Kind::response})
            EXPECT_EQ(fluid.pass(kind).iteration, 0);
        EXPECT_EQ(grains.pass(Kind::window).iteration, 0);
        for (int round = 1; round <= 3; ++round) {
            for (const Kind kind : {Kind::constraint, Kind::response})
                EXPECT_EQ(fluid.pass(kind).iteration, round);
            for (const Kind kind : {Kind::contact_input, Kind::motion})
                EXPECT_EQ(grains.pass(kind).iteration, round);
        }
        for (const Kind kind : {Kind::accept, Kind::kicks}) EXPECT_EQ(fluid.pass(kind).iteration, 3);
        for (const Kind kind : {Kind::kick, Kind::state}) EXPECT_EQ(grains.pass(kind).iteration, 3);
    }
}

TEST(CallOrder, AMessageOfAnotherRoundIsRefused) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "joint");
    for (const Kind kind : {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::response})
        ends.pass(kind);
    Envelope envelope = ends.coupler.next_sent(Kind::constraint, from_coupler);
    envelope.iteration = 1;
    try {
        ends.participant.received(envelope, from_coupler);
        FAIL();
    } catch (const OrderViolation& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("of window 0, round 1, expected number"), std::string::npos) << text;
        EXPECT_NE(text.find("of window 0, round 2"), std::string::npos) << text;
    }
}

// Between the two messages of a round nothing ends it; before the first round nothing skips it.
TEST(CallOrder, AcceptIsDueBehindARoundOnly) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "joint");
    for (const Kind kind : {Kind::window, Kind::bodies, Kind::response}) ends.pass(kind);
    EXPECT_EQ(ends.participant.due_text(), "\"constraint\"");
    EXPECT_THROW(ends.coupler.next_sent(Kind::accept, from_coupler), OrderViolation);
    ends.pass(Kind::constraint);
    EXPECT_EQ(ends.participant.due_text(), "\"response\"");
    EXPECT_THROW(ends.coupler.next_sent(Kind::accept, from_coupler), OrderViolation);
    ends.pass(Kind::response);
    EXPECT_EQ(ends.participant.due_text(), "\"accept\" or \"constraint\"");
    ends.pass(Kind::accept);
    EXPECT_EQ(ends.participant.due_text(), "\"kicks\"");
    EXPECT_THROW(ends.coupler.next_sent(Kind::constraint, from_coupler), OrderViolation);
    Ends grains(Role::grains);
    grains.start(Role::grains, "joint");
    for (const Kind kind : {Kind::window, Kind::contact_input, Kind::motion}) grains.pass(kind);
    EXPECT_EQ(grains.participant.due_text(), "\"kick\" or \"contact_input\"");
}

// Nothing repeats under split, so no round is counted and none can be told.
TEST(CallOrder, SplitHasNoRounds) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "split");
    for (const Kind kind : {Kind::window, Kind::constraint}) EXPECT_EQ(ends.pass(kind).iteration, 0);
    EXPECT_THROW(ends.coupler.next_sent(Kind::accept, from_coupler), OrderViolation);
    Envelope envelope = ends.participant.next_sent(Kind::kicks, !from_coupler);
    envelope.iteration = 1;
    EXPECT_THROW(ends.coupler.received(envelope, !from_coupler), OrderViolation);
}

TEST(CallOrder, AMessageOutOfTurnIsAnErrorWithASentence) {
    Ends ends(Role::grains);
    ends.start(Role::grains, "split");
    ends.pass(Kind::window);
    try {
        ends.participant.next_sent(Kind::state, !from_coupler);
        FAIL();
    } catch (const OrderViolation& error) {
        EXPECT_STREQ(error.what(),
                     "coupler: about to send \"state\" from the participant in window 0, but "
                     "\"motion\" from the participant is due");
    }
}

TEST(CallOrder, ALostMessageIsNoticedByItsNumber) {
    Ends ends(Role::grains);
    ends.start(Role::grains, "split");
    ends.pass(Kind::window);
    Envelope envelope = ends.participant.next_sent(Kind::motion, !from_coupler);
    ++envelope.sequence;
    EXPECT_THROW(ends.coupler.received(envelope, !from_coupler), OrderViolation);
}

TEST(CallOrder, AMessageOfAnotherWindowIsRefused) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "split");
    Envelope envelope = ends.coupler.next_sent(Kind::window, from_coupler);
    envelope.window = 5;
    EXPECT_THROW(ends.participant.received(envelope, from_coupler), OrderViolation);
}

TEST(CallOrder, BadNewsMayComeAtAnyTimeAndEndsTheTalk) {
    Ends ends(Role::grains);
    ends.start(Role::grains, "split");
    ends.pass(Kind::window);
    ends.coupler.received(ends.participant.next_sent(Kind::failure, !from_coupler), !from_coupler);
    ends.participant.received(ends.coupler.next_sent(Kind::dismiss, from_coupler), from_coupler);
    EXPECT_EQ(ends.participant.due_text(), "\"farewell\"");
    EXPECT_THROW(ends.participant.next_sent(Kind::motion, !from_coupler), OrderViolation);
    ends.coupler.received(ends.participant.next_sent(Kind::farewell, !from_coupler), !from_coupler);
    ends.participant.received(ends.coupler.next_sent(Kind::release, from_coupler), from_coupler);
}

TEST(CallOrder, UnknownSchemeIsNamed) {
    EXPECT_THROW(window_order(Role::fluid, "dry"), std::invalid_argument);
    EXPECT_THROW(window_order(Role::grains, "jiont"), std::invalid_argument);
}

}  // namespace
}  // namespace turbidite
