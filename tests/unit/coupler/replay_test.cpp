// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Recordings of whole jobs, and one participant against them.
#include "coupler/replay/replay.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>

#include "coupler/protocol/message.hpp"
#include "coupler/replay/record_numbers.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

/// A recorded job whose grains meet a floor, on two ranks each, under `joint`.
class Replayed : public testing::Test {
 protected:
    Replayed() : folder("replay") {
        job.settings = test_settings("joint");
        job.floor = 4.4995;
        job.grains_ranks = job.fluid_ranks = 2;
        job.recordings = folder.path();
        job.run(folder);
    }

    std::filesystem::path file(const char* role) const {
        return folder.path() / (std::string(role) + ".frames");
    }

    /// The grains again, with a floor at this height and ranks that begin with `fault`.
    ReplayReport grains_again(double floor, int ranks = 2, Fault fault = {}) {
        auto [coupler, ends] = LoopbackChannel::connect(ranks);
        std::vector<std::thread> threads;
        for (int rank = 0; rank < ranks; ++rank)
            threads.emplace_back([&, rank, end = ends[rank].get()] {
                ScriptedGrains adapter("scripted", fault);
                adapter.lay_floor(floor);
                live(*make_session(adapter, *end, {rank, ranks, "b.log", job.hash}));
            });
        return joined(threads, [&, end = coupler.get()] { return play("grains", *end); });
    }

    ReplayReport fluid_again(double drag_now) {
        auto [coupler, ends] = LoopbackChannel::connect(2);
        std::vector<std::thread> threads;
        for (int rank = 0; rank < 2; ++rank)
            threads.emplace_back([&, rank, end = ends[rank].get()] {
                ScriptedFluid adapter(drag_now, rank, 2);
                live(*make_session(adapter, *end, {rank, 2, "b.log", job.hash}));
            });
        return joined(threads, [&, end = coupler.get()] { return play("fluid", *end); });
    }

    TestFolder folder;
    Job job;

 private:
    ReplayReport play(const char* role, Channel& channel) const {
        Recording recording(file(role));
        ReplayOrder order;
        order.limit = 10.0;
        return replay(recording, channel, order);
    }

    template <class Play>
    static ReplayReport joined(std::vector<std::thread>& threads, Play play) {
        std::optional<ReplayReport> report;
        std::exception_ptr failure;
        try {
            report = play();
        } catch (...) {
            failure = std::current_exception();
        }
        for (std::thread& thread : threads) thread.join();
        if (failure) std::rethrow_exception(failure);
        return *report;
    }

    static void live(Session& session) {
        for (bool going = session.start(); going; going = session.step()) {
        }
    }
};

TEST_F(Replayed, ParticipantsAnswerWhatTheyAnsweredThen) {
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const auto windows = job.settings.integer("run.windows");
    for (const ReplayReport& report : {grains_again(4.4995), fluid_again(drag)}) {
        EXPECT_EQ(report.windows, windows);
        EXPECT_GT(report.messages, 4 * windows);  // two or more a window, from two ranks
        EXPECT_EQ(report.differences, 0) << report.first.front();
        EXPECT_TRUE(report.complete);
    }
}

// The floor of the replay is lower: grains fall on where they had been held.
TEST_F(Replayed, WhatDiffersIsNamed) {
    const ReplayReport grains = grains_again(4.49);
    EXPECT_GT(grains.differences, 0);
    EXPECT_LT(grains.differences, grains.messages);  // before they land nothing differs
    EXPECT_GT(grains.largest, 1e-6);
    ASSERT_FALSE(grains.first.empty());
    EXPECT_NE(grains.first.front().find("\"motion\" of window"), std::string::npos);
    EXPECT_NE(grains.first.front().find("grain 10"), std::string::npos) << grains.first.front();
    EXPECT_NE(grains.first.front().find("instead of"), std::string::npos);

    const ReplayReport fluid = fluid_again(1.1 * drag);
    EXPECT_GT(fluid.differences, 0);
    EXPECT_NE(fluid.first.front().find("response of grain 10"), std::string::npos)
        << fluid.first.front();
}

/// The numbers of all tables of a message, NaN as -1.
std::vector<double> numbers(Kind kind, Bytes payload) {
    std::vector<double> all;
    for (const NumberTable& table : numbers_of({{kind, 0, 0, 0}, std::move(payload)}))
        for (const double number : table.numbers) all.push_back(std::isnan(number) ? -1.0 : number);
    return all;
}

/// What changes one number of a record must change one that is compared.
template <class Record>
struct Change {
    const char* what;
    void (*make)(Record&);
};

TEST(RecordNumbers, EveryNumberOfAContactIsCompared) {
    const Change<ContactRecord> changes[] = {
        {"a", [](ContactRecord& c) { c.a = 5; }},
        {"b", [](ContactRecord& c) { c.b = 5; }},
        {"wall", [](ContactRecord& c) { c.wall = 2; }},
        {"feature", [](ContactRecord& c) { c.feature = 1; }},
        {"status", [](ContactRecord& c) { c.status = ContactStatus::rolling; }},
        {"gap", [](ContactRecord& c) { c.gap = -0.1; }},
        {"length", [](ContactRecord& c) { c.length = 0.1; }},
        {"point", [](ContactRecord& c) { c.point[1] = 0.1; }},
        {"normal", [](ContactRecord& c) { c.normal[0] = 1.0; }},
        {"branch", [](ContactRecord& c) { c.branch[0] = 1.0; }},
        {"impulse", [](ContactRecord& c) { c.impulse[1] = 1.0; }},
        {"rolling impulse", [](ContactRecord& c) { c.rolling_impulse[2] = 1.0; }}};
    const auto compared = [](const ContactRecord& contact) {
        Motion state;
        state.contacts = {contact};
        const NumberTable table = numbers_of({{Kind::state, 0, 0, 0}, encode(state)}).back();
        auto all = numbers(Kind::state, encode(state));
        all.push_back(static_cast<double>(table.ids.at(0)));
        return all;
    };
    for (const auto& change : changes) {
        ContactRecord contact;
        contact.a = 3, contact.b = 4;
        const auto before = compared(contact);
        change.make(contact);
        EXPECT_NE(compared(contact), before) << change.what;
    }
}

TEST(RecordNumbers, EveryNumberOfAFluidReportIsCompared) {
    const Change<FluidReport> changes[] = {
        {"iterations", [](FluidReport& r) { r.multiplier_iterations = 3; }},
        {"residual", [](FluidReport& r) { r.multiplier_residual = 0.1; }},
        {"converged", [](FluidReport& r) { r.multipliers_converged = false; }},
        {"divergence", [](FluidReport& r) { r.divergence = 0.1; }},
        {"final divergence", [](FluidReport& r) { r.final_divergence = 0.1; }},
        {"momentum defect", [](FluidReport& r) { r.momentum_defect = 0.1; }},
        {"Courant number", [](FluidReport& r) { r.courant = 0.1; }},
        {"mean velocity", [](FluidReport& r) { r.mean_velocity[1] = 0.1; }},
        {"no splitting", [](FluidReport& r) { r.splitting.reset(); }},
        {"pressure", [](FluidReport& r) { r.splitting->pressure_iterations = 1; }},
        {"viscosity", [](FluidReport& r) { r.splitting->viscous_iterations = 1; }},
        {"remaining divergence", [](FluidReport& r) { r.splitting->divergence = 0.1; }},
        {"viscous residual", [](FluidReport& r) { r.splitting->viscous_residual = 0.1; }},
        {"splitting converged", [](FluidReport& r) { r.splitting->converged = false; }},
        {"probe", [](FluidReport& r) { r.probes[1] = 0.1; }}};
    for (const auto& change : changes) {
        Kicks kicks;
        kicks.report.splitting.emplace();
        kicks.report.probes = {1.0, 2.0};
        const auto before = numbers(Kind::kicks, encode(kicks));
        change.make(kicks.report);
        EXPECT_NE(numbers(Kind::kicks, encode(kicks)), before) << change.what;
    }
}

TEST_F(Replayed, ARecordingThatWasCutOffIsPlayedToItsEnd) {
    std::filesystem::resize_file(file("grains"), std::filesystem::file_size(file("grains")) / 2);
    const ReplayReport report = grains_again(4.4995);
    EXPECT_FALSE(report.complete);
    EXPECT_GT(report.windows, 0);
    EXPECT_LT(report.windows, job.settings.integer("run.windows"));
    EXPECT_EQ(report.differences, 0);
}

// A run that stalls: who was still there has said farewell, and the job was ended before it could
// be released.
TEST_F(Replayed, ARecordingThatEndsWithAFarewellIsPlayed) {
    std::uintmax_t releases = 0;
    int farewells = 0;
    Recording whole(file("grains"));
    while (const auto frame = whole.next()) {
        const Kind kind = unframe(frame->bytes).envelope.kind;
        if (kind == Kind::farewell) ++farewells;
        // Sender, peer and length stand before each.
        if (kind == Kind::release) releases += 3 * sizeof(std::int64_t) + frame->bytes.size();
    }
    ASSERT_EQ(farewells, 2);
    ASSERT_GT(releases, 0u);
    std::filesystem::resize_file(file("grains"),
                                 std::filesystem::file_size(file("grains")) - releases);
    const ReplayReport report = grains_again(4.4995);
    EXPECT_FALSE(report.complete);
    EXPECT_EQ(report.windows, job.settings.integer("run.windows"));
    EXPECT_EQ(report.differences, 0);
}

/// As on a machine with a gigabyte, so that a faulty program asks in vain and does not get it.
class LittleMemory {
 public:
    LittleMemory() {
        getrlimit(RLIMIT_AS, &before_);
        const rlimit little{1UL << 30, before_.rlim_max};
        setrlimit(RLIMIT_AS, &little);
    }
    ~LittleMemory() { setrlimit(RLIMIT_AS, &before_); }

 private:
    rlimit before_{};
};

// Half a terabyte is what a damaged length may say; the file has some kilobytes.
TEST_F(Replayed, AFrameThatIsLongerThanTheFileEndsTheRecording) {
    Recording whole(file("grains"));
    int frames = 0;
    while (whole.next()) ++frames;
    ASSERT_GT(frames, 10);
    const std::int64_t sent = 1, peer = 0, length = std::int64_t{1} << 39;
    std::ofstream out(file("grains"), std::ios::binary | std::ios::app);
    for (const std::int64_t number : {sent, peer, length})
        out.write(reinterpret_cast<const char*>(&number), sizeof number);
    out << "a few bytes" << std::flush;
    const LittleMemory little;
    Recording damaged(file("grains"));
    int again = 0;
    EXPECT_NO_THROW(while (damaged.next())++ again);
    EXPECT_EQ(again, frames);
}

TEST_F(Replayed, AFailureOfTheParticipantIsItsOwn) {
    const Fault fault = [](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 2) throw std::runtime_error("no more grains");
    };
    try {
        grains_again(4.4995, 2, fault);
        FAIL() << "nothing was thrown";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::participant_failed);
        EXPECT_NE(std::string(failure.what()).find("no more grains"), std::string::npos);
    }
}

TEST_F(Replayed, AFailureWithTheCodeOfSuccessIsAFailure) {
    const Fault fault = [](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 2) throw Failure(ExitCode::done, "\x1b[2Jenough");
    };
    try {
        grains_again(4.4995, 2, fault);
        FAIL() << "nothing was thrown";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::participant_failed);
        EXPECT_EQ(std::string(failure.what()).find('\x1b'), std::string::npos);
    }
}

TEST_F(Replayed, OtherFilesAndRanksAreRefused) {
    EXPECT_THROW(Recording(folder.files().history), Failure);
    EXPECT_THROW(Recording(folder.path() / "none"), Failure);
    auto [coupler, ends] = LoopbackChannel::connect(3);
    Recording recording(file("grains"));
    EXPECT_THROW(replay(recording, *coupler, {}), Failure);
}

}  // namespace
}  // namespace turbidite
