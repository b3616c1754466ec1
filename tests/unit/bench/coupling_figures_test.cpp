// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What is computed from the moments at which messages passed, and from the columns of a run.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/coupling/coupling_figures.hpp"
#include "bench/coupling/stamped_channel.hpp"
#include "coupler/protocol/failure.hpp"
#include "coupler/transport/loopback_channel.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite::bench {
namespace {

Stamp received(Kind kind, std::int64_t window, double end, std::int64_t bytes = 0) {
    return {kind, window, false, end, end, bytes};
}
Stamp sent(Kind kind, std::int64_t window, double begin, double end) {
    return {kind, window, true, begin, end, 0};
}

// Two ranks send, two are sent to: from the last arrival, 3.0 s, to the end of the last send, 3.75.
TEST(Delays, InsideTheCouplerFromTheLastArrivalToTheLastSend) {
    const std::vector<Stamp> hub{received(Kind::motion, 4, 2.0), received(Kind::motion, 4, 3.0),
                                 sent(Kind::constraint, 4, 3.125, 3.25),
                                 sent(Kind::constraint, 4, 3.5, 3.75),
                                 received(Kind::kicks, 4, 9.0)};
    EXPECT_EQ(delays(hub, Kind::motion, hub, Kind::constraint, 0), std::vector<double>{0.75});
}

// From program to program: from the begin of the first send, 1.0, to the last arrival, 3.5.
TEST(Delays, BetweenProgramsFromTheFirstSendToTheLastArrival) {
    const std::vector<Stamp> grains{sent(Kind::motion, 4, 1.0, 1.5),
                                    sent(Kind::motion, 4, 2.0, 2.5)};
    const std::vector<Stamp> fluid{received(Kind::constraint, 4, 3.0),
                                   received(Kind::constraint, 4, 3.5)};
    EXPECT_EQ(delays(grains, Kind::motion, fluid, Kind::constraint, 0), std::vector<double>{2.5});
}

TEST(Delays, OneValueForEachWindowThatBothHaveFromTheFirstAskedForOn) {
    std::vector<Stamp> hub;
    for (const int window : {0, 1, 2, 3}) hub.push_back(received(Kind::motion, window, window));
    for (const int window : {0, 1, 3})
        hub.push_back(sent(Kind::constraint, window, window, window + 0.25 * window));
    EXPECT_EQ(delays(hub, Kind::motion, hub, Kind::constraint, 1),
              (std::vector<double>{0.25, 0.75}));
}

TEST(Stamps, SurviveTheirFile) {
    const ScratchFolder scratch;
    write_stamps({sent(Kind::kick, 7, 1.0, 2.0), received(Kind::state, 7, 3.0, 512)},
                 scratch.path() / "a.stamps");
    const std::vector<Stamp> back = read_stamps(scratch.path() / "a.stamps");
    ASSERT_EQ(back.size(), 2u);
    EXPECT_EQ(back[0].kind, Kind::kick);
    EXPECT_TRUE(back[0].sent);
    EXPECT_EQ(back[0].end, 2.0);
    EXPECT_EQ(bytes_of(back, Kind::state, 7), 512);
    EXPECT_THROW(read_stamps(scratch.path() / "missing.stamps"), Failure);
    EXPECT_THROW(read_stamps(scratch.write("broken.stamps", "13 1 0 0.5 rubbish")), Failure);
}

TEST(StampedChannel, NotesKindWindowLengthAndDirectionOfWhatPasses) {
    auto [hub, ends] = LoopbackChannel::connect(1);
    std::vector<Stamp> stamps;
    StampedChannel channel(*hub, stamps);
    const Bytes frame_sent = framed(Envelope{Kind::window, 5}, Window{});
    channel.send(0, frame_sent);
    ends[0]->send(0, framed(Envelope{Kind::motion, 6}, Motion{}));
    ASSERT_TRUE(channel.try_receive());
    EXPECT_FALSE(channel.try_receive());
    ASSERT_EQ(stamps.size(), 2u);
    EXPECT_EQ(stamps[0].kind, Kind::window);
    EXPECT_EQ(stamps[0].window, 5);
    EXPECT_TRUE(stamps[0].sent);
    EXPECT_EQ(stamps[0].bytes, static_cast<std::int64_t>(frame_sent.size()));
    EXPECT_EQ(stamps[1].kind, Kind::motion);
    EXPECT_FALSE(stamps[1].sent);
    EXPECT_LE(stamps[0].end, stamps[1].end);
}

// Rows are means over the windows since the row before: 10 windows of 1 s with 0.9 s of work, then
// 30 of 2 s with 1.9 s; the first row, at t = 0, has no times.
// By hand,
// after 0: 1 - (10 * 0.9 + 30 * 1.9) / (10 + 60) = 4/70; after 1 t_c: 0.1/2.
TEST(CouplingShare, IsWhatNeitherSideUsesWeightedByWindows) {
    const RunHistory history{{"time", {0.0, 1.0, 4.0}},        {"step", {0.0, 10.0, 40.0}},
                             {"wall_step", {NAN, 1.0, 2.0}},   {"wall_fluid", {NAN, 0.5, 1.5}},
                             {"wall_grains", {NAN, 0.4, 0.4}}, {"joint_rounds", {NAN, 1.0, 1.0}}};
    EXPECT_NEAR(coupling_share(history, 0.0), 4.0 / 70.0, 1e-12);
    EXPECT_NEAR(coupling_share(history, 1.0), 0.05, 1e-12);
}

TEST(CouplingShare, IsRefusedWhereTheProgramsWorkAtTheSameTime) {
    EXPECT_THROW(coupling_share({{"time", {0.0}}, {"step", {0.0}}}, 0.0), Failure);
}

}  // namespace
}  // namespace turbidite::bench
