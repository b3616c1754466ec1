// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Success and failure as seen by the user, in real jobs with real intercommunicators. Every job
// runs under `timeout`: a hang is a failure (code 124), not a wait.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace {

namespace fs = std::filesystem;

struct Result {
    int code = -1;
    std::string output;
    double seconds = 0.0;
};

std::string slurp(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

class Job : public testing::Test {
 protected:
    Job() {
        fs::remove_all(folder_);
        fs::create_directories(folder_ / "logs");
    }
    ~Job() override { fs::remove_all(folder_); }

    Result run(int fluid_ranks, int grains_ranks, const std::string& fluid_fault,
               const std::string& grains_fault, const std::string& scheme = "split") {
        const std::string f = std::to_string(fluid_ranks), g = std::to_string(grains_ranks);
        const std::string program = std::string(" ") + SCRIPTED_JOB + " ";
        const std::string line =
            "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 SCRIPTED_FLUID_RANKS=" + f +
            (scheme == "joint" ? " SCRIPTED_JOINT=1" : "") +
            " timeout -k 5 60 " MPIRUN
            " --oversubscribe --bind-to none --mca btl_vader_single_copy_mechanism none -n 1" +
            program + "coupler " + folder_.string() + " " + f + " " + g + " " + scheme + " : -n " +
            f + program + "fluid " + folder_.string() + " " + fluid_fault + " : -n " + g + program +
            "grains " + folder_.string() + " " + grains_fault + " > " +
            (folder_ / "output").string() + " 2>&1";
        const int status = std::system(line.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(folder_ / "output")};
    }

    std::string record() const { return slurp(folder_ / "run.json"); }

    fs::path folder_ =
        fs::temp_directory_path() / (std::string("turbidite-job-") +
                                     testing::UnitTest::GetInstance()->current_test_info()->name());
};

TEST_F(Job, PlaysToTheEnd) {
    const Result result = run(1, 1, "", "");
    EXPECT_EQ(result.code, 0) << result.output;
    EXPECT_NE(record().find("\"windows_done\": 6"), std::string::npos) << record();
}

TEST_F(Job, ManyRanksOnBothSidesGiveTheSameHistory) {
    ASSERT_EQ(run(1, 1, "", "").code, 0);
    const auto without_clock = [](const std::string& history) {
        std::string kept;
        std::istringstream lines(history);
        for (std::string line; std::getline(lines, line);)
            // pore_volume is empty; times follow it
            kept += line.substr(0, line.find(",,")) + "\n";
        return kept;
    };
    const std::string one = without_clock(slurp(folder_ / "history.csv"));
    const Result result = run(3, 2, "", "");
    ASSERT_EQ(result.code, 0) << result.output;
    EXPECT_EQ(without_clock(slurp(folder_ / "history.csv")), one);
    EXPECT_NE(slurp(folder_ / "logs/coupler.log").find("fluid rank 2"), std::string::npos);
}

// Grains land in window 2 (counted from 0); from then on a window takes several rounds, on two
// fluid and two grains ranks. The result equals that with one rank each.
TEST_F(Job, JointPlaysItsRoundsOnManyRanks) {
    ASSERT_EQ(run(1, 1, "", "", "joint").code, 0);
    const auto physics = [](const std::string& history) {
        std::string kept;
        std::istringstream lines(history);
        for (std::string line; std::getline(lines, line);)
            // pore_volume is empty; times follow it
            kept += line.substr(0, line.find(",,")) + "\n";
        return kept;
    };
    const std::string one = physics(slurp(folder_ / "history.csv"));
    const Result result = run(2, 2, "", "", "joint");
    ASSERT_EQ(result.code, 0) << result.output;
    EXPECT_EQ(physics(slurp(folder_ / "history.csv")), one);
    EXPECT_NE(record().find("\"windows_done\": 6"), std::string::npos) << record();
    EXPECT_NE(record().find("\"unconverged_joint_windows\": 0"), std::string::npos) << record();
    EXPECT_EQ(record().find("\"joint_rounds\": 1,"), std::string::npos) << "rounds were needed";
}

TEST_F(Job, ASilentParticipantIsNamedUnderJoint) {
    const Result result = run(2, 1, "silence", "", "joint");
    EXPECT_EQ(result.code, 5) << result.output;
    EXPECT_NE(record().find("no \\\"response\\\" from fluid"), std::string::npos) << record();
}

TEST_F(Job, AnExceptionEndsAllWithItsCodeAndMessage) {
    const Result result = run(1, 1, "throw", "");
    EXPECT_EQ(result.code, 6) << result.output;
    EXPECT_NE(record().find("scripted trouble"), std::string::npos) << record();
}

TEST_F(Job, BadInputWithinAJobIsAFailureOfTheProgram) {
    const Result result = run(1, 1, "bad-input", "");
    EXPECT_EQ(result.code, 4) << result.output;
    EXPECT_NE(record().find("scripted bad input"), std::string::npos) << record();
    EXPECT_EQ(record().find("no program of a job may give"), std::string::npos) << record();
}

TEST_F(Job, AKilledParticipantEndsTheJob) {
    const Result result = run(1, 1, "", "kill");
    EXPECT_NE(result.code, 0);
    EXPECT_NE(result.code, 124) << "the job hung";
}

TEST_F(Job, ASilentExitEndsTheJob) {
    const Result result = run(1, 1, "", "exit");
    EXPECT_NE(result.code, 0);
    EXPECT_NE(result.code, 124) << "the job hung";
}

TEST_F(Job, ASilentParticipantIsNamed) {
    const Result result = run(1, 1, "silence", "");
    EXPECT_EQ(result.code, 5) << result.output;
    EXPECT_NE(record().find("no \\\"kicks\\\" from fluid"), std::string::npos) << record();
}

}  // namespace
