// SPDX-License-Identifier: LGPL-2.1-or-later
//
// fluid.program: box, the fluid in space without OpenFOAM: it plays what OpenFOAM plays, and needs
// nothing of it.
#include <cmath>

#include "tests/system/fluid_files.hpp"
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const char* const settling = R"(
dimension: 3
domain: {size: [4, 5, 4], left: cyclic, right: cyclic, front: cyclic, back: cyclic}
grains: {adapter: standalone-nscd, generator: random, count: 16, region: [4, 4, 4], density_ratio: 3}
fluid: {reynolds: 20, cells_per_diameter: 6}
contact: {friction: 0.4}
scales: {kind: avalanche}
time: {step: 0.02, end: 0.4}
output: {interval: 0.1, probes: [1.1, 2, 1.3]}
)";

class BoxProgram : public ShellTest {
 protected:
    void SetUp() override { scratch.write("case.yaml", settling); }

    Answer turbidite(const std::string& words, const std::string& before = "") const {
        return shell(before + std::string(TURBIDITE_PROGRAM) + " " + words);
    }
    Answer play(const std::string& folder, const std::string& sets = "") const {
        const Answer answer = turbidite("run case.yaml --out " + folder + " " + sets);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        return answer;
    }
    Columns table(const std::string& file) const { return columns_of(text(scratch.path() / file)); }
    nlohmann::json record_of(const std::string& run) const {
        return nlohmann::json::parse(text(scratch.path() / run / "run.json"));
    }

    /// Of all columns but wall times and what solvers tell of themselves; empty cells are alike.
    void expect_alike(const std::string& one, const std::string& two, double tolerance) const {
        for (const char* file : {"/history.csv", "/probes.csv"}) {
            const Columns first = table(one + file), second = table(two + file);
            ASSERT_EQ(first.size(), second.size());
            for (const auto& [name, values] : first) {
                if (name.rfind("wall_", 0) == 0 || name == "divergence" ||
                    name.find("residual") != std::string::npos)
                    continue;
                ASSERT_EQ(values.size(), second.at(name).size());
                for (std::size_t row = 0; row < values.size(); ++row) {
                    if (std::isnan(values[row]) && std::isnan(second.at(name)[row])) continue;
                    EXPECT_NEAR(values[row], second.at(name)[row], tolerance)
                        << name << " in row " << row;
                }
            }
        }
    }
};

class BoxProgramRanks : public BoxProgram, public ::testing::WithParamInterface<const char*> {};

TEST_P(BoxProgramRanks, PlayWhatOpenFoamPlays) {
    const std::string splitting = std::string("--set fluid.splitting=") + GetParam() + " ";
    play("foam", splitting);
    play("box", splitting + "--set fluid.program=box");
    play("ranks", splitting + "--set fluid.program=box --set fluid.ranks=2");
    EXPECT_EQ(record_of("foam").at("fluid_program"), "openfoam");
    EXPECT_EQ(record_of("box").at("fluid_program"), "box");
    EXPECT_TRUE(fs::exists(scratch.path() / "foam/fluid/constant/polyMesh"));
    for (const char* of_openfoam : {"system", "constant", "0", "fluid.foam"})
        EXPECT_FALSE(fs::exists(scratch.path() / "box/fluid" / of_openfoam)) << of_openfoam;
    EXPECT_GT(largest(table("foam/history.csv").at("mean_velocity_y")), 0.05);
    expect_alike("foam", "box", 1e-10);
    expect_alike("box", "ranks", 1e-7);
}

INSTANTIATE_TEST_SUITE_P(Splittings, BoxProgramRanks,
                         ::testing::Values("marchuk-yanenko", "explicit-multiplier",
                                           "implicit-multiplier"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

/// An inflow and a free side, walls, sliding lids, layers that stretch, and all fields.
const char* const stream =
    "--set domain.left=inflow --set domain.right=free --set domain.front=wall --set "
    "domain.back=wall --set domain.motions.in.kind=constant --set "
    "\"domain.motions.in.velocity=[0.5, 0, 0]\" --set domain.motions.lid.kind=constant --set "
    "\"domain.motions.lid.velocity=[0.2, 0, 1]\" --set domain.left_motion=in --set "
    "domain.top_motion=lid --set domain.bottom_motion=lid --set \"domain.size=[4, 8, 4]\" --set "
    "fluid.stretch_ratio=1.1 --set fluid.stretch_from=5 --set \"output.fields=vorticity solid\" ";

/// What both programs have written after 20 windows is the same to the float32 of one of them.
void expect_equal_fields(const std::string& foam, const std::string& name,
                         const std::vector<float>& box) {
    ASSERT_FALSE(box.empty()) << name;
    const std::vector<double> values = openfoam_field(foam, box.size());
    ASSERT_EQ(values.size(), box.size()) << name;
    const double highest = largest(values);
    EXPECT_GT(highest, 0.05) << name;
    for (std::size_t n = 0; n < values.size(); ++n)
        ASSERT_NEAR(values[n], box[n], 1e-6 * highest) << name << " at " << n;
}

TEST_F(BoxProgram, ShowsTheFieldsOfOpenFoamBetweenMovingSides) {
    play("foam", stream);
    play("box", stream + std::string("--set fluid.program=box"));
    play("ranks", stream + std::string("--set fluid.program=box --set fluid.ranks=2"));
    EXPECT_GT(table("foam/history.csv").at("flow_x").back(), 0.3);
    EXPECT_GT(table("foam/history.csv").at("flow_z").back(), 0.005);
    expect_alike("foam", "box", 1e-10);
    expect_alike("box", "ranks", 1e-7);
    const std::string one = text(scratch.path() / "box/fluid/fields/fields_00000020.vtr"),
                      two = text(scratch.path() / "ranks/fluid/fields/fields_00000020.vtr");
    EXPECT_EQ(one.size(), two.size());
    for (const char* name : {"p", "U", "vorticity", "solid"}) {
        const std::vector<float> box = slice_array(one, name);
        expect_equal_fields(text(scratch.path() / "foam/fluid/0.4" / name), name, box);
        const std::vector<float> ranks = slice_array(two, name);
        ASSERT_EQ(ranks.size(), box.size());
        for (std::size_t n = 0; n < box.size(); ++n) ASSERT_NEAR(box[n], ranks[n], 1e-5) << name;
    }
    const std::string series = text(scratch.path() / "box/fluid/fields/fields.pvd");
    EXPECT_SAYS(series, "file=\"fields_00000020.vtr\"");
}

/// A state is read by any number of ranks.
TEST_F(BoxProgram, AResumedRunMayHaveOtherRanks) {
    for (const char* splitting : {"marchuk-yanenko", "explicit-multiplier"}) {
        const std::string name = splitting;
        play(name, stream + std::string("--set fluid.program=box --set fluid.splitting=") + name);
        for (const int before : {1, 3}) {
            const std::string parts = name + std::to_string(before);
            play(parts, stream + std::string("--set fluid.program=box --set time.end=0.2 ") +
                            "--set fluid.splitting=" + name +
                            " --set fluid.ranks=" + std::to_string(before));
            const Answer more = turbidite("resume " + parts +
                                          " --set time.end=0.4 --set "
                                          "fluid.ranks=2");
            ASSERT_EQ(more.code, 0) << more.err;
            expect_alike(name, parts, 1e-7);
        }
    }
}

TEST_F(BoxProgram, AResumedRunHasEqualBits) {
    const std::string box =
        "--set fluid.program=box --set fluid.splitting=explicit-multiplier --set "
        "checkpoint.interval=0.2 ";
    play("whole", box);
    play("parts", box + "--set time.end=0.2");
    const Answer more = turbidite("resume parts --set time.end=0.4");
    ASSERT_EQ(more.code, 0) << more.err;
    EXPECT_SAYS(text(scratch.path() / "parts/case.yaml"), "program: box");
    EXPECT_EQ(lines_of_history("whole"), lines_of_history("parts"));
    EXPECT_EQ(text(scratch.path() / "whole/probes.csv"), text(scratch.path() / "parts/probes.csv"));
    for (const char* file : {"fluid/fields/fields_00000020.vtr", "fluid/slices/z2_00000020.vtr",
                             "fluid/slices/slices.pvd", "grains/grains_00000020.vtp"}) {
        const std::string whole = text(scratch.path() / "whole" / file);
        EXPECT_FALSE(whole.empty()) << file;
        EXPECT_TRUE(whole == text(scratch.path() / "parts" / file)) << file;
    }
    // A run goes on with the program that it began with.
    const Answer other = turbidite("resume parts --set time.end=0.6 --set fluid.program=openfoam");
    EXPECT_EQ(other.code, 2);
    EXPECT_SAYS(other.err, "fluid.program is openfoam, in the checkpoint box");
}

TEST_F(BoxProgram, ReplaysItsRecording) {
    play("recorded", "--set fluid.program=box --set coupling.recording=fluid");
    const Answer again = turbidite("replay recorded --out again");
    EXPECT_EQ(again.code, 0) << again.out << again.err;
    EXPECT_FALSE(fs::exists(scratch.path() / "again/differences"));
    EXPECT_FALSE(fs::exists(scratch.path() / "again/fluid/system"));
}

/// A folder for PATH with all programs of this machine but those of OpenFOAM.
TEST_F(BoxProgram, PlaysWhereOpenFoamIsNotInstalled) {
    ASSERT_EQ(
        shell("mkdir bin && ln -s /usr/local/bin/* /usr/bin/* /bin/* bin 2>/dev/null; "
              "for f in $(dpkg-query -L openfoam | grep ^/usr/bin/); do rm -f bin/${f##*/}; done; "
              "test -e bin/mpirun && ! test -e bin/blockMesh")
            .code,
        0);
    const std::string without =
        "env -u WM_PROJECT_DIR PATH=" + (scratch.path() / "bin").string() + " ";
    EXPECT_SAYS(turbidite("doctor --no-job", without).out,
                "missing OpenFOAM                    not installed; spheres in space are played "
                "without it");
    const Answer checked = turbidite("check case.yaml", without);
    EXPECT_EQ(checked.code, 0) << checked.err;
    EXPECT_SAYS(checked.out, "fluid.program: auto is box here");
    const Answer played = turbidite("run case.yaml --out run", without);
    ASSERT_EQ(played.code, 0) << played.out << played.err;
    EXPECT_SAYS(played.out, "OpenFOAM is not installed");
    EXPECT_SAYS(played.out, "fluid/fields/fields.pvd");
    EXPECT_EQ(record_of("run").at("fluid_program"), "box");
    EXPECT_EQ(table("run/history.csv").at("time").back(), 0.4);
    const Answer more = turbidite("resume run --set time.end=0.5", without);
    EXPECT_EQ(more.code, 0) << more.err;
    const Answer plane = turbidite(
        "run case.yaml --out plane --set dimension=2 --set 'domain.size=[4, 5]' --set "
        "'grains.region=[4, 4]' --set grains.shape=disc --set grains.count=4 --set domain.front=~ "
        "--set domain.back=~ --set output.probes=~",
        without);
    EXPECT_EQ(plane.code, 2) << plane.out;
    EXPECT_SAYS(plane.err, "blockMesh of OpenFOAM 1912 (Debian package openfoam) is missing");
    EXPECT_SAYS(plane.err, "choose another adapter or fluid.program");
    EXPECT_FALSE(fs::exists(scratch.path() / "plane")) << "nothing was started";
    EXPECT_EQ(turbidite("check case.yaml --set fluid.program=openfoam", without).code, 2);
}

/// Nothing of OpenFOAM is loaded with the program.
TEST_F(BoxProgram, LinksNoOpenFoam) {
    const auto libraries = [&](const std::string& program) {
        return shell("ldd " TURBIDITE_BUILD_DIR "/bin/" + program).out;
    };
    EXPECT_SAYS(libraries("turbidite-fluid"), "libfiniteVolume");
    const std::string own = libraries("turbidite-fluid-box");
    EXPECT_SAYS(own, "libfftw3");
    for (const char* library : {"libfiniteVolume", "libOpenFOAM", "libmeshTools", "libPstream"})
        EXPECT_EQ(own.find(library), std::string::npos) << own;
}

TEST_F(BoxProgram, AKilledOneIsNamed) {
    const pid_t run = begin(std::string(TURBIDITE_PROGRAM) +
                            " run case.yaml --set fluid.program=box --set time.end=500 --set "
                            "output.interval=0.02" +
                            into_run_folder());
    for (int i = 0; i < 3000 && rows_of_history() < 4; ++i)
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const auto victim = processes(run_folder(), "turbidite-fluid-box");
    ASSERT_EQ(victim.size(), 1u);
    kill(victim[0], SIGKILL);
    const Answer answer = end_of(run);
    EXPECT_EQ(answer.code, 4);
    EXPECT_SAYS(answer.err, "The run failed: fluid rank 0 was ended by signal 9");
    expect_nothing_left(run_folder());
    EXPECT_GE(rows_of_history(), 4);
}

}  // namespace
}  // namespace turbidite
