// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "coupler/protocol/failure.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

// D = u_c = 1: penetrations are in D, divergences in u_c/D. Penetration limit 0.2 D.
class LedgerTest : public ::testing::Test {
 protected:
    Ledger ledger{hub_settings(test_settings()), 3};
    WindowResult result = good();

    static WindowResult good() {
        WindowResult result;
        result.motion.grains = result.state.grains = test_population();
        result.kicks.kicks.resize(3);
        return result;
    }

    /// The ledger's message; empty if it accepts.
    std::string complaint() {
        try {
            ledger.check(result);
        } catch (const PhysicsRefused& refused) {
            return refused.what();
        }
        return "";
    }
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(LedgerTest, AgreesWithAGoodWindow) {
    EXPECT_EQ(complaint(), "");
}

TEST_F(LedgerTest, CountsThoseWhoLeft) {
    result.state.grains.pop_back();
    result.state.report.removed = 1;
    EXPECT_EQ(complaint(), "");
    result.state.report.removed = 0;  // the report still counts it
    EXPECT_EQ(complaint(), "");
    result.state.grains.pop_back();  // a grain that vanished without being reported
    EXPECT_SAYS(complaint(),
                "1 grains present and 1 removed through free sides do not add up to 3");
}

TEST_F(LedgerTest, BoundsTheOverlap) {
    result.state.report.max_penetration = 0.2;
    EXPECT_EQ(complaint(), "");
    result.state.report.max_penetration = 0.21;
    EXPECT_SAYS(complaint(), "grains overlap by 0.21 D, limits.penetration = 0.2 D");
    result.state.report.max_penetration = not_a_number;
    EXPECT_NE(complaint(), "");
}

// The advice names keys of the adapter in use.
TEST_F(LedgerTest, AdvisesHowToReduceOverlaps) {
    result.state.report.max_penetration = 0.21;
    EXPECT_SAYS(complaint(), "Use a smaller time.step, or more contact.iterations.");
    Settings settings = test_settings();
    settings.set("grains.adapter", std::string("yade-md"));
    ledger = Ledger(hub_settings(settings), 3);
    EXPECT_SAYS(complaint(), "Use a smaller contact.md_overlap");
    EXPECT_EQ(complaint().find("contact.iterations"), std::string::npos);
}

TEST_F(LedgerTest, ToleratesTwoDivergentWindowsButNotThree) {
    result.kicks.report.divergence = 2e-4;
    EXPECT_EQ(complaint(), "");
    EXPECT_EQ(complaint(), "");
    result.kicks.report.divergence = 1e-5;  // a good window: counting starts again
    EXPECT_EQ(complaint(), "");
    result.kicks.report.divergence = 2e-4;
    EXPECT_EQ(complaint(), "");
    result.kicks.report.divergence = not_a_number;
    EXPECT_EQ(complaint(), "");
    EXPECT_SAYS(complaint(), "in 3 consecutive windows");
}

TEST_F(LedgerTest, ToleratesTwoUnsolvedMultiplierProblemsButNotThree) {
    FluidReport& fluid = result.kicks.report;
    fluid.multiplier_residual = 3e-3;
    for (const bool converged : {false, false, true, false, false}) {
        fluid.multipliers_converged = converged;
        EXPECT_EQ(complaint(), "");
    }
    const std::string text = complaint();
    EXPECT_SAYS(
        text,
        "stopped at its iteration limit in 3 consecutive windows, at an rms slip of 3.0e-03 u_c");
    EXPECT_SAYS(text, "fluid.multiplier_iterations = 200, fluid.multiplier_tolerance = 0.0001 u_c");
}

TEST_F(LedgerTest, ChecksTheStart) {
    Motion start = result.state;
    EXPECT_NO_THROW(ledger.check_start(start));
    start.grains.pop_back();
    EXPECT_THROW(ledger.check_start(start), PhysicsRefused);
}

}  // namespace
}  // namespace turbidite
