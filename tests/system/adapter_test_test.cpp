// SPDX-License-Identifier: LGPL-2.1-or-later
//
// turbidite adapter-test: the shipped adapters conform, and one that does not is told what it
// lacks.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class AdapterTest : public ShellTest {
 protected:
    Answer judge(const std::string& candidate) const {
        return shell(std::string("timeout 150 ") + TURBIDITE_PROGRAM + " adapter-test " +
                     candidate);
    }
};

class ShippedAdapter : public AdapterTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(ShippedAdapter, Conforms) {
    const Answer answer = judge(std::string("--adapter ") + GetParam());
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "\nconforms\n");
    for (const char* requirement :
         {"falls freely without a fluid", "settles in a linear drag (split)",
          "lands and comes to rest", "collides and keeps momentum", "announces grains that leave",
          "ends in order on a stop request", "repeats itself", "goes on from a checkpoint"})
        EXPECT_SAYS(answer.out, std::string("ok    ") + requirement);
    const bool springs = std::string(GetParam()).ends_with("-md");
    EXPECT_SAYS(answer.out,
                std::string(springs ? "-     " : "ok    ") + "uses the fluid's inertia");
}

INSTANTIATE_TEST_SUITE_P(Adapters, ShippedAdapter,
                         ::testing::Values("standalone-nscd", "yade-nscd", "yade-md", "lammps-md"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

// Grains without contacts: turbidite-falling-grains, under its own name.
TEST_F(AdapterTest, SaysWhatAnAdapterLacks) {
    const Answer answer = judge("-- " FALLING_GRAINS);
    EXPECT_EQ(answer.code, 1) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "ok    falls freely without a fluid");
    EXPECT_SAYS(answer.out, "ok    uses the fluid's inertia");
    EXPECT_SAYS(answer.out, "FAILS lands and comes to rest             grains sink into the floor");
    EXPECT_SAYS(answer.out, "FAILS collides and keeps momentum         two grains that met");
    EXPECT_SAYS(answer.out, "FAILS announces grains that leave         3 grains at the end");
    EXPECT_SAYS(answer.out, "3 requirements are not met");
}

TEST_F(AdapterTest, NeedsAProgramThatIsThere) {
    EXPECT_EQ(judge("").code, 2);
    EXPECT_SAYS(judge("-- no-such-program").err, "no executable program no-such-program");
    EXPECT_SAYS(judge("--adapter nonsense").err, "nonsense");
    EXPECT_EQ(judge("--adapter nonsense").code, 2);
}

}  // namespace
}  // namespace turbidite
