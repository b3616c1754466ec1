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
        const bool down = coupler.due_from_coupler();
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
    EXPECT_EQ(ends.coupler.due(), Kind::window);
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, EveryOrder,
    testing::Values(
        Table{Role::fluid, "split", {Kind::window, Kind::constraint, Kind::kicks}},
        Table{Role::grains, "split", {Kind::window, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::fluid, "joint",
              {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::kicks}},
        Table{Role::grains, "joint",
              {Kind::window, Kind::contact_input, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::grains, "dry", {Kind::window, Kind::kick, Kind::state}}));

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
    EXPECT_EQ(ends.participant.due(), Kind::farewell);
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
