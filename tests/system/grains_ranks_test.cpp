// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains of the contact engine on several ranks: the same digits in every file for any number of
// ranks, in one part or in several; of spheres also those of one rank, with any number of threads.
#include <cmath>
#include <map>

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

// A heap that is wide enough for several cells, and spreads over their borders.
const char* const in_space = R"(
dimension: 3
domain: {size: [24, 9, 6], front: cyclic, back: cyclic, right: free}
grains: {adapter: standalone-nscd, generator: lattice, region: [16, 4, 6], compacity: 0.55, jitter: 0.02}
)";

// Wider.
const char* const in_the_plane = R"(
domain: {size: [60, 12], right: free}
grains: {adapter: standalone-nscd, generator: lattice, region: [40, 6], compacity: 0.829, jitter: 0.02}
)";

const char* const dry_heap = R"(
fluid: {enabled: false}
contact: {friction: 0.3}
time: {step: 0.02, end: 2}
output: {interval: 0.5}
checkpoint: {interval: 1}
)";

class GrainsRanks : public ShellTest {
 protected:
    void write_case(const std::string& grains) const {
        scratch.write("case.yaml", grains + dry_heap);
    }
    Answer turbidite(const std::string& words) const {
        return shell(std::string("timeout 170 ") + TURBIDITE_PROGRAM + " " + words);
    }
    void play(const std::string& words) const {
        const Answer answer = turbidite(words);
        ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    }
    std::string file(const std::string& run, const std::string& name) const {
        return text(scratch.path() / run / name);
    }
    void expect_the_same(const std::string& one, const std::string& other) const {
        EXPECT_EQ(lines_of_history(one), lines_of_history(other));
        for (const char* name : {"grains/grains_00000050.vtp", "grains/grains_00000100.vtp",
                                 "grains/contacts_00000100.vtp"}) {
            EXPECT_GT(file(one, name).size(), 10000u) << name;
            EXPECT_EQ(file(one, name), file(other, name)) << name;
        }
    }
    std::vector<double> all(const std::string& run, const std::string& column) const {
        return columns_of(file(run, "history.csv")).at(column);
    }
};

class SpaceRanks : public GrainsRanks {
 protected:
    void SetUp() override { write_case(in_space); }
};

class PlaneRanks : public GrainsRanks {
 protected:
    void SetUp() override { write_case(in_the_plane); }
};

TEST_F(SpaceRanks, HaveTheDigitsOfOne) {
    play("run case.yaml --out one");
    EXPECT_GT(all("one", "contacts").back(), 200);
    for (const char* others :
         {"--set grains.ranks=2", "--set grains.ranks=3", "--set grains.ranks=4",
          "--set contact.threads=2", "--set grains.ranks=2 --set contact.threads=2"}) {
        std::filesystem::remove_all(scratch.path() / "other");
        play(std::string("run case.yaml --out other ") + others);
        expect_the_same("one", "other");
    }
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / "other/logs/grains.rank1.log"));
}

TEST_F(SpaceRanks, GoOnOnAnotherNumberOfRanks) {
    play("run case.yaml --out one");
    play("run case.yaml --out parts --set grains.ranks=2 --set time.end=1");
    play("resume parts --set grains.ranks=3 --set time.end=1.5");
    play("resume parts --set grains.ranks=1 --set time.end=2");
    expect_the_same("one", "parts");
}

TEST_F(SpaceRanks, AKilledOneEndsTheRun) {
    const pid_t run = begin(std::string("timeout 100 ") + TURBIDITE_PROGRAM + " run case.yaml" +
                            into_run_folder() +
                            " --set grains.ranks=2 --set time.end=500 --set output.interval=0.02");
    for (int i = 0; i < 3000 && rows_of_history() < 4; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::vector<pid_t> ranks = processes(run_folder(), "turbidite-grains");
    ASSERT_EQ(ranks.size(), 2u);
    kill(ranks[1], SIGKILL);
    const Answer answer = end_of(run);
    EXPECT_EQ(answer.code, 4);
    EXPECT_SAYS(answer.err, "The run failed: grains rank");
    EXPECT_SAYS(answer.err, "was ended by signal 9");
    expect_nothing_left(run_folder());
}

TEST_F(SpaceRanks, ThatDoNotPayAreTold) {
    const Answer answer = turbidite("check case.yaml --set grains.ranks=2");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out + answer.err, "grains.ranks = 2");
    EXPECT_SAYS(answer.out + answer.err, "Use grains.ranks = 1");
}

// In the plane one rank takes contacts in another order: where few of them share a grain, both are
// the same to the tolerance (PlaneRanks of the unit tests), in a dense heap to some per cent.
TEST_F(PlaneRanks, HaveTheSameDigitsFromTwoOn) {
    play("run case.yaml --out one");
    play("run case.yaml --out two --set grains.ranks=2");
    EXPECT_GT(all("two", "contacts").back(), 200);
    for (const char* ranks : {"3", "4"}) {
        std::filesystem::remove_all(scratch.path() / "other");
        play(std::string("run case.yaml --out other --set grains.ranks=") + ranks);
        expect_the_same("two", "other");
    }
    EXPECT_NE(lines_of_history("one"), lines_of_history("two"));
    for (const char* column : {"mean_velocity_norm", "mean_position_y", "front_x"})
        EXPECT_LT(largest_difference(all("one", column), all("two", column)),
                  0.05 * largest(all("one", column)))
            << column;
}

TEST_F(PlaneRanks, GoOnOnAnotherNumberOfRanks) {
    play("run case.yaml --out whole --set grains.ranks=2");
    play("run case.yaml --out parts --set grains.ranks=2 --set time.end=1");
    play("resume parts --set grains.ranks=4 --set time.end=1.5");
    play("resume parts --set grains.ranks=3 --set time.end=2");
    expect_the_same("whole", "parts");
}

}  // namespace
}  // namespace turbidite
