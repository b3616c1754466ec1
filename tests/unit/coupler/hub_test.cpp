// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The whole coupler without MPI: scripted participants in threads, connected by loopback channels.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "coupler/protocol/files/kept_lines.hpp"
#include "coupler/protocol/files/run_files.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

// M_eff = M/3, M_sub = M/3: free fall at g = 1. b = 1/(1 + gamma dt/M_eff), M_eff = 0.5 pi R^2 =
// pi/8. After n windows U = -(a dt)(b + b^2 + ... + b^n).
double expected_velocity(int windows) {
    const double b = 1.0 / (1.0 + drag * 0.01 / (3.14159265358979323846 / 8.0));
    double u = 0.0;
    for (int k = 0; k < windows; ++k) u = b * (u - 0.01);
    return u;
}

struct Layout {
    const char* scheme;
    int grains_ranks, fluid_ranks;
};
class EveryLayout : public testing::TestWithParam<Layout> {};

TEST_P(EveryLayout, PlaysTheRunToItsExactEnd) {
    const TestFolder folder(std::string("hub-layout-") + GetParam().scheme +
                            std::to_string(GetParam().grains_ranks * 10 + GetParam().fluid_ranks));
    Job job;
    job.settings = test_settings(GetParam().scheme);
    job.grains_ranks = GetParam().grains_ranks;
    job.fluid_ranks = GetParam().fluid_ranks;
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_EQ(job.status.statistics.windows_done, 6);
    for (const Outcome& outcome : job.outcomes) EXPECT_EQ(outcome.code, ExitCode::done);

    const auto rows = read_csv(folder.path() / "history.csv");
    ASSERT_EQ(rows.size(), 5u);  // header, t = 0, and windows 2, 4, 6
    const std::size_t velocity = column(rows[0], "mean_velocity_y");
    EXPECT_NEAR(std::stod(rows[4][velocity]), expected_velocity(6), 1e-9);
    EXPECT_EQ(rows[4][column(rows[0], "grains")], "3");
    EXPECT_LT(job.status.statistics.maxima.grain_balance, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(Layouts, EveryLayout,
                         testing::Values(Layout{"split", 1, 1}, Layout{"split", 2, 3},
                                         Layout{"joint", 1, 1}, Layout{"joint", 3, 2}));

TEST(Hub, ADryRunFallsFreely) {
    const TestFolder folder("hub-dry");
    Job job;
    job.settings = test_settings("split", false);
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const auto rows = read_csv(folder.path() / "history.csv");
    EXPECT_NEAR(std::stod(rows.back()[column(rows[0], "mean_velocity_y")]), -0.06, 1e-12);
    EXPECT_EQ(rows.back()[column(rows[0], "divergence")], "");
}

TEST(Hub, AFailingAdapterEndsTheRunForAllWithItsOwnMessage) {
    const TestFolder folder("hub-failure");
    Job job;
    job.fluid_fault = [](const std::string& function, std::int64_t window) {
        if (function == "impose" && window == 3) throw PhysicsRefused("the disc is on fire");
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::physics_refused);
    EXPECT_EQ(job.status.reason.find("fluid rank 0 (scripted-fluid, host "), 0u)
        << job.status.reason;
    EXPECT_NE(job.status.reason.find("the disc is on fire"), std::string::npos);
    EXPECT_EQ(job.status.statistics.windows_done, 3);
    for (const Outcome& outcome : job.outcomes) EXPECT_EQ(outcome.code, ExitCode::physics_refused);
    const auto record = nlohmann::json::parse(std::ifstream(folder.path() / "run.json"));
    EXPECT_EQ(record["exit_code"], 6);
    EXPECT_EQ(record["ranks"].size(), 2u);
    EXPECT_GE(read_csv(folder.path() / "history.csv").size(), 3u);  // the good rows are kept
}

TEST(Hub, AnUnexpectedExceptionIsAFailedParticipant) {
    const TestFolder folder("hub-exception");
    Job job;
    job.grains_fault = [](const std::string& function, std::int64_t) {
        if (function == "initialise") throw std::runtime_error("no such material");
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_NE(job.status.reason.find("no such material"), std::string::npos);
}

TEST(Hub, AllMismatchesOfTheHandshakeAreReportedTogether) {
    const TestFolder folder("hub-handshake");
    Job job;
    job.adapter = "other-code";
    job.hash = "feedfeedfeedfeed";
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::handshake_refused);
    for (const char* part : {"grains rank 0: adapter is other-code, the case needs scripted",
                             "grains rank 0: hash of the resolved case is feedfeedfeedfeed",
                             "fluid rank 0: hash of the resolved case"})
        EXPECT_NE(job.status.reason.find(part), std::string::npos) << job.status.reason;
    for (const Outcome& outcome : job.outcomes)
        EXPECT_EQ(outcome.code, ExitCode::handshake_refused);
}

// Grains at x = 2, 4.5 and 7 with R = 0.5; the fluid ranks own [0, 5] and [5, 10] and need grains
// within 7 cells of D/8: the middle one goes to both.
TEST(Hub, NoRankButTheCouplersHoldsAllGrains) {
    for (const char* scheme : {"split", "joint"}) {
        const TestFolder folder(std::string("hub-shares-") + scheme);
        Job job;
        job.settings = test_settings(scheme);
        job.grains_ranks = 3;
        job.fluid_ranks = 2;
        std::map<Kind, std::set<std::size_t>> counts;  // of the grains in the frames of a kind
        const auto count = [&](Bytes& bytes) {
            const Message message = unframe(bytes);
            const Kind kind = message.envelope.kind;
            const bool kick = kind == Kind::kick;
            if (kick) counts[kind].insert(decode<Kicks>(message.payload).kicks.size());
            if (kind == Kind::population || kind == Kind::bodies || kind == Kind::constraint)
                counts[kind].insert(decode<Motion>(message.payload).grains.size());
            return true;
        };
        job.to_grains = count;
        job.to_fluid = count;
        job.run(folder);
        ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
        EXPECT_EQ(counts[Kind::population], std::set<std::size_t>{1});
        EXPECT_EQ(counts[Kind::kick], std::set<std::size_t>{1});
        EXPECT_EQ(counts[Kind::constraint], std::set<std::size_t>{2});
    }
}

TEST(Hub, NaNIsRefusedBeforeItTravels) {
    const TestFolder folder("hub-nan");
    Job job;
    // A corrupted velocity in the kick, which the grains would go on with.
    job.to_grains = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::kick || message.envelope.window != 2) return true;
        Kicks kicks = decode<Kicks>(message.payload);
        kicks.kicks[0].velocity[0] = NAN;
        bytes = frame({message.envelope, encode(kicks)});
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::physics_refused);
    EXPECT_NE(job.status.reason.find("grain 100: position is not finite: (nan, "),
              std::string::npos)
        << job.status.reason;
}

// Messages of a participant are checked where they arrive.
TEST(Hub, AMotionOrAKickThatIsNotFiniteNamesGrainAndWindow) {
    const auto spoilt = [](Kind kind, const auto& spoil) -> LoopbackChannel::Hook {
        return [kind, spoil](Bytes& bytes) {
            Message message = unframe(bytes);
            if (message.envelope.kind != kind || message.envelope.window != 2) return true;
            bytes = frame({message.envelope, spoil(message.payload)});
            return true;
        };
    };
    const TestFolder folder("hub-nan-arrives");
    Job grains;
    grains.from_grains = spoilt(Kind::motion, [](const Bytes& payload) {
        Motion motion = decode<Motion>(payload);
        motion.grains[1].velocity[0] = NAN;
        return encode(motion);
    });
    grains.run(folder);
    EXPECT_EQ(grains.status.code, ExitCode::physics_refused);
    EXPECT_NE(grains.status.reason.find("grain 101: velocity is not finite: (nan, "),
              std::string::npos)
        << grains.status.reason;
    Job fluid;
    fluid.from_fluid = spoilt(Kind::kicks, [](const Bytes& payload) {
        Kicks kicks = decode<Kicks>(payload);
        kicks.kicks[2].multiplier_impulse[1] = INFINITY;
        return encode(kicks);
    });
    fluid.run(folder);
    EXPECT_EQ(fluid.status.code, ExitCode::physics_refused);
    EXPECT_NE(fluid.status.reason.find(
                  "kick for grain 102: multiplier impulse is not finite: (0, inf, 0), "
                  "in \"kicks\" of window 2"),
              std::string::npos)
        << fluid.status.reason;
}

TEST(Hub, ALostMessageStallsWithAWaitForTable) {
    const TestFolder folder("hub-stall");
    Job job;
    job.settings.set("limits.stall_soft", 0.1);
    job.settings.set("limits.stall_hard", 0.4);
    job.to_grains = [](Bytes& bytes) {
        const Message message = unframe(bytes);
        return message.envelope.kind != Kind::kick || message.envelope.window != 1;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::stalled);
    EXPECT_NE(job.status.reason.find("no \"state\" from grains"), std::string::npos)
        << job.status.reason;
    EXPECT_NE(job.status.reason.find("fluid rank 0"), std::string::npos);
}

TEST(Hub, ACorruptedFrameIsAnErrorNotAHang) {
    const TestFolder folder("hub-corrupt");
    Job job;
    job.to_grains = [](Bytes& bytes) {
        if (unframe(bytes).envelope.kind == Kind::kick) bytes.resize(bytes.size() - 8);
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
}

TEST(Hub, AStopRequestEndsAfterOneMoreWindowWhichIsWritten) {
    const TestFolder folder("hub-stop");
    Job job;
    job.settings.set("run.output_every", std::int64_t{100});
    job.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 1)
            std::ofstream(folder.path() / "STOP") << static_cast<int>(ExitCode::terminated);
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::terminated);
    EXPECT_EQ(job.status.statistics.windows_done, 3);
    EXPECT_NE(job.status.reason.find("stopped on request after window 3"), std::string::npos)
        << job.status.reason;
    const auto rows = read_csv(folder.files().history);
    EXPECT_EQ(rows.back().front(), "3");
    EXPECT_TRUE(std::filesystem::exists(folder.files().series / "grains_00000003.vtp"));
}

TEST(Hub, AStopRequestInTheLastWindowIsARunThatIsDone) {
    const TestFolder folder("hub-stop-last");
    Job job;
    const std::int64_t last = job.settings.integer("run.windows") - 1;
    job.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == last - 1)
            std::ofstream(folder.path() / "STOP") << "130";
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done);
    EXPECT_EQ(job.status.statistics.windows_done, last + 1);
}

// Discs whose lowest point is at 4.5 fall on a floor at 4.4995. Two windows move them by 3e-4 (a
// little less with drag); the third would make it 6e-4, but the floor stops them.
Job landing(double inertia_error) {
    Job job;
    job.settings = test_settings("joint");
    job.settings.set("run.output_every", std::int64_t{1});
    job.floor = 4.4995;
    job.inertia_error = inertia_error;
    return job;
}

TEST(HubJoint, AnExactFluidNeedsOneRound) {
    const TestFolder folder("hub-joint-exact");
    Job job = landing(0.0);
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const Rows rows = read_csv(folder.path() / "history.csv");
    ASSERT_EQ(rows.size(), 8u);  // header, t = 0, six windows
    EXPECT_EQ(cell(rows, 7, "contacts"), 3);
    for (std::size_t row = 2; row < 8; ++row) {
        EXPECT_EQ(cell(rows, row, "joint_rounds"), 1);
        EXPECT_EQ(cell(rows, row, "contact_iterations"), 1);
        EXPECT_LT(cell(rows, row, "joint_mismatch"), 1e-15);
    }
    EXPECT_NEAR(cell(rows, 7, "mean_velocity_y"), 0.0, 1e-15);
    EXPECT_LT(job.status.statistics.maxima.penetration, 1e-15);
    EXPECT_LT(job.status.statistics.maxima.grain_balance, 1e-13);
    EXPECT_EQ(job.status.statistics.maxima.joint->unconverged_windows, 0);
    EXPECT_EQ(rows[1][column(rows[0], "joint_rounds")], "") << "no window yet";
}

// The contact is scalar, so with an inertia that is 20 % off, J has a relative error of 0.2 in
// round 1, which every further round multiplies by 0.2. The landing speed is about 0.02 u_c: 0.02 *
// 0.2^n < 1e-9 takes at most eleven rounds, and more than one. The answer equals that of the exact
// fluid to the tolerance.
TEST(HubJoint, AnApproximateFluidIsIteratedToTheSameAnswer) {
    const TestFolder exact_folder("hub-joint-reference"), folder("hub-joint-approximate");
    Job exact = landing(0.0);
    exact.run(exact_folder);
    for (const double error : {0.2, -0.2}) {
        Job job = landing(error);
        job.settings.set("coupling.iterations", std::int64_t{12});
        job.grains_ranks = 2, job.fluid_ranks = 2;
        job.run(folder);
        ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
        const Rows rows = read_csv(folder.path() / "history.csv");
        const Rows expected = read_csv(exact_folder.path() / "history.csv");
        for (std::size_t row = 2; row < 8; ++row)
            for (const char* name : {"mean_velocity_y", "mean_position_y"})
                EXPECT_NEAR(cell(rows, row, name), cell(expected, row, name), 1e-9) << name << row;
        EXPECT_EQ(cell(rows, 2, "joint_rounds"), 1) << "no contact yet: nothing to disagree about";
        EXPECT_GT(cell(rows, 7, "joint_rounds"), 3);
        EXPECT_EQ(cell(rows, 7, "contact_iterations"), cell(rows, 7, "joint_rounds")) << "summed";
        EXPECT_LE(cell(rows, 7, "joint_mismatch"), 1e-9);
        EXPECT_EQ(job.status.statistics.maxima.joint->unconverged_windows, 0);
        EXPECT_LT(job.status.statistics.maxima.grain_balance, 1e-13)
            << "the impulses are exact all the same";
        EXPECT_LT(job.status.statistics.maxima.penetration, 1e-15)
            << "positions follow the contact velocity";
    }
}

// Two rounds leave a mismatch: the window is completed, counted and reported.
TEST(HubJoint, AWindowThatNeedsMoreRoundsIsCounted) {
    const TestFolder folder("hub-joint-capped");
    Job job = landing(0.2);
    job.settings.set("coupling.iterations", std::int64_t{2});
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const auto maxima = nlohmann::json::parse(std::ifstream(folder.path() / "run.json"))["maxima"];
    EXPECT_GE(maxima["unconverged_joint_windows"], 2);
    EXPECT_LE(maxima["unconverged_joint_windows"], 4) << "windows without contact converge";
    EXPECT_EQ(maxima["joint_rounds"], 2);
    EXPECT_GT(maxima["joint_mismatch"], 1e-9);
    EXPECT_LT(job.status.statistics.maxima.grain_balance, 1e-13)
        << "momentum balances all the same";
    std::stringstream log;
    log << std::ifstream(folder.files().log).rdbuf();
    EXPECT_NE(log.str().find("NOT CONVERGED"), std::string::npos) << log.str();
    EXPECT_NE(log.str().find("of 6 windows contacts and fluid differ"), std::string::npos);
}

/// A fluid whose multiplier solver reaches its iteration limit in these windows.
LoopbackChannel::Hook unsolved_in(std::vector<std::int64_t> windows) {
    return [windows](Bytes& bytes) {
        Message message = unframe(bytes);
        const auto here = std::find(windows.begin(), windows.end(), message.envelope.window);
        if (message.envelope.kind != Kind::kicks || here == windows.end()) return true;
        Kicks kicks = decode<Kicks>(message.payload);
        kicks.report.multipliers_converged = false;
        kicks.report.multiplier_residual = 2e-3;
        bytes = frame({message.envelope, encode(kicks)});
        return true;
    };
}

std::string text_of(const std::filesystem::path& file) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

TEST(HubMultipliers, WindowsThatStopAtTheLimitAreCountedAndReported) {
    const TestFolder folder("hub-multipliers-counted");
    Job job;
    job.from_fluid = unsolved_in({1, 2, 5});
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const auto maxima = nlohmann::json::parse(std::ifstream(folder.path() / "run.json"))["maxima"];
    EXPECT_EQ(maxima["unconverged_multiplier_windows"], 3);
    EXPECT_TRUE(maxima.contains("courant") && maxima.contains("final_divergence")) << maxima;
    const std::string log = text_of(folder.files().log);
    EXPECT_NE(log.find("multipliers 0 its, 2e-03 NOT CONVERGED"), std::string::npos) << log;
    EXPECT_NE(
        log.find("in 3 of 6 windows the multiplier problem used up its 200 iterations "
                 "(fluid.multiplier_iterations); rms slip up to 2.0e-03 u_c, 0.0001 required"),
        std::string::npos)
        << log;
}

/// These Courant numbers, window by window.
LoopbackChannel::Hook courant_numbers(std::vector<double> numbers) {
    return [numbers](Bytes& bytes) {
        const Message message = unframe(bytes);
        if (message.envelope.kind != Kind::kicks) return true;
        auto kicks = decode<Kicks>(message.payload);
        kicks.report.courant = numbers.at(static_cast<std::size_t>(message.envelope.window));
        bytes = frame({message.envelope, encode(kicks)});
        return true;
    };
}

std::size_t occurrences(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

TEST(HubCourant, ALargeOneIsToldOnceDuringTheRunAndInTheRecord) {
    const TestFolder folder("hub-courant");
    Job job;
    job.from_fluid = courant_numbers({0.1, 1.0, 2.5, 2.0, 4.6, 3.0});
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const std::string log = text_of(folder.files().log);
    EXPECT_EQ(occurrences(log, "warning: the Courant number is 2.5 in window 2. "), 1u) << log;
    EXPECT_EQ(occurrences(log, "warning: the Courant number is "), 1u) << log;
    EXPECT_EQ(occurrences(log, "warning: the Courant number was up to 4.6. "), 1u) << log;
    const auto warnings =
        nlohmann::json::parse(std::ifstream(folder.path() / "run.json"))["warnings"];
    ASSERT_EQ(warnings.size(), 1u) << warnings;
    EXPECT_EQ(warnings[0]["about"], "courant");
    const std::string text = warnings[0]["text"];
    EXPECT_NE(text.find("depends on the time step"), std::string::npos) << text;
    EXPECT_NE(text.find("Use time.step = 0.00"), std::string::npos) << text;
}

TEST(HubCourant, ASmallOneIsNot) {
    const TestFolder folder("hub-courant-small");
    Job job;
    job.from_fluid = courant_numbers({0.1, 0.9, 0.5, 0.5, 0.5, 0.5});
    job.run(folder);
    EXPECT_EQ(text_of(folder.files().log).find("warning: the Courant"), std::string::npos);
    const auto record = nlohmann::json::parse(std::ifstream(folder.path() / "run.json"));
    EXPECT_TRUE(record["warnings"].empty()) << record;
}

TEST(HubMultipliers, ThreeConsecutiveWindowsEndTheRun) {
    const TestFolder folder("hub-multipliers-refused");
    Job job;
    job.fluid_ranks = 2;
    job.from_fluid = unsolved_in({2, 3, 4});
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::physics_refused);
    for (const char* part :
         {"stopped at its iteration limit in 3 consecutive windows",
          "fluid.multiplier_iterations = 200", "fluid.multiplier_tolerance = 0.0001"})
        EXPECT_NE(job.status.reason.find(part), std::string::npos) << job.status.reason;
    EXPECT_EQ(job.status.statistics.windows_done, 4) << "window 4 was not good, 0 to 3 were";
    for (const Outcome& outcome : job.outcomes) EXPECT_EQ(outcome.code, ExitCode::physics_refused);
}

TEST(HubMultipliers, ADryRunHasNone) {
    const TestFolder folder("hub-multipliers-dry");
    Job job;
    job.settings = test_settings("split", false);
    job.run(folder);
    const auto maxima = nlohmann::json::parse(std::ifstream(folder.path() / "run.json"))["maxima"];
    EXPECT_FALSE(maxima.contains("unconverged_multiplier_windows")) << maxima;
}

TEST(HubJoint, OtherSchemesLeaveItsColumnsEmpty) {
    const TestFolder folder("hub-joint-columns");
    Job job;
    job.run(folder);
    const Rows rows = read_csv(folder.path() / "history.csv");
    EXPECT_TRUE(std::isnan(cell(rows, 3, "joint_rounds")));
    EXPECT_FALSE(job.status.statistics.maxima.joint);
    EXPECT_FALSE(
        nlohmann::json::parse(std::ifstream(folder.path() / "run.json"))["maxima"].contains(
            "joint_rounds"));
}

// One round too few on the fluid's side: refused with a message, and all participants end.
TEST(HubJoint, AnAcceptOutOfTurnIsRefused) {
    const TestFolder folder("hub-joint-order");
    Job job = landing(0.0);
    job.to_fluid = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind == Kind::constraint && message.envelope.window == 1) {
            message.envelope.kind = Kind::accept;
            bytes = frame(message);
        }
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_NE(job.status.reason.find(
                  "received \"accept\" from the coupler in window 1, but \"constraint\" "
                  "from the coupler is due"),
              std::string::npos)
        << job.status.reason;
    EXPECT_EQ(job.status.statistics.windows_done, 1);
}

// A constraint lost in the second round causes a stall, and the table shows what each participant
// waits for, in the message and in the file that is there even if the coupler is killed.
TEST(HubJoint, AStallNamesTheRound) {
    const TestFolder folder("hub-joint-stall");
    std::filesystem::create_directories(wait_table_file(folder.path()).parent_path());
    Job job = landing(0.2);
    job.settings.set("limits.stall_soft", 0.1);
    job.settings.set("limits.stall_hard", 0.4);
    job.to_fluid = [](Bytes& bytes) {
        const Envelope envelope = unframe(bytes).envelope;
        return envelope.kind != Kind::constraint || envelope.iteration != 2;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::stalled);
    for (const char* part :
         {"no \"response\" from fluid", "is due to send \"response\", window ", ", round 2, for",
          "waits for the coupler's \"kick\" or \"contact_input\", window "})
        EXPECT_NE(job.status.reason.find(part), std::string::npos) << job.status.reason;
    const std::vector<std::string> left = kept_lines(wait_table_file(folder.path()));
    ASSERT_EQ(left.size(), 2u);
    for (const char* part :
         {"  fluid rank 0 (host ", "is due to send \"response\", window ", ", round 2, for"})
        EXPECT_NE(left[0].find(part), std::string::npos) << left[0];
    for (const char* part :
         {"  grains rank 0 (host ", "waits for the coupler's \"kick\" or \"contact_input\""})
        EXPECT_NE(left[1].find(part), std::string::npos) << left[1];
}

TEST(HubJoint, AResponseThatIsNotFiniteIsRefused) {
    const TestFolder folder("hub-joint-nan");
    Job job = landing(NAN);
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::physics_refused);
    EXPECT_NE(job.status.reason.find("response for grain 100: velocity is not finite"),
              std::string::npos)
        << job.status.reason;
}

}  // namespace
}  // namespace turbidite
