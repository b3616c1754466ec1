// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/protocol/files/surviving_text.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "coupler/protocol/files/whole_file.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

class SurvivingTextTest : public ::testing::Test {
 protected:
    ScratchFolder folder;
    const std::filesystem::path file = folder.write("waits", "of an earlier program");
};

TEST_F(SurvivingTextTest, IsThereAfterAKill) {
    const pid_t child = fork();
    if (child == 0) {
        SurvivingText text(file, 100);
        text.set("the first, which is longer");
        text.set("the second");
        raise(SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(WTERMSIG(status), SIGKILL);
    EXPECT_EQ(read_surviving_text(file), "the second");
}

TEST_F(SurvivingTextTest, IsEmptyUntilOneIsSet) {
    const SurvivingText text(file, 100);
    EXPECT_EQ(read_surviving_text(file), "");
}

TEST_F(SurvivingTextTest, IsCutAtItsCapacity) {
    SurvivingText(file, 5).set("123456789");
    EXPECT_EQ(read_surviving_text(file), "12345");
}

// A program that is killed while it copies.
TEST_F(SurvivingTextTest, IsEmptyWhenItIsNotWhole) {
    SurvivingText(file, 20).set("the second");
    std::string content = read_whole(file);
    content[0] = '\0';
    folder.write("waits", content);
    EXPECT_EQ(read_surviving_text(file), "");
}

TEST_F(SurvivingTextTest, WithoutAFileNothingIsLeftAndNothingFails) {
    SurvivingText text(folder.path() / "no/such/folder", 20);
    text.set("the second");
    EXPECT_EQ(read_surviving_text(folder.path() / "no/such/folder"), "");
}

}  // namespace
}  // namespace turbidite
