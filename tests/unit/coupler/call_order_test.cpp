// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/hub/schemes/scheme.hpp"
#include "coupler/protocol/call_order.hpp"

namespace turbidite {
namespace {

// Both ends of one connection, driven through the table.
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
        const Order order = find_scheme(scheme).order(role);
        coupler.set_window_order(order);
        participant.set_window_order(decode<Order>(encode(order)));  // as it is sent
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

TEST_P(EveryOrder, LetsTheCouplerAskForACheckpointBetweenWindowsOnly) {
    const Table& table = GetParam();
    Ends ends(table.role);
    ends.start(table.role, table.scheme);
    ends.pass(Kind::restore);
    EXPECT_EQ(ends.coupler.due_text(), "\"restored\"");
    EXPECT_THROW(ends.coupler.next_sent(Kind::window, from_coupler), OrderViolation);
    ends.pass(Kind::restored);
    for (CallOrder* end : {&ends.coupler, &ends.participant}) end->go_on_after(7);
    EXPECT_EQ(ends.pass(Kind::window).window, 7);
    EXPECT_THROW(ends.coupler.next_sent(Kind::save, from_coupler), OrderViolation);
    for (std::size_t i = 1; i < table.window.size(); ++i) ends.pass(table.window[i]);
    ends.pass(Kind::save);
    EXPECT_TRUE(ends.participant.is_due(Kind::saved, to_coupler));
    ends.pass(Kind::saved);
    EXPECT_EQ(ends.pass(Kind::window).window, 8);
}

INSTANTIATE_TEST_SUITE_P(
    Schemes, EveryOrder,
    testing::Values(
        Table{Role::fluid, "split", {Kind::window, Kind::constraint, Kind::accept, Kind::kicks}},
        Table{Role::grains, "split", {Kind::window, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::fluid,
              "joint",
              {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::response,
               Kind::accept, Kind::kicks}},
        Table{Role::fluid,
              "joint",
              {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::response,
               Kind::constraint, Kind::response, Kind::accept, Kind::kicks}},
        Table{Role::grains,
              "joint",
              {Kind::window, Kind::contact_input, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::grains,
              "joint",
              {Kind::window, Kind::contact_input, Kind::motion, Kind::contact_input, Kind::motion,
               Kind::contact_input, Kind::motion, Kind::kick, Kind::state}},
        Table{Role::grains, "dry", {Kind::window, Kind::kick, Kind::state}}));

// What precedes the rounds is iteration 0; a round and what follows it carry its number.
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
        for (const Kind kind : {Kind::accept, Kind::kicks})
            EXPECT_EQ(fluid.pass(kind).iteration, 3);
        for (const Kind kind : {Kind::kick, Kind::state}) EXPECT_EQ(grains.pass(kind).iteration, 3);
    }
}

TEST(CallOrder, AMessageOfAnotherRoundIsRefused) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "joint");
    for (const Kind kind :
         {Kind::window, Kind::bodies, Kind::response, Kind::constraint, Kind::response})
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

// A round cannot end between its two messages, and the first round cannot be skipped.
TEST(CallOrder, AcceptIsAllowedOnlyAfterARound) {
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

// Under split nothing is repeated, so no round is counted.
TEST(CallOrder, SplitHasNoRounds) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "split");
    for (const Kind kind : {Kind::window, Kind::constraint})
        EXPECT_EQ(ends.pass(kind).iteration, 0);
    EXPECT_THROW(ends.coupler.next_sent(Kind::constraint, from_coupler), OrderViolation);
    ends.pass(Kind::accept);
    Envelope envelope = ends.participant.next_sent(Kind::kicks, to_coupler);
    envelope.iteration = 1;
    EXPECT_THROW(ends.coupler.received(envelope, to_coupler), OrderViolation);
}

TEST(CallOrder, AMessageOutOfTurnIsAnErrorWithASentence) {
    Ends ends(Role::grains);
    ends.start(Role::grains, "split");
    ends.pass(Kind::window);
    try {
        ends.participant.next_sent(Kind::state, to_coupler);
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
    Envelope envelope = ends.participant.next_sent(Kind::motion, to_coupler);
    ++envelope.sequence;
    EXPECT_THROW(ends.coupler.received(envelope, to_coupler), OrderViolation);
}

TEST(CallOrder, AMessageOfAnotherWindowIsRefused) {
    Ends ends(Role::fluid);
    ends.start(Role::fluid, "split");
    Envelope envelope = ends.coupler.next_sent(Kind::window, from_coupler);
    envelope.window = 5;
    EXPECT_THROW(ends.participant.received(envelope, from_coupler), OrderViolation);
}

TEST(CallOrder, FailureOrDismissalMayComeAtAnyTimeAndEndsTheExchange) {
    Ends ends(Role::grains);
    ends.start(Role::grains, "split");
    ends.pass(Kind::window);
    ends.coupler.received(ends.participant.next_sent(Kind::failure, to_coupler), to_coupler);
    ends.participant.received(ends.coupler.next_sent(Kind::dismiss, from_coupler), from_coupler);
    EXPECT_EQ(ends.participant.due_text(), "\"farewell\"");
    EXPECT_THROW(ends.participant.next_sent(Kind::motion, to_coupler), OrderViolation);
    ends.coupler.received(ends.participant.next_sent(Kind::farewell, to_coupler), to_coupler);
    ends.participant.received(ends.coupler.next_sent(Kind::release, from_coupler), from_coupler);
}

TEST(CallOrder, TheStartNeedsTheOrderOfAWindow) {
    CallOrder order(Role::fluid, "coupler");
    order.next_sent(Kind::hello, to_coupler);
    std::int64_t sequence = 0;
    for (const Kind kind : {Kind::settings, Kind::order, Kind::shapes})
        order.received({kind, -1, 0, sequence++}, from_coupler);
    EXPECT_THROW(order.next_sent(Kind::domain, to_coupler), OrderViolation);
}

// A participant that receives an invalid order reports it at the start, not in the middle of a
// window.
TEST(CallOrder, AnOrderThatCannotBePlayedIsRefused) {
    const auto why = [](const Order& order) -> std::string {
        try {
            CallOrder(Role::fluid, "coupler").set_window_order(order);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    const Step window{Kind::window, from_coupler}, kicks{Kind::kicks, to_coupler};
    EXPECT_EQ(why({window, kicks}), "");
    EXPECT_NE(why({}).find("does not begin with \"window\""), std::string::npos);
    EXPECT_NE(why({kicks}).find("does not begin with \"window\""), std::string::npos);
    EXPECT_NE(why({window, window, kicks}).find("\"window\" twice"), std::string::npos);
    EXPECT_NE(why({window, {Kind::hello, to_coupler}})
                  .find("\"hello\", which is not a message of a window"),
              std::string::npos);
    EXPECT_NE(why({window, {static_cast<Kind>(77), to_coupler}}).find("kind 77"),
              std::string::npos);
    EXPECT_NE(why({window, {Kind::response, to_coupler, Times::per_round}, kicks})
                  .find("only the coupler decides"),
              std::string::npos);
    EXPECT_NE(
        why({window, {Kind::constraint, from_coupler, Times::per_round}, kicks}).find("\"kicks\""),
        std::string::npos);
    EXPECT_NE(
        why({window, {Kind::constraint, from_coupler, Times::per_round}}).find("ends with a round"),
        std::string::npos);
}

TEST(Schemes, AnUnknownOneListsTheKnown) {
    try {
        find_scheme("jiont");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(),
                     "unknown scheme \"jiont\"; known: split, joint, sub-iterated, dry");
    }
}

TEST(Schemes, EveryOrderCanBePlayed) {
    for (const SchemeEntry& scheme : scheme_list()) {
        EXPECT_NO_THROW(check_window_order(scheme.grains)) << scheme.name;
        if (!scheme.fluid.empty()) {
            EXPECT_NO_THROW(check_window_order(scheme.fluid)) << scheme.name;
        }
    }
}

// The slip tolerance is well below the allowed difference between contacts and fluid, if that is
// checked.
TEST(Schemes, TheSlipToleranceIsTheSmallerOfTwo) {
    Settings settings;
    settings.set("fluid.multiplier_tolerance", 1e-4);
    settings.set("coupling.tolerance", 1e-5);
    EXPECT_EQ(find_scheme("split").slip_tolerance(settings), 1e-4);
    EXPECT_EQ(find_scheme("joint").slip_tolerance(settings), 0.1 * 1e-5);
    settings.set("coupling.tolerance", 1.0);
    EXPECT_EQ(find_scheme("joint").slip_tolerance(settings), 1e-4);
}

}  // namespace
}  // namespace turbidite
