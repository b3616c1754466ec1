// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/kept_lines.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

using Lines = std::vector<std::string>;

class KeptLinesTest : public ::testing::Test {
 protected:
    ScratchFolder folder;
    const std::filesystem::path file = folder.write("waits", "of an earlier program");
};

TEST_F(KeptLinesTest, AreThereAfterAKill) {
    const pid_t child = fork();
    if (child == 0) {
        KeptLines lines(file);
        lines.set(0, "the first, which is longer");
        lines.set(1, "another");
        lines.set(0, "the second");
        raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGKILL);
    EXPECT_EQ(kept_lines(file), (Lines{"the second", "another"}));
}

TEST_F(KeptLinesTest, AreNoneUntilOneIsSet) {
    const KeptLines lines(file);
    EXPECT_EQ(kept_lines(file), Lines{});
}

TEST_F(KeptLinesTest, MayBeginWithALaterOne) {
    KeptLines(file).set(2, "the third");
    EXPECT_EQ(kept_lines(file), Lines{"the third"});
}

TEST_F(KeptLinesTest, AreCutAndStayOutOfEachOther) {
    KeptLines lines(file);
    lines.set(0, std::string(2000, 'x'));
    lines.set(1, "y");
    lines.set(0, std::string(2000, 'z'));
    EXPECT_EQ(kept_lines(file), (Lines{std::string(511, 'z'), "y"}));
}

TEST_F(KeptLinesTest, WithoutAFileNothingFails) {
    KeptLines lines(folder.path() / "no/such/folder");
    lines.set(0, "the second");
    EXPECT_EQ(kept_lines(folder.path() / "no/such/folder"), Lines{});
}

// A user who empties it does not end the program.
TEST_F(KeptLinesTest, MayBeTruncatedMeanwhile) {
    KeptLines lines(file);
    lines.set(0, "the first");
    std::filesystem::resize_file(file, 0);
    lines.set(1, "the second");
    EXPECT_EQ(kept_lines(file), Lines{"the second"});
}

}  // namespace
}  // namespace turbidite
