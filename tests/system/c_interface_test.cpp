// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Programs in C of other versions than the library: of the first header, and of one to come.
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const std::string headers = TURBIDITE_SOURCE_DIR "/tests/system/c_interface";

class CInterface : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("fall.yaml",
                      "domain: {size: [8, 40]}\n"
                      "grains: {adapter: external, command: none, count: 6}\n"
                      "contact: {friction: 0}\n"
                      "fluid: {enabled: false}\n"
                      "time: {step: 0.01, end: 0.2}\n"
                      "output: {interval: 0.01}\n"
                      "limits: {penetration: 10, stall_soft: 5, stall_hard: 20}\n");
        // As the header is included by programs outside of the tree.
        std::filesystem::create_directories(scratch.path() / "present");
        std::filesystem::create_directory_symlink(TURBIDITE_SOURCE_DIR,
                                                  scratch.path() / "present/turbidite");
    }

    /// With the library that is loaded when it runs.
    void compile(const std::string& source, const std::string& includes,
                 const std::string& program) const {
        const Answer built =
            shell("mpicc -Wall -Werror -I " + includes + " -I " TURBIDITE_SOURCE_DIR "/examples " +
                  source + " -o " + program +
                  " -L " TURBIDITE_BUILD_DIR "/lib -lturbidite -Wl,-rpath," TURBIDITE_BUILD_DIR
                  "/lib -lm");
        ASSERT_EQ(built.code, 0) << built.err;
    }

    Answer run(const std::string& command, const std::string& folder = "run") const {
        return shell("timeout 60 " TURBIDITE_PROGRAM " run fall.yaml --force --out " + folder +
                     " --set 'grains.command=" + command + "'");
    }
};

TEST_F(CInterface, AProgramOfTheFirstHeaderRunsAsBefore) {
    const std::string source = headers + "/first_header/falling.c";
    compile(source, headers + "/first_header", "old");
    compile(source, "present", "new");
    const std::string symbol = " | grep -o 'turbidite_run_grains.*'";
    ASSERT_EQ(shell("nm -u old" + symbol).out, "turbidite_run_grains\n");
    ASSERT_EQ(shell("nm -u new" + symbol).out, "turbidite_run_grains_sized\n");
    for (const std::string program : {"old", "new"}) {
        const Answer answer = run(program, "run-" + program);
        ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "grains rank 0  falling-c in ");
    }
    EXPECT_EQ(lines_of_history("run-old").size(), 22u);  // names, t = 0, 20 windows
    EXPECT_EQ(lines_of_history("run-old"), lines_of_history("run-new"));
}

TEST_F(CInterface, AProgramOfALaterHeaderRunsOrIsRefusedInWords) {
    compile(headers + "/other_sizes.c", "present", "other_sizes");
    const Answer unused = run("other_sizes uses-no-more");
    EXPECT_EQ(unused.code, 0) << unused.out << unused.err;

    const Answer used = run("other_sizes uses-more");
    EXPECT_EQ(used.code, 3) << used.out << used.err;
    EXPECT_SAYS(used.err,
                "the turbidite_adapter of the program has 144 bytes, this library knows "
                "136 of them, and the program uses more");

    const Answer small = run("other_sizes too-small");
    EXPECT_EQ(small.code, 3) << small.out << small.err;
    EXPECT_SAYS(small.err, "there have never been fewer than 88");
}

TEST_F(CInterface, AProgramSaysInWhichDimensionsItPlays) {
    compile(headers + "/other_sizes.c", "present", "other_sizes");
    const std::string space = "' --set dimension=3 --set 'domain.size=[8, 40, 4]";
    for (const std::string& dimension : {std::string(), space}) {
        const Answer both = run("other_sizes both-dimensions" + dimension);
        EXPECT_EQ(both.code, 0) << both.out << both.err;
    }
    const Answer planar = run("other_sizes uses-no-more" + space);
    EXPECT_EQ(planar.code, 3) << planar.out << planar.err;
    EXPECT_SAYS(planar.err, "dimension is 2, the case needs 3");
    const Answer four = run("other_sizes four-dimensions");
    EXPECT_EQ(four.code, 3) << four.out << four.err;
    EXPECT_SAYS(four.err, "turbidite_adapter.dimensions = 4; allowed are 2, 3");
}

// `joined` has no answer of its own.
TEST_F(CInterface, AFailureAtJoiningEndsTheRun) {
    compile(headers + "/other_sizes.c", "present", "other_sizes");
    const Answer answer = run("other_sizes refuses-ranks");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "these ranks will not do");
}

// MPI_Init, the split and MPI_Finalize are the program's.
TEST_F(CInterface, AProgramMayHaveAnMpiOfItsOwn) {
    compile(headers + "/other_sizes.c", "present", "other_sizes");
    const Answer answer = run("other_sizes own-mpi");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(text(run_folder() / "logs/grains.log"), "joined with 1 of 2 ranks");
}

}  // namespace
}  // namespace turbidite
