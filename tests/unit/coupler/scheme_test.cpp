// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A scheme is one file. This file adds a fourth one, known to no other file. It runs over loopback
// channels with the scripted partners, whose library does not know it.
//
// `twice` begins as `split` does, then asks the fluid for the response of the grains and solves the
// contacts once more:
//
//     fluid    window → constraint → response → constraint → response → accept → kicks
//     grains   window → motion → contact_input → motion → kick → state
//
// The response to a contact solve without fluid is that of free grains with their true inertia. The
// second solve therefore equals the first of `joint`, and the run equals that of `joint`.
#include <gtest/gtest.h>

#include "coupler/hub/handshake.hpp"
#include "coupler/hub/schemes/exchanges.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

class Twice final : public Scheme {
 public:
    WindowResult play(const Window& window, const Motion& before, SchemeContext context) override {
        context.fluid->send_all(Kind::window, window);
        context.grains.send_all(Kind::window, window);
        WindowResult result;
        result.motion = receive_motion(window, before, context);
        context.grains.send_each(Kind::contact_input, context.plan.by_owner(responses_to(
                                                          window, result.motion, context)));
        result.motion = receive_motion(window, before, context);
        responses_to(window, result.motion, context);
        send_accept(context);
        finish_window(window, before, context, result);
        return result;
    }

 private:
    static std::vector<FreeResponse> responses_to(const Window& window, const Motion& motion,
                                                  SchemeContext& context) {
        context.fluid->send_each(Kind::constraint, context.plan.by_place(motion));
        return receive_responses(window, context);
    }
};

SchemeEntry twice_scheme() {
    return {.name = "twice",
            .help = "contacts before and after the fluid",
            .fluid = {{Kind::window, from_coupler},
                      {Kind::constraint, from_coupler},
                      {Kind::response, to_coupler},
                      {Kind::constraint, from_coupler},
                      {Kind::response, to_coupler},
                      {Kind::accept, from_coupler},
                      {Kind::kicks, to_coupler}},
            .grains = {{Kind::window, from_coupler},
                       {Kind::motion, to_coupler},
                       {Kind::contact_input, from_coupler},
                       {Kind::motion, to_coupler},
                       {Kind::kick, from_coupler},
                       {Kind::state, to_coupler}},
            .slip_per_mismatch = 0.0,
            .make = [](const Settings&) -> std::unique_ptr<Scheme> {
                return std::make_unique<Twice>();
            }};
}

/// Discs that land in the third window.
Job landing_under(const char* known_scheme) {
    Job job;
    job.settings = test_settings(known_scheme);
    job.settings.set("run.output_every", std::int64_t{1});
    job.floor = 4.4995;
    job.fluid_ranks = 2, job.grains_ranks = 2;
    return job;
}

TEST(AFourthScheme, WorksWithPartnersThatDoNotKnowIt) {
    const TestFolder joint_folder("scheme-joint"), folder("scheme-twice");
    Job joint = landing_under("joint");
    joint.run(joint_folder);
    Job job = landing_under("split");
    job.scheme = twice_scheme();
    job.run(folder);
    ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    for (const Outcome& outcome : job.outcomes) EXPECT_EQ(outcome.code, ExitCode::done);
    const Rows rows = read_csv(folder.path() / "history.csv"),
               expected = read_csv(joint_folder.path() / "history.csv");
    ASSERT_EQ(rows.size(), 8u);
    EXPECT_EQ(cell(rows, 7, "contacts"), 3) << "nothing has landed, nothing was compared";
    for (std::size_t row = 2; row < 8; ++row)
        for (const char* name : {"mean_velocity_y", "mean_position_y"})
            EXPECT_NEAR(cell(rows, row, name), cell(expected, row, name), 1e-14) << name << row;
    EXPECT_LT(job.status.statistics.maxima.grain_balance, 1e-13);
}

// With the order of `split`, a grains participant must treat the second contact solve as an error
// of the coupler.
TEST(AFourthScheme, OutOfOrderMessagesAreRefusedByTheParticipant) {
    const TestFolder folder("scheme-twice-participant");
    Job job = landing_under("split");
    job.scheme = twice_scheme();
    int constraints = 0;
    job.fluid_ranks = 1;
    job.to_fluid = [&](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::constraint || ++constraints != 4) return true;
        message.envelope.kind = Kind::accept;
        bytes = frame(message);
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_NE(job.status.reason.find(
                  "received \"accept\" from the coupler in window 1, but \"constraint\" from the "
                  "coupler is due"),
              std::string::npos)
        << job.status.reason;
}

TEST(AFourthScheme, OutOfOrderMessagesAreRefusedByTheCoupler) {
    const TestFolder folder("scheme-twice-coupler");
    Job job = landing_under("split");
    job.scheme = twice_scheme();
    job.fluid_ranks = 1;
    job.from_fluid = [](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::response || message.envelope.window != 1) return true;
        message.envelope.kind = Kind::kicks;
        bytes = frame(message);
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::participant_failed);
    EXPECT_NE(job.status.reason.find("): received \"kicks\" from the participant in window 1, but "
                                     "\"response\" from the participant is due"),
              std::string::npos)
        << job.status.reason;
}

// Its order requires effective inertia, which the handshake derives from the order alone.
TEST(AFourthScheme, AsksForWhatItsOrderNeeds) {
    const Settings settings = test_settings();
    for (const Role role : {Role::fluid, Role::grains}) {
        EXPECT_TRUE(expectation(role, settings, {}, twice_scheme()).effective_inertia);
        EXPECT_FALSE(expectation(role, settings, {}, find_scheme("split")).effective_inertia);
        EXPECT_TRUE(expectation(role, settings, {}, find_scheme("joint")).effective_inertia);
    }
}

}  // namespace
}  // namespace turbidite
