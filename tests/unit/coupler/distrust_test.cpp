// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a participant may get wrong in a message, and what the coupler says about it: sender,
// message, window, grain, quantity. Every job has two ranks on both sides.
#include <gtest/gtest.h>

#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

template <class Record>
using Change = std::function<void(Record&)>;

/// Changes the messages of this kind in this window, on every rank.
template <class Record>
LoopbackChannel::Hook changed(Kind kind, std::int64_t window, Change<Record> change) {
    return [=](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != kind || message.envelope.window != window) return true;
        Record record = decode<Record>(message.payload);
        change(record);
        bytes = frame({message.envelope, encode(record)});
        return true;
    };
}

/// The same for the rank whose share contains grain 100.
template <class Record>
Change<Record> where_100_is(Change<Record> change);
template <>
Change<Motion> where_100_is(Change<Motion> change) {
    return [change](Motion& motion) {
        for (const GrainState& grain : motion.grains)
            if (grain.id == 100) return change(motion);
    };
}

class Distrust : public testing::Test {
 protected:
    Job job;
    const TestFolder folder{std::string("distrust-") +
                            testing::UnitTest::GetInstance()->current_test_info()->name()};

    void SetUp() override { job.grains_ranks = job.fluid_ranks = 2; }

    void grains_send(Kind kind, const Change<Motion>& change, std::int64_t window = 3) {
        job.from_grains = changed<Motion>(kind, window, where_100_is(change));
    }

    void fluid_sends(const Change<Kicks>& change) {
        job.from_fluid = changed<Kicks>(Kind::kicks, 3, change);
    }

    /// Ends with `code`, after three good windows, in all programs; and the reason says all this.
    void expect_end(ExitCode code, std::initializer_list<const char*> parts, int windows = 3) {
        job.run(folder);
        EXPECT_EQ(job.status.code, code);
        EXPECT_EQ(job.status.statistics.windows_done, windows);
        for (const char* part : parts)
            EXPECT_NE(job.status.reason.find(part), std::string::npos) << part << "\nnot in\n"
                                                                       << job.status.reason;
        for (const Outcome& outcome : job.outcomes) EXPECT_EQ(outcome.code, code);
    }
};

GrainState& grain_100(Motion& motion) {
    return *std::find_if(motion.grains.begin(), motion.grains.end(),
                         [](const GrainState& grain) { return grain.id == 100; });
}

// The record tells the value that ended the run.
TEST_F(Distrust, AnOverlapBeyondTheLimitIsTheLargestOfTheRun) {
    job.settings.set("run.output_every", std::int64_t{1});
    grains_send(Kind::state, [](Motion& m) { m.report.max_penetration = 0.3; });
    expect_end(ExitCode::physics_refused, {"overlap of 0.3 D in window 3"});
    EXPECT_EQ(job.status.statistics.maxima.penetration, 0.3);
    EXPECT_EQ(read_csv(folder.files().history).back().front(), "3");
}

TEST_F(Distrust, AGrainMissingAfterTheContacts) {
    grains_send(Kind::motion, [](Motion& m) { m.grains.clear(); });
    expect_end(ExitCode::physics_refused,
               {"grains rank 0 (scripted, host ", "of 3 grains are missing, 0 announced as removed",
                "the first one missing is grain 100", "in \"motion\" of window 3"});
}

// All three have the same place among all grains: the last of one rank has become the first of the
// next.
TEST(GrainRosterRanks, AGrainThatChangedItsRankIsAskedForWhereItWas) {
    const std::vector<GrainState> all = test_population();
    const auto shares = [&](std::size_t of_first) {
        std::vector<Motion> result(2);
        for (std::size_t i = 0; i < all.size(); ++i)
            result[i < of_first ? 0 : 1].grains.push_back(all[i]);
        return result;
    };
    auto [channel, ends] = LoopbackChannel::connect(2);
    const ParticipantLink link(Role::grains, *channel);
    const Arrival arrival(link, Kind::state, 5);
    GrainRoster roster(all);
    EXPECT_TRUE(roster.check(shares(2), arrival).empty());
    EXPECT_TRUE(roster.check(shares(1), arrival).empty());
    std::vector<Motion> without = shares(1);
    without[1].grains.erase(without[1].grains.begin());
    try {
        roster.check(without, arrival);
        FAIL() << "nothing was refused";
    } catch (const PhysicsRefused& refused) {
        EXPECT_NE(std::string(refused.what()).find("grains rank 1"), std::string::npos)
            << refused.what();
    }
}

// What counts is `state`: grains leave when they move, not in a contact problem.
TEST_F(Distrust, AGrainThatTheContactsAnnounceAsRemoved) {
    grains_send(Kind::motion, [](Motion& m) {
        m.grains.erase(m.grains.begin());
        m.report.removed = 1;
    });
    expect_end(ExitCode::physics_refused, {"1 of 3 grains are missing, 0 announced as removed"});
}

TEST_F(Distrust, AGrainMissingAfterTheMotion) {
    grains_send(Kind::state, [](Motion& m) { m.grains.erase(m.grains.begin()); });
    expect_end(ExitCode::physics_refused, {"1 of 3 grains are missing, 0 announced as removed",
                                           "in \"state\" of window 3", "report.removed"});
}

TEST_F(Distrust, AGrainAnnouncedAsRemovedThatIsStillThere) {
    grains_send(Kind::state, [](Motion& m) { m.report.removed = 1; });
    expect_end(ExitCode::physics_refused,
               {"grains (scripted): 1 grains were announced as removed, none is "
                "missing"});
}

TEST_F(Distrust, AGrainMissingAtTheStart) {
    grains_send(
        Kind::state, [](Motion& m) { m.grains.erase(m.grains.begin()); }, -1);
    expect_end(ExitCode::physics_refused,
               {"first one missing is grain 100", "in \"state\" at the start"}, 0);
}

TEST_F(Distrust, AGrainThatNobodyKnows) {
    grains_send(Kind::motion, [](Motion& m) { grain_100(m).id = 7; });
    expect_end(ExitCode::physics_refused,
               {"grains rank 0 (scripted", "grain 7 is not in the run", "\"motion\" of window 3"});
}

TEST_F(Distrust, AGrainSentTwice) {
    grains_send(Kind::state, [](Motion& m) { m.grains.push_back(grain_100(m)); });
    expect_end(ExitCode::physics_refused,
               {"grains rank 0 (scripted", "grain 100 was sent twice, first by rank 0"});
}

TEST_F(Distrust, AGrainThatReturns) {
    job.settings.set("domain.top", std::string("free"));  // at which all grains are
    job.settings.set("run.size_y", 5.3);
    int removed = 0;
    job.from_grains = [&](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::state || message.envelope.window != 1) return true;
        Motion motion = decode<Motion>(message.payload);
        if (motion.grains[0].id != 100) return true;
        motion.grains.erase(motion.grains.begin());
        motion.report.removed = ++removed;
        bytes = frame({message.envelope, encode(motion)});
        return true;  // the scripted grains send it again in window 2
    };
    expect_end(ExitCode::physics_refused, {"grain 100 is not in the run", "\"motion\" of window 2"},
               2);
}

TEST_F(Distrust, AnotherShape) {
    grains_send(Kind::motion, [](Motion& m) { grain_100(m).shape = 3; });
    expect_end(ExitCode::physics_refused,
               {"grains rank 0 (scripted", "grain 100 has shape 3 instead of 0, the population's"});
}

// Balances would not notice: they believe the density that comes with the velocity.
TEST_F(Distrust, AnotherDensity) {
    grains_send(Kind::motion, [](Motion& m) { grain_100(m).density *= 2.0; });
    expect_end(ExitCode::physics_refused, {"grain 100 has density 3 instead of 1.5",
                                           "A grain keeps its shape, material, radius"});
}

TEST_F(Distrust, AnotherRadius) {
    grains_send(Kind::state, [](Motion& m) { grain_100(m).radius *= 1.0 + 1e-6; });
    expect_end(ExitCode::physics_refused,
               {"grain 100 has radius 0.5000005 instead of 0.5", "\"state\" of window 3"});
}

struct Spoilt {
    const char* name;
    Change<GrainState> spoil;
    const char* says;
    const char* remedy = "All numbers that it had received are finite";
};
class DistrustGrains : public Distrust, public testing::WithParamInterface<Spoilt> {};

TEST_P(DistrustGrains, IsToldAsTheFaultOfTheGrains) {
    grains_send(Kind::motion, [&](Motion& m) { GetParam().spoil(grain_100(m)); });
    expect_end(ExitCode::physics_refused,
               {"grains rank 0 (scripted, host ", "log a.log): grain 100: ", GetParam().says,
                "in \"motion\" of window 3", GetParam().remedy});
}

INSTANTIATE_TEST_SUITE_P(
    Quantities, DistrustGrains,
    testing::Values(Spoilt{"Position", [](GrainState& g) { g.position[1] = NAN; },
                           "position is not finite: (2, nan, 0)"},
                    Spoilt{"Velocity", [](GrainState& g) { g.velocity[0] = INFINITY; },
                           "velocity is not finite: (inf, "},
                    Spoilt{"Spin", [](GrainState& g) { g.angular_velocity[2] = NAN; },
                           "angular velocity is not finite"},
                    Spoilt{"Impulse", [](GrainState& g) { g.contact_impulse[1] = NAN; },
                           "contact impulse is not finite"},
                    Spoilt{"Moment", [](GrainState& g) { g.contact_angular_impulse[2] = NAN; },
                           "contact angular impulse is not finite"},
                    Spoilt{"Held", [](GrainState& g) { g.announced_impulse[0] = NAN; },
                           "announced impulse is not finite"},
                    Spoilt{"Radius", [](GrainState& g) { g.radius = 0.0; },
                           "radius is 0, not a length above 0", "A grain is answered as it came"},
                    Spoilt{"Density", [](GrainState& g) { g.density = NAN; },
                           "density is nan, not a number above 0"},
                    Spoilt{"Orientation", [](GrainState& g) { g.orientation = {}; },
                           "orientation is no unit quaternion (w, x, y, z): (0, 0, 0, 0)",
                           "A grain is answered as it came"}),
    [](const auto& info) { return std::string(info.param.name); });

// Nothing has run away: no smaller step makes a radius of 0 one.
TEST_F(Distrust, AGrainThatWasNotFilledInIsNoMatterOfTheStep) {
    grains_send(Kind::motion, [](Motion& m) { m.grains.front() = {}; });
    expect_end(ExitCode::physics_refused, {"radius is 0", "A grain is answered as it came"});
}

TEST_F(Distrust, AReportWithANegativeCount) {
    grains_send(Kind::motion, [](Motion& m) { m.report.contacts = -1; });
    expect_end(ExitCode::physics_refused, {"report: number of contacts is -1"});
}

TEST_F(Distrust, AResidualThatIsNotFinite) {
    grains_send(Kind::motion, [](Motion& m) { m.report.residual = NAN; });
    expect_end(ExitCode::physics_refused, {"report: residual is not finite"});
}

TEST_F(Distrust, AWorkOfFilmsThatIsNotFinite) {
    grains_send(Kind::state, [](Motion& m) { m.report.film_work = INFINITY; });
    expect_end(ExitCode::physics_refused, {"report: film_work is not finite"});
}

TEST_F(Distrust, AContactThatIsNotFinite) {
    grains_send(Kind::state, [](Motion& m) {
        m.contacts.emplace(1);
        m.contacts->front().b = 100;
        m.contacts->front().gap = NAN;
    });
    expect_end(ExitCode::physics_refused, {"a contact of grain 100: gap is not finite"});
}

TEST_F(Distrust, AKickThatIsNotFiniteIsTheFaultOfTheFluid) {
    fluid_sends([](Kicks& k) {
        if (!k.kicks.empty()) k.kicks[0].angular_velocity[2] = NAN;
    });
    expect_end(ExitCode::physics_refused,
               {"fluid rank 0 (scripted-fluid, host ", "kick for grain 100: ",
                "angular velocity is not finite: (0, 0, nan)", "in \"kicks\" of window 3"});
}

struct SpoiltReport {
    const char* name;
    Change<FluidReport> spoil;
    const char* says;
};
class DistrustFluid : public Distrust, public testing::WithParamInterface<SpoiltReport> {};

TEST_P(DistrustFluid, IsToldAsTheFaultOfTheFluid) {
    fluid_sends([&](Kicks& k) { GetParam().spoil(k.report); });
    expect_end(ExitCode::physics_refused, {"fluid rank 0 (scripted-fluid, host ", "): report: ",
                                           GetParam().says, "in \"kicks\" of window 3"});
}

INSTANTIATE_TEST_SUITE_P(
    Quantities, DistrustFluid,
    testing::Values(
        SpoiltReport{"Courant", [](FluidReport& r) { r.courant = NAN; },
                     "Courant number is not finite: nan"},
        SpoiltReport{"NegativeCourant", [](FluidReport& r) { r.courant = -1.0; },
                     "Courant number is -1, not a number from 0 on"},
        SpoiltReport{"MeanVelocity", [](FluidReport& r) { r.mean_velocity[1] = INFINITY; },
                     "mean velocity is not finite: (0, inf, 0)"},
        SpoiltReport{"Probes",
                     [](FluidReport& r) {
                         r.probes = {1.0, NAN, 0.0};
                     },
                     "probes are not finite: (1, nan, 0)"},
        SpoiltReport{"Divergence", [](FluidReport& r) { r.divergence = NAN; },
                     "divergence is not finite: nan"},
        SpoiltReport{"FinalDivergence", [](FluidReport& r) { r.final_divergence = INFINITY; },
                     "final divergence is not finite: inf"},
        SpoiltReport{"MomentumDefect", [](FluidReport& r) { r.momentum_defect = -1e-3; },
                     "momentum defect is -0.001, not a number from 0 on"},
        SpoiltReport{"Slip", [](FluidReport& r) { r.multiplier_residual = NAN; },
                     "multiplier residual is not finite: nan"},
        SpoiltReport{"Iterations", [](FluidReport& r) { r.multiplier_iterations = -1; },
                     "number of multiplier iterations is -1"},
        SpoiltReport{"Splitting", [](FluidReport& r) { r.splitting.emplace().divergence = NAN; },
                     "remaining divergence is not finite: nan"}),
    [](const auto& info) { return std::string(info.param.name); });

TEST_F(Distrust, AKickThatMovesAHeldGrainIsTheFaultOfTheFluid) {
    job.population[0].prescribed = true;
    fluid_sends([](Kicks& k) {
        if (!k.kicks.empty() && k.kicks[0].id == 100) k.kicks[0].velocity[1] = -0.1;
    });
    expect_end(ExitCode::physics_refused,
               {"fluid rank 0 (scripted-fluid, host ", "kick for grain 100: velocity (0, -0.1, 0)",
                "instead of the given (0, 0, 0)", "in \"kicks\" of window 3"});
}

// With two ranks a contact may be told by both, or by one that should have been silent.
TEST_F(Distrust, AContactThatTwoRanksTell) {
    job.from_grains = changed<Motion>(Kind::state, 3, [](Motion& m) {
        ContactRecord contact;
        contact.a = 100, contact.b = 102;
        contact.normal = {1.0, 0.0, 0.0};
        m.contacts.emplace({contact});
    });
    expect_end(ExitCode::physics_refused,
               {"grains rank 1 (scripted, host ",
                "the contact of grain 100 and grain 102 (point 0) was sent twice, first by rank 0",
                "in \"state\" of window 3"});
}

TEST_F(Distrust, ContactsOfSomeRanksOnly) {
    grains_send(Kind::state, [](Motion& m) { m.contacts.emplace(); });
    job.settings.set("run.output_every", std::int64_t{100});
    expect_end(ExitCode::physics_refused,
               {"grains rank 1 (scripted, host ", "no contacts were sent, but other ranks"});
}

TEST_F(Distrust, AGrainWithoutAKick) {
    fluid_sends([](Kicks& k) { k.kicks.clear(); });
    expect_end(ExitCode::physics_refused,
               {"fluid (scripted-fluid): no answer for 3 of 3 grains; the first one is grain 100"});
}

TEST_F(Distrust, AKickForAGrainThatNobodyKnows) {
    fluid_sends([](Kicks& k) {
        if (!k.kicks.empty()) k.kicks[0].id = 5;
    });
    expect_end(ExitCode::physics_refused,
               {"fluid rank 0 (scripted-fluid", "grain 5 is not in the run"});
}

TEST_F(Distrust, TwoKicksForAGrain) {
    fluid_sends([](Kicks& k) {
        if (!k.kicks.empty()) k.kicks.push_back(k.kicks[0]);
    });
    expect_end(ExitCode::physics_refused,
               {"fluid rank 0 (scripted-fluid", "grain 100 was sent twice"});
}

TEST_F(Distrust, APayloadThatIsTooShortNamesItsSender) {
    job.from_grains = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::motion || message.envelope.window != 3) return true;
        message.payload.resize(message.payload.size() - 16);
        bytes = frame(message);
        return true;
    };
    expect_end(ExitCode::participant_failed, {"grains rank 0 (scripted, host ",
                                              "the payload of \"motion\" of window 3 is malformed: "
                                              "payload ends after",
                                              "protocol 1."});
}

TEST_F(Distrust, WhatIsNoFrameNamesItsSender) {
    job.from_fluid = [](Bytes& bytes) {
        if (unframe(bytes).envelope.kind == Kind::kicks) bytes.resize(8);
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_NE(job.status.reason.find("(scripted-fluid, host "), std::string::npos)
        << job.status.reason;
    EXPECT_NE(job.status.reason.find("sent what is no frame of the protocol"), std::string::npos);
}

// A contact impulse that the velocity does not know: relative defect far above 1e-4.
TEST_F(Distrust, AnImpulseThatDoesNotBelongToTheVelocity) {
    grains_send(Kind::motion, [](Motion& m) { grain_100(m).contact_impulse = {0.01, 0.0, 0.0}; });
    expect_end(ExitCode::physics_refused,
               {"grain_balance = ", "in window 3", "limits.grain_balance_hard = 0.0001",
                "fails most for grain 100", "grains (scripted)"});
}

TEST_F(Distrust, AStateWithOtherImpulsesThanTheContacts) {
    grains_send(Kind::state, [](Motion& m) { grain_100(m).contact_impulse[0] += 0.01; });
    expect_end(ExitCode::physics_refused,
               {"grain_balance = ", "in window 3", "its contact impulses those of the motion",
                "grain 100 of grains (scripted)"});
}

TEST_F(Distrust, AStateWithOtherVelocitiesThanTheKicks) {
    grains_send(Kind::state, [](Motion& m) { grain_100(m).velocity[1] += 0.01; });
    expect_end(ExitCode::physics_refused,
               {"in window 3", "velocities of the state must be those of the kicks",
                "grain 100 of grains (scripted)"});
}

TEST_F(Distrust, AnImpulseThatDoesNotBelongToTheVelocityWithoutAFluid) {
    job.settings = test_settings("split", false);
    grains_send(Kind::state, [](Motion& m) { grain_100(m).contact_impulse[0] += 0.01; });
    expect_end(ExitCode::physics_refused,
               {"grain_balance = ", "in window 3", "M dU = M g dt + J_c fails most for grain 100"});
}

// Within the limits it is a warning, once.
TEST_F(Distrust, AnImpulseThatIsAlmostRight) {
    job.from_grains = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::motion) return true;
        Motion motion = decode<Motion>(message.payload);
        for (GrainState& grain : motion.grains) grain.contact_impulse = {1e-8, 0.0, 0.0};
        bytes = frame({message.envelope, encode(motion)});
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    std::stringstream log;
    log << std::ifstream(folder.files().log).rdbuf();
    const std::string text = log.str(), warning = "turbidite: warning: grain_balance = ";
    const auto first = text.find(warning);
    ASSERT_NE(first, std::string::npos) << text;
    EXPECT_EQ(text.find(warning, first + 1), std::string::npos) << text;
}

}  // namespace
}  // namespace turbidite
