// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What is installed plays without the tree that it was built in, and the Debian packages hold it.
#include "launcher/version.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

class Installed : public ShellTest {
 protected:
    void SetUp() override {
        const Answer answer =
            shell(CMAKE_PROGRAM " --install " TURBIDITE_BUILD_DIR
                                " --component run --prefix there && mv there usr");
        ASSERT_EQ(answer.code, 0) << answer.err;
    }

    /// With nothing in the environment that could lead to the build.
    Answer turbidite(const std::string& words) const {
        return shell(
            "env -i PATH=/usr/bin:/bin HOME=$PWD LANG=C.UTF-8 timeout 200 usr/bin/turbidite " +
            words);
    }
};

TEST_F(Installed, PlaysAShippedCaseByItsNameAndWritesItsReport) {
    const std::string short_run = " --set time.end=0.5 --set output.interval=0.25 --out ";
    const Answer wet = turbidite("run quickstart" + short_run + "wet");
    EXPECT_EQ(wet.code, 0) << wet.out << wet.err;
    EXPECT_TRUE(fs::exists(scratch.path() / "wet/report.html"));
    EXPECT_SAYS(text(scratch.path() / "wet/run.json"), "\"commit\"");
    const Answer lammps =
        turbidite("run quickstart --set grains.adapter=lammps-md --set coupling.scheme=split" +
                  short_run + "lammps");
    EXPECT_EQ(lammps.code, 0) << lammps.out << lammps.err;
    const Answer python = shell(
        "env -i PATH=/usr/bin:/bin PYTHONPATH=usr/lib/python3/dist-packages python3 -B -c "
        "'import turbidite as t; print(t.load(\"wet\").state, t.places.program())'");
    EXPECT_EQ(python.out, "done " + fs::canonical(scratch.path()).string() +
                              "/usr/lib/turbidite/bin/turbidite\n")
        << python.err;
    const Answer doctor = turbidite("doctor --no-job");
    EXPECT_EQ(doctor.code, healthy()) << doctor.out;
    EXPECT_SAYS(doctor.out, "turbidite_yade.so           installed");
}

// The package depends on LAMMPS' library alone, a source tree on its headers, too.
TEST_F(Installed, IsWholeWithoutHeaders) {
    scratch.write("bin/dpkg-query",
                  "#!/bin/sh\n"
                  "case $* in *-dev*) exit 1 ;; esac\n"
                  "exec /usr/bin/dpkg-query \"$@\"\n");
    fs::permissions(scratch.path() / "bin/dpkg-query", fs::perms::owner_all);
    const Answer doctor =
        shell("env -i PATH=$PWD/bin:/usr/bin:/bin HOME=$PWD usr/bin/turbidite doctor --no-job");
    EXPECT_EQ(doctor.code, healthy()) << doctor.out;
    EXPECT_SAYS(doctor.out, "ok      LAMMPS");
}

// A file that names the build would work here and nowhere else.
TEST_F(Installed, KnowsNothingOfTheBuild) {
    const Answer paths = shell(
        "for file in $(find usr -type f); do readelf -d $file 2>/dev/null; done | grep -c RUNPATH; "
        "for file in $(find usr -type f); do readelf -d $file 2>/dev/null; done | grep RUNPATH | "
        "grep " TURBIDITE_BUILD_DIR);
    EXPECT_GE(std::atoi(paths.out.c_str()), 8) << paths.out;
    EXPECT_EQ(paths.out.find(TURBIDITE_BUILD_DIR), std::string::npos) << paths.out;
    EXPECT_EQ(shell("find usr -name __pycache__ -o -name '*.cpp'").out, "");
}

TEST_F(Installed, SaysThatTestsAndBenchmarksBelongToTheSources) {
    for (const std::string command : {"test", "bench"}) {
        const Answer answer = turbidite(command);
        EXPECT_EQ(answer.code, 2);
        EXPECT_SAYS(answer.err, "are not installed with the program");
    }
}

TEST_F(Installed, SaysItsVersionAndCommit) {
    const Answer answer = turbidite("--version");
    EXPECT_SAYS(answer.out, "turbidite " + version());
    if (commit().empty()) return;  // sources without a history
    EXPECT_SAYS(answer.out, "(commit " + commit() + ")");
}

class Package : public ShellTest {};

// Uncompressed, which takes a third of the time.
TEST_F(Package, HoldsTheProgramAndTheKit) {
    const Answer made = shell("cpack --config " TURBIDITE_BUILD_DIR
                              "/CPackConfig.cmake -G DEB -B packages "
                              "-D CPACK_DEBIAN_COMPRESSION_TYPE=none");
    ASSERT_EQ(made.code, 0) << made.out << made.err;
    const std::string fields = "for field in Package Version Depends; do dpkg-deb -f packages/";
    const Answer run = shell(fields + "turbidite_*.deb $field; done");
    EXPECT_SAYS(run.out, "turbidite\n" + version());
    for (const char* dependency :
         {"libopenfoam (>= 1912.200626), libopenfoam (<< 1913~)", "yade (>= 2023.02a)",
          "python3-matplotlib", "openmpi-bin", "libopenmpi3", "liblammps0"})
        EXPECT_SAYS(run.out, dependency);
    const Answer files = shell("dpkg-deb -c packages/turbidite_*.deb");
    for (const char* file :
         {"./usr/bin/turbidite -> ../lib/turbidite/bin/turbidite",
          "./usr/lib/turbidite/lib/yade/turbidite_yade.so",
          "./usr/share/turbidite/configs/quickstart.yaml", "./usr/share/doc/turbidite/copyright"})
        EXPECT_SAYS(files.out, file);
    const Answer kit = shell("dpkg-deb -c packages/turbidite-dev_*.deb");
    for (const char* file :
         {"./usr/include/turbidite/coupler/participant/adapter.hpp",
          "./usr/lib/cmake/turbidite/turbiditeConfig.cmake", "./usr/share/turbidite/examples/"})
        EXPECT_SAYS(kit.out, file);
}

class New : public ShellTest {};

TEST_F(New, WritesACaseOfOnesOwnThatIsValid) {
    const Answer written = shell(TURBIDITE_PROGRAM " new my-case");
    EXPECT_EQ(written.code, 0) << written.err;
    EXPECT_SAYS(written.out, "my-case.yaml\nNext: turbidite check my-case.yaml");
    const std::string shipped = text(TURBIDITE_SOURCE_DIR "/configs/quickstart.yaml");
    EXPECT_SAYS(text(scratch.path() / "my-case.yaml"), shipped) << "with its comments";
    EXPECT_EQ(shell(TURBIDITE_PROGRAM " check my-case.yaml").code, 0);
    const Answer again = shell(TURBIDITE_PROGRAM " new my-case.yaml");
    EXPECT_EQ(again.code, 2);
    EXPECT_SAYS(again.err, "my-case.yaml exists already");
    EXPECT_SAYS(shell(TURBIDITE_PROGRAM " new cases/").err, "names no file");
}

TEST_F(New, TakesAlongTheFilesThatTheCaseNames) {
    const Answer drum = shell(TURBIDITE_PROGRAM " new cases/drum --like drum");
    EXPECT_SAYS(drum.out, "cases/dem8/drum.csv\n");
    EXPECT_EQ(shell(TURBIDITE_PROGRAM " check cases/drum.yaml").code, 0);
    const Answer study = shell(TURBIDITE_PROGRAM " new my-study --like grain-codes");
    EXPECT_EQ(study.code, 0) << study.err;
    EXPECT_SAYS(study.out, "Next: turbidite check my-study.yaml; turbidite study my-study.yaml\n");
    EXPECT_EQ(shell(TURBIDITE_PROGRAM " check my-study.yaml").code, 0);
    const Answer no_case = shell(TURBIDITE_PROGRAM " run my-study.yaml");
    EXPECT_EQ(no_case.code, 2);
    EXPECT_SAYS(no_case.err, "Play it with: turbidite study my-study.yaml");
    // Its case serves another study, too, but one that has been changed stays.
    const Answer second = shell(TURBIDITE_PROGRAM " new second --like grain-codes");
    EXPECT_EQ(second.code, 0) << second.err;
    EXPECT_SAYS(second.out, "second.yaml\nNext:");
    for (const auto& entry : std::filesystem::directory_iterator(scratch.path()))
        if (entry.path().extension() == ".yaml") scratch.write(entry.path().filename(), "changed");
    const Answer third = shell(TURBIDITE_PROGRAM " new third --like grain-codes");
    EXPECT_EQ(third.code, 2);
    EXPECT_SAYS(third.err, "grain-codes names another file of this name");
    // Its cases have files of their own, and it gives them others.
    const Answer deep = shell(TURBIDITE_PROGRAM " new deep/mine --like paper");
    EXPECT_EQ(deep.code, 0) << deep.err;
    EXPECT_SAYS(deep.out, "deep/validation/packed-lattice-0.85.csv\n");
    const Answer checked = shell(TURBIDITE_PROGRAM " check deep/mine.yaml");
    EXPECT_EQ(checked.code, 0) << checked.err;
}

TEST_F(New, IsNotCalledLikeACaseOfItsStudy) {
    for (const std::string name : {"avalanche-dry", "sub/../avalanche-dry.yaml"}) {
        const Answer answer = shell(TURBIDITE_PROGRAM " new " + name + " --like dry-columns");
        EXPECT_EQ(answer.code, 2) << answer.out;
        EXPECT_SAYS(answer.err, "avalanche-dry.yaml is the name of a file that dry-columns needs");
        EXPECT_FALSE(std::filesystem::exists(scratch.path() / "avalanche-dry.yaml"));
    }
}

TEST_F(New, KnowsTheCasesOfValidationToo) {
    const std::string name = "validation/settling-disc";
    for (const std::string& word : {name, "configs/" + name, "configs/" + name + ".yaml"})
        EXPECT_EQ(shell(TURBIDITE_PROGRAM " check " + word).code, 0) << word;
    std::filesystem::create_directory(scratch.path() / "quickstart");
    EXPECT_EQ(shell(TURBIDITE_PROGRAM " check quickstart").code, 0) << "a folder is no case";
    const Answer answer = shell(TURBIDITE_PROGRAM " check ../" + name);
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "../" + name);
}

TEST_F(New, NamesTheNearestOfTheShippedCases) {
    for (const std::string command :
         {"new mine --like quikstart", "run quikstart", "check quikstart"}) {
        const Answer answer = shell(TURBIDITE_PROGRAM " " + command);
        EXPECT_EQ(answer.code, 2) << command;
        EXPECT_SAYS(answer.err, "no shipped case of that name\n  Did you mean quickstart?");
    }
    EXPECT_FALSE(fs::exists(scratch.path() / "mine.yaml"));
}

// The system's own words about a path, and what to do.
TEST_F(New, SaysWhatThePathIsThatCannotBeRead) {
    const std::string name(300, 'a');
    for (const std::string command : {"check ", "run ", "resume ", "report "}) {
        const Answer answer = shell(TURBIDITE_PROGRAM " " + command + name);
        EXPECT_EQ(answer.code, 2) << command;
        EXPECT_SAYS(answer.err, name) << command;
        EXPECT_SAYS(answer.err, "File name too long\n  Check this path") << command;
    }
}

}  // namespace
}  // namespace turbidite
