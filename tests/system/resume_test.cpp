// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Runs in two parts have the history of runs in one part, digit for digit, with every adapter and
// every way in which the fluid passes something from window to window.

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

// Twenty discs that have reached the bottom after 2 t_c, with contacts throughout.
const char* const wet_case = R"(
domain: {size: [6, 6]}
grains: {generator: lattice, region: [6, 4.5], compacity: 0.82, jitter: 0.01, density_ratio: 1.5}
fluid: {reynolds: 36, cells_per_diameter: 6}
contact: {friction: 0.3}
scales: {kind: avalanche}
time: {step: 0.0125, end: 2}
output: {interval: 0.25}
checkpoint: {interval: 0.4}
)";

const char* const dry_case = R"(
domain:
  size: [8, 8]
  left_motion: shaking
  walls_file: walls.csv
  motions:
    shaking: {kind: harmonic, amplitude: [0.2, 0], period: 0.7}
grains: {generator: random, count: 20, region: [5, 5]}
fluid: {enabled: false}
contact: {friction: 0.3}
scales: {kind: avalanche}
time: {step: 0.0125, end: 2}
output: {interval: 0.25}
checkpoint: {interval: 0.4}
)";

class Resume : public ShellTest {
 protected:
    Answer turbidite(const std::string& words) const {
        return shell(std::string("timeout 170 ") + TURBIDITE_PROGRAM + " " + words);
    }

    nlohmann::json record_of(const std::string& run) const {
        return nlohmann::json::parse(text(scratch.path() / run / "run.json"));
    }

    void expect_done(const Answer& answer) const {
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    }

    /// The job alone: without the report, which takes longer than these runs.
    void play(const std::string& words) const {
        const Answer line = turbidite(words + " --dry-run");
        ASSERT_EQ(line.code, 0) << line.err;
        expect_done(shell(line.out.substr(0, line.out.size() - 1)));
    }

    /// In one part as `whole`, and up to 1.05 t_c, out of turn of the output, then to the end.
    void play_both(const std::string& changes, const std::string& resumed = "") const {
        play("run case.yaml --out whole" + changes);
        play("run case.yaml --out parts" + changes + " --set time.end=1.05");
        EXPECT_EQ(lines_of_history("parts").size(), 7u);  // header, t = 0, 0.25 to 1, 1.05
        play("resume parts --set time.end=2" + resumed);
    }

    void expect_the_same() const {
        EXPECT_EQ(lines_of_history("whole").size(), 10u);
        EXPECT_EQ(lines_of_history("parts"), lines_of_history("whole"));
        EXPECT_EQ(text(scratch.path() / "parts/grains/grains.pvd"),
                  text(scratch.path() / "whole/grains/grains.pvd"));
        EXPECT_EQ(record_of("parts").at("maxima"), record_of("whole").at("maxima"));
        const auto parts = record_of("parts").at("parts");
        ASSERT_EQ(parts.size(), 2u);
        EXPECT_EQ(parts[1].at("from_window"), 84);
        EXPECT_EQ(parts[1].at("windows_done"), 160);
        EXPECT_EQ(parts[1].at("overrides")[0], "time.end=2");
    }
};

struct Variant {
    const char* name;
    const char* changes;
};
class EveryVariant : public Resume, public testing::WithParamInterface<Variant> {};

TEST_P(EveryVariant, GoesOnDigitForDigit) {
    scratch.write("case.yaml", wet_case);
    play_both(GetParam().changes);
    expect_the_same();
    EXPECT_GT(columns_of(text(scratch.path() / "whole/history.csv")).at("contacts").back(), 2);
}

INSTANTIATE_TEST_SUITE_P(
    Variants, EveryVariant,
    testing::Values(
        Variant{"YadeJoint", " --set grains.adapter=yade-nscd"},
        Variant{"YadeSplit", " --set grains.adapter=yade-nscd --set coupling.scheme=split"},
        Variant{"StandaloneSplit",
                " --set grains.adapter=standalone-nscd --set coupling.scheme=split"},
        Variant{"Springs", " --set grains.adapter=standalone-md"},
        Variant{"SpringsInRepeatedWindows",
                " --set grains.adapter=standalone-md --set coupling.scheme=sub-iterated"},
        Variant{"ExplicitMultiplier",
                " --set grains.adapter=standalone-nscd --set fluid.splitting=explicit-multiplier"},
        Variant{"ImplicitMultiplier",
                " --set grains.adapter=standalone-nscd --set fluid.splitting=implicit-multiplier"},
        Variant{"FirstOrder",
                " --set grains.adapter=standalone-nscd --set fluid.time_scheme=first-order --set "
                "'fluid.transport_scheme=Gauss limitedLinearV 1'"},
        Variant{"OwnSolversOfTheFluid",
                " --set grains.adapter=standalone-nscd --set fluid.pressure_solver=PCG --set "
                "fluid.pressure_tolerance=1e-9"},
        Variant{"TwoFluidRanks", " --set grains.adapter=standalone-nscd --set fluid.ranks=2"},
        Variant{"ColumnsOfRanks",
                " --set grains.adapter=standalone-nscd --set fluid.ranks=2 --set "
                "fluid.decomposition=columns"},
        Variant{"Bonds",
                " --set grains.adapter=standalone-nscd --set contact.adhesion=capillary --set "
                "contact.adhesion_force=0.2 --set contact.adhesion_range=0.05 --set "
                "contact.adhesion_length=0.05"}),
    [](const auto& info) { return std::string(info.param.name); });

// Its last row, which no turn of the output has, is not one of the longer run.
TEST_F(Resume, ARunShorterThanItsOutputIntervalGoesOnWithTheRowsOfTheWhole) {
    scratch.write("case.yaml", wet_case);
    const std::string box = " --set fluid.enabled=false --set output.interval=0.75";
    play("run case.yaml --out whole --set time.end=2" + box);
    play("run case.yaml --out parts --set time.end=0.5" + box);
    EXPECT_EQ(lines_of_history("parts").size(), 3u);  // header, t = 0, 0.5
    play("resume parts --set time.end=2");
    EXPECT_EQ(lines_of_history("whole").size(), 5u);  // 0.75, 1.5, 2
    EXPECT_EQ(lines_of_history("parts"), lines_of_history("whole"));
}

TEST_F(Resume, WallsThatMoveGoOnWhereTheyWere) {
    scratch.write("case.yaml", dry_case);
    scratch.write("walls.csv", "id,x1,y1,x2,y2,spin,px,py\n1,6,2,7,2,0.3,6.5,2\n");
    for (const char* adapter : {"standalone-nscd", "yade-nscd"}) {
        shell("rm -rf whole parts");
        play_both(std::string(" --set grains.adapter=") + adapter);
        expect_the_same();
    }
}

/// Largest relative difference of a column, of its largest value.
double difference(const Columns& one, const Columns& two, const std::string& column) {
    return largest_difference(one.at(column), two.at(column)) / largest(one.at(column));
}

// YADE adds up the forces on a grain in the order in which contacts were found, which O.load does
// not bring back: the last bits differ, and with them columns that consist of nothing else.
TEST_F(Resume, MolecularDynamicsGoesOnUpToTheOrderOfSums) {
    scratch.write("case.yaml", wet_case);
    play_both(" --set grains.adapter=yade-md --set coupling.scheme=split");
    const Columns one = columns_of(text(scratch.path() / "whole/history.csv"));
    const Columns two = columns_of(text(scratch.path() / "parts/history.csv"));
    EXPECT_EQ(one.at("contacts").back(), two.at("contacts").back());
    EXPECT_GT(one.at("contacts").back(), 10);
    for (const char* column : {"mean_velocity_x", "mean_velocity_y", "mean_position_x",
                               "kinetic_energy", "sliding_share", "contact_work", "sigma_xy"})
        EXPECT_LT(difference(one, two, column), 1e-9) << column;
}

TEST_F(Resume, LammpsGoesOnOnAsManyRanksOnly) {
    scratch.write("case.yaml", wet_case);
    play(
        "run case.yaml --out parts --set time.end=1 --set grains.adapter=lammps-md"
        " --set coupling.scheme=split --set grains.ranks=2");
    const Answer answer = turbidite("resume parts --set time.end=2 --set grains.ranks=1");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err,
                "cannot go on with grains.ranks = 1: lammps-md reads its state on as many ranks "
                "as saved it");
    EXPECT_SAYS(answer.err, "Use grains.ranks = 2");
    play("resume parts --set time.end=2");  // the folder is as it was
}

struct OtherRanks {
    const char* name;
    const char* changes;
    double limit;
};
class EveryDecomposition : public Resume, public testing::WithParamInterface<OtherRanks> {};

// Sums over cells are taken in another order.
TEST_P(EveryDecomposition, GoesOnWithAnotherNumberOfFluidRanks) {
    scratch.write("case.yaml", wet_case);
    play_both(std::string(" --set grains.adapter=standalone-nscd --set contact.tolerance=1e-9 "
                          "--set fluid.multiplier_tolerance=1e-9") +
                  GetParam().changes,
              " --set fluid.ranks=2");
    EXPECT_TRUE(fs::exists(scratch.path() / "parts/fluid/processor1/2/U"));
    const Columns one = columns_of(text(scratch.path() / "whole/history.csv"));
    const Columns two = columns_of(text(scratch.path() / "parts/history.csv"));
    for (const char* column : {"mean_velocity_y", "mean_position_y", "mean_speed"})
        EXPECT_LT(difference(one, two, column), GetParam().limit) << column;
    play("resume parts --set time.end=2.1 --set fluid.ranks=1");
}

INSTANTIATE_TEST_SUITE_P(
    Ranks, EveryDecomposition,
    testing::Values(
        OtherRanks{"Split", " --set coupling.scheme=split", 1e-7},
        OtherRanks{"FirstOrder",
                   " --set coupling.scheme=split --set fluid.time_scheme=first-order --set "
                   "'fluid.transport_scheme=Gauss limitedLinearV 1'",
                   1e-7},
        OtherRanks{"ExplicitMultiplier", " --set fluid.splitting=explicit-multiplier", 1e-4}),
    [](const auto& info) { return std::string(info.param.name); });

// Before the next checkpoint: what lies in fluid/ is of the last attempt, the checkpoint of two.
TEST_F(Resume, AnotherNumberOfFluidRanksMayBeTakenBack) {
    scratch.write("wet.yaml", wet_case);
    expect_done(
        turbidite("run wet.yaml --set grains.adapter=standalone-nscd --set fluid.ranks=2 "
                  "--set time.end=0.5 --out r"));
    const auto processors = [&](const fs::path& folder) {
        int count = 0;
        for (const auto& entry : fs::directory_iterator(scratch.path() / folder))
            count += entry.path().filename().string().rfind("processor", 0) == 0;
        return count;
    };
    // A user has removed the logs of earlier parts.
    scratch.write("r/logs/part-3/coupler.log", "of the third part");
    for (const int ranks : {1, 3}) {
        const std::string other = " --set fluid.ranks=" + std::to_string(ranks) + " --dry-run";
        const Answer answer = turbidite("resume r --set time.end=0.6" + other);
        EXPECT_EQ(answer.code, 0) << answer.err;
        EXPECT_EQ(processors("r/fluid"), ranks == 1 ? 0 : ranks);
    }
    expect_done(
        turbidite("resume r --set time.end=0.6 --set fluid.ranks=2 "
                  "--set contact.iterations=3000"));
    // A study must not take it for the default of another version.
    const auto given = record_of("r").at("given");
    EXPECT_NE(std::find(given.begin(), given.end(), "contact.iterations"), given.end());
    EXPECT_EQ(processors("r/fluid"), 2);
    for (const auto& entry : fs::directory_iterator(scratch.path() / "r/fluid"))
        EXPECT_NE(entry.path().filename().string().rfind("until-", 0), 0u) << entry.path();
    EXPECT_EQ(text(scratch.path() / "r/logs/part-3/coupler.log"), "of the third part");
    EXPECT_TRUE(fs::exists(scratch.path() / "r/logs/part-6"));
}

// The folders of processors are put aside one by one.
TEST_F(Resume, FieldsOutliveAChangeOfFluidRanksThatWasCutOff) {
    scratch.write("wet.yaml", wet_case);
    expect_done(
        turbidite("run wet.yaml --set grains.adapter=standalone-nscd --set fluid.ranks=2 "
                  "--set time.end=0.5 --set output.fields_interval=0.5 --out r"));
    const fs::path fluid = scratch.path() / "r/fluid";
    EXPECT_EQ(turbidite("resume r --set time.end=0.6 --set fluid.ranks=1 --dry-run").code, 0);
    fs::path aside;
    for (const auto& entry : fs::directory_iterator(fluid))
        if (entry.path().filename().string().rfind("until-", 0) == 0) aside = entry.path();
    ASSERT_TRUE(fs::exists(aside / "processor1/0.5/U"));
    fs::rename(aside / "processor1", fluid / "processor1");
    EXPECT_EQ(turbidite("resume r --set time.end=0.6 --set fluid.ranks=3 --dry-run").code, 0);
    EXPECT_TRUE(fs::exists(aside / "processor1/0.5/U"));
    expect_done(turbidite("resume r --set time.end=0.6 --set fluid.ranks=2"));
    for (const char* field : {"processor0/0.5/U", "processor1/0.5/U", "processor1/constant"})
        EXPECT_TRUE(fs::exists(fluid / field)) << field;
    EXPECT_FALSE(fs::exists(fluid / "decomposing"));

    // As many folders as ranks, but of a decomposition that did not end.
    EXPECT_EQ(turbidite("resume r --set time.end=0.7 --set fluid.ranks=3 --dry-run").code, 0);
    fs::remove_all(fluid / "processor1/constant");
    scratch.write("r/fluid/decomposing", "");
    expect_done(turbidite("resume r --set time.end=0.7 --set fluid.ranks=3"));
    EXPECT_FALSE(fs::exists(fluid / "decomposing"));
}

TEST_F(Resume, ADamagedCheckpointIsPassedOver) {
    scratch.write("case.yaml", wet_case);
    const std::string changes = " --set grains.adapter=standalone-nscd";
    play("run case.yaml --out whole" + changes);
    play("run case.yaml --out parts" + changes + " --set time.end=1.05");
    shell("printf x | dd of=parts/checkpoints/w00000084/fluid.rank0 bs=1 seek=1000 conv=notrunc");
    const Answer answer = turbidite("resume parts --set time.end=2");
    expect_done(answer);
    EXPECT_SAYS(answer.err,
                "fluid.rank0 is damaged: its checksum differs; the one before it is used");
    EXPECT_SAYS(answer.out, "goes on after window 64, 0.8 t_c");
    EXPECT_EQ(lines_of_history("parts"), lines_of_history("whole"));
}

TEST_F(Resume, WhatCannotGoOnIsRefusedWithTheReason) {
    scratch.write("case.yaml", wet_case);
    expect_done(
        turbidite("run case.yaml --out run --set grains.adapter=standalone-nscd --set "
                  "time.end=0.5"));
    const Answer complete = turbidite("resume run");
    EXPECT_EQ(complete.code, 0);
    EXPECT_SAYS(complete.out, "The run in run is complete.");
    const Answer other = turbidite("resume run --set time.end=1 --set contact.friction=0.5");
    EXPECT_EQ(other.code, 2);
    EXPECT_SAYS(other.err, "contact.friction is 0.5, in the checkpoint 0.3");
    EXPECT_SAYS(other.err, "These keys may change: time.end, ");
    const Answer file = turbidite("resume run --set time.end=1 --set grains.file=nowhere.csv");
    EXPECT_EQ(file.code, 2);
    EXPECT_SAYS(file.err, "grains.file is given, and the run has its copy of that file");
    const Answer shorter = turbidite("resume run --set time.end=0.2");
    EXPECT_EQ(shorter.code, 2);
    EXPECT_SAYS(shorter.err, "has already done 40 windows, time.end = 0.2 t_c is 16");
    const Answer nowhere = turbidite("resume nowhere");
    EXPECT_EQ(nowhere.code, 2);
    EXPECT_SAYS(nowhere.err, "is not a run folder: it has no case.yaml");
    for (const char* set : {"w00000040", "w00000032"})
        shell(std::string("printf x | dd of=run/checkpoints/") + set +
              "/coupler bs=1 seek=50 conv=notrunc");
    const Answer damaged = turbidite("resume run --set time.end=1");
    EXPECT_EQ(damaged.code, 2);
    EXPECT_SAYS(damaged.err, "has no whole checkpoint: w00000040, w00000032");
}

// There is no checkpoint to compare with, and what may change is recorded all the same.
TEST_F(Resume, BeforeTheFirstWindowTheSameKeysMayChange) {
    scratch.write("case.yaml", wet_case);
    ASSERT_EQ(turbidite("run case.yaml --out run --dry-run").code, 0);
    const Answer other = turbidite("resume run --dry-run --set contact.friction=0.5");
    EXPECT_EQ(other.code, 2) << other.out;
    EXPECT_SAYS(other.err, "contact.friction is 0.5, in the run so far 0.3");
    const Answer longer = turbidite("resume run --dry-run --set time.end=0.7");
    EXPECT_EQ(longer.code, 0) << longer.err;
    EXPECT_EQ(record().at("parts").at(0).at("overrides").at(0), "time.end=0.7");
    EXPECT_EQ(record().at("given").back(), "time.end");
}

TEST_F(Resume, PrintsTheLineForABatchScript) {
    scratch.write("case.yaml", dry_case);
    scratch.write("walls.csv", "id,x1,y1,x2,y2\n1,6,2,7,2\n");
    const std::string changes = " --set grains.adapter=standalone-nscd";
    play("run case.yaml --out whole" + changes);
    play("run case.yaml --out parts" + changes + " --set time.end=1.05");
    const Answer answer = turbidite("resume parts --set time.end=2 --dry-run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    ASSERT_EQ(answer.out.rfind("mpirun ", 0), 0u) << answer.out;
    expect_done(shell(answer.out.substr(0, answer.out.size() - 1)));
    EXPECT_EQ(lines_of_history("parts"), lines_of_history("whole"));
}

// As a batch system starts the job of a lost node again, which lost what had been played since.
TEST_F(Resume, ALineOfADryRunThatWasPlayedIsRefused) {
    scratch.write("case.yaml", dry_case);
    scratch.write("walls.csv", "id,x1,y1,x2,y2\n1,6,2,7,2\n");
    const auto line = [&](const std::string& words) {
        const Answer answer = turbidite(words + " --set grains.adapter=standalone-nscd --dry-run");
        EXPECT_EQ(answer.code, 0) << answer.err;
        return answer.out.substr(0, answer.out.size() - 1);
    };
    const auto expect_refused = [&](const std::string& words, const std::string& why) {
        const auto before = lines_of_history("r");
        const std::string record = text(scratch.path() / "r/run.json");
        const Answer again = shell(words);
        EXPECT_EQ(again.code, 2) << again.out << again.err;
        EXPECT_SAYS(again.err, why);
        EXPECT_SAYS(again.err, "resume " + (scratch.path() / "r").string());
        EXPECT_EQ(lines_of_history("r"), before);
        EXPECT_EQ(text(scratch.path() / "r/run.json"), record);
    };
    const std::string first = line("run case.yaml --out r --set time.end=1");
    expect_done(shell(first));
    expect_refused(first, "has windows that are done, and this line would begin it again");

    const Answer next = turbidite("resume r --set time.end=2 --dry-run");
    const std::string second = next.out.substr(0, next.out.size() - 1);
    expect_done(shell(second));
    expect_refused(second, "has got as far as checkpoint w00000160, and this line would go back");
    fs::remove_all(scratch.path() / "r/checkpoints");
    expect_refused(second, "has no checkpoint w00000080 any more");
}

TEST_F(Resume, ALineOfADryRunKeepsOthersOutOfItsFolder) {
    scratch.write("case.yaml", dry_case);
    scratch.write("walls.csv", "id,x1,y1,x2,y2\n1,6,2,7,2\n");
    const Answer answer = turbidite(
        "run case.yaml --out r --set grains.adapter=standalone-nscd --set time.end=1000 --dry-run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    scratch.write("job.sh", answer.out.substr(0, answer.out.size() - 1) + " &\n" + R"sh(
until [ "$(wc -l < r/history.csv 2>/dev/null || echo 0)" -gt 4 ]; do sleep 0.05; done
"$1" resume r; echo "resume $?"
touch r/STOP
wait %1; echo "job $?"
)sh");
    const Answer both = shell(std::string("timeout 100 bash job.sh ") + TURBIDITE_PROGRAM);
    EXPECT_SAYS(both.err, "is in use by a run that has not ended");
    EXPECT_SAYS(both.out, "resume 2\n");
    EXPECT_SAYS(both.out, "job 130\n");
    EXPECT_FALSE(fs::exists(scratch.path() / "r/lock"));
    EXPECT_EQ(turbidite("resume r --dry-run").code, 0);
}

}  // namespace
}  // namespace turbidite
