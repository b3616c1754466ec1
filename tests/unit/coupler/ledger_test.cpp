// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/checks/ledger.hpp"

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
    std::vector<std::string> warnings;
    Ledger ledger = make(test_settings());
    WindowResult result = good();

    Ledger make(const Settings& settings) {
        Ledger made(hub_settings(settings),
                    [this](const std::string& text) { warnings.push_back(text); });
        made.name_programs("grains (my-code)", "fluid (openfoam)");
        return made;
    }

    static WindowResult good() {
        WindowResult result;
        result.motion.grains = result.state.grains = test_population();
        result.kicks.kicks.resize(3);
        return result;
    }

    /// The ledger's message; empty if it accepts.
    std::string complaint() {
        try {
            Window window;
            window.index = 7;
            ledger.check(window, result);
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

TEST_F(LedgerTest, BoundsTheOverlap) {
    result.state.report.max_penetration = 0.2;
    EXPECT_EQ(complaint(), "");
    result.state.report.max_penetration = 0.21;
    EXPECT_SAYS(
        complaint(),
        "overlap of 0.21 D in window 7, reported by grains (my-code); limits.penetration = 0.2 D");
    result.state.report.max_penetration = not_a_number;
    EXPECT_NE(complaint(), "");
}

// The advice names keys of the adapter in use.
TEST_F(LedgerTest, AdvisesHowToReduceOverlaps) {
    result.state.report.max_penetration = 0.21;
    EXPECT_SAYS(complaint(), "Use a smaller time.step, or more contact.iterations.");
    Settings settings = test_settings();
    settings.set("run.md_frequency", 1.0);
    ledger = make(settings);
    EXPECT_SAYS(complaint(), "Use a smaller contact.md_overlap");
    EXPECT_EQ(complaint().find("contact.iterations"), std::string::npos);
    settings.set("grains.adapter", std::string(users_program));
    ledger = make(settings);
    EXPECT_SAYS(complaint(), "stiffer or better converged contacts in your program");
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

// limits.grain_balance_soft = 1e-8, hard 1e-4.
TEST_F(LedgerTest, WarnsOnceOfAGrainThatIsNotBalancedAndThenEndsTheRun) {
    result.grain_balance = GrainBalance{1e-8, 101};
    EXPECT_EQ(complaint(), "");
    EXPECT_TRUE(warnings.empty());
    result.grain_balance->defect = 2e-8;
    EXPECT_EQ(complaint(), "");
    EXPECT_EQ(complaint(), "");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_SAYS(warnings[0],
                "grain_balance = 2e-08 in window 7, limits.grain_balance_soft = 1e-08");
    EXPECT_SAYS(warnings[0], "fails most for grain 101");
    for (const double defect : {1.1e-4, not_a_number}) {
        result.grain_balance->defect = defect;
        const std::string text = complaint();
        EXPECT_SAYS(text, "limits.grain_balance_hard = 0.0001");
        EXPECT_SAYS(text, "masses of grains (my-code) must belong together");
        EXPECT_SAYS(text, "fluid (openfoam)");
    }
}

// limits.fluid_balance_soft = 1e-6, hard 1e-2.
TEST_F(LedgerTest, JudgesTheFluidsMomentumByItsOwnLimits) {
    result.kicks.report.momentum_defect = 2e-6;
    EXPECT_EQ(complaint(), "");
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_SAYS(warnings[0], "fluid_balance = 2e-06 in window 7");
    result.kicks.report.momentum_defect = 0.011;
    EXPECT_SAYS(complaint(), "limits.fluid_balance_hard = 0.01");
    EXPECT_SAYS(complaint(), "as reported by fluid (openfoam)");
}

TEST_F(LedgerTest, ADryRunHasNoBalances) {
    Settings dry = test_settings("split", false);
    ledger = make(dry);
    result.kicks.report.momentum_defect = 1.0;
    EXPECT_EQ(complaint(), "");
}

}  // namespace
}  // namespace turbidite
