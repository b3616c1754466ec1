// SPDX-License-Identifier: LGPL-2.1-or-later
//
// When grains that were poured are at rest, and that nothing plays those that take their place.
#include "launcher/job/pour_grains.hpp"

#include <gtest/gtest.h>

#include "coupler/protocol/failure.hpp"
#include "launcher/job/play_run.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

class PourGrains : public ::testing::Test {
 protected:
    ScratchFolder scratch;

    bool rests(double time, double energy) const {
        scratch.write("history.csv", "step,time,mean_position_y,kinetic_energy\n0,0,9,1e-9\n1," +
                                         std::to_string(time) + ",9," + std::to_string(energy) +
                                         "\n");
        return is_at_rest(scratch.path() / "history.csv", 1e-3);
    }
};

TEST_F(PourGrains, AreAtRestAtTheEndOfAPieceOnly) {
    EXPECT_TRUE(rests(10.0, 2e-5));
    EXPECT_TRUE(rests(30.0, 2e-5));
    EXPECT_FALSE(rests(30.0, 3e-4));
    EXPECT_FALSE(rests(0.0, 0.0));
    // What an interruption has left, and what a pouring in progress shows, depend on when.
    EXPECT_FALSE(rests(15.0, 2e-5));
    EXPECT_FALSE(rests(9.99, 2e-5));
    EXPECT_FALSE(is_at_rest(scratch.path() / "nowhere.csv", 1e-3));
}

TEST_F(PourGrains, NothingPlaysTheirStandIns) {
    scratch.write("case.yaml", R"(
dimension: 3
domain: {size: [6, 9, 6]}
grains: {adapter: standalone-nscd, generator: poured, count: 20}
fluid: {enabled: false}
time: {step: 0.01, end: 1}
)");
    const ResolvedCase resolved = load_case(scratch.path() / "case.yaml");
    try {
        prepare(resolved, {scratch.path() / "run", false}, this_site());
        FAIL() << "a lattice was taken for a packing";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("not poured"), std::string::npos)
            << failure.what();
    }
}

}  // namespace
}  // namespace turbidite
