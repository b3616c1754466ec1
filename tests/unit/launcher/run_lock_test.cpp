// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/run_lock.hpp"

#include <gtest/gtest.h>

#include "coupler/protocol/failure.hpp"
#include "launcher/job/folder/set_aside.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

TEST(RunLock, IsHeldByOne) {
    const ScratchFolder scratch;
    EXPECT_FALSE(RunLock::is_held(scratch.path()));
    {
        const auto lock = RunLock::take(scratch.path());
        ASSERT_NE(lock, nullptr);
        EXPECT_TRUE(RunLock::is_held(scratch.path()));
        EXPECT_EQ(RunLock::take(scratch.path(), std::chrono::seconds(0)), nullptr);
    }
    EXPECT_FALSE(RunLock::is_held(scratch.path()));
    EXPECT_FALSE(RunLock::is_held(scratch.path() / "nowhere"));
}

// A link to itself cannot be opened by anybody, whatever rights they have.
TEST(RunLock, ThatCannotBeOpenedIsNoFreeFolder) {
    const ScratchFolder scratch;
    fs::create_symlink(RunLock::file, scratch.path() / RunLock::file);
    for (const bool take : {true, false}) try {
            take ? void(RunLock::take(scratch.path())) : void(RunLock::is_held(scratch.path()));
            ADD_FAILURE() << "it counted as free";
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), ExitCode::bad_input);
            const std::string text = failure.what();
            EXPECT_NE(text.find("cannot open " + (scratch.path() / RunLock::file).string()),
                      std::string::npos)
                << text;
        }
}

TEST(RunLock, AFileOfThisNameWithContentIsSomebodysOwn) {
    const ScratchFolder scratch;
    scratch.write(RunLock::file, "data");
    EXPECT_THROW(RunLock::take(scratch.path()), Failure);
    EXPECT_EQ(fs::file_size(scratch.path() / RunLock::file), 4U);
    fs::remove(scratch.path() / RunLock::file);
    { const auto lock = RunLock::take(scratch.path()); }
    EXPECT_FALSE(fs::exists(scratch.path() / RunLock::file)) << "its own";
    {  // Written while it was held.
        const auto lock = RunLock::take(scratch.path());
        scratch.write(RunLock::file, "data");
    }
    EXPECT_TRUE(fs::exists(scratch.path() / RunLock::file));
}

TEST(SetAside, KeepsEverythingUnderTheFirstFreeName) {
    const ScratchFolder scratch;
    scratch.write("run/history.csv", "a");
    scratch.write("run-old-1/history.csv", "b");
    const fs::path run = scratch.path() / "run", aside = scratch.path() / "run-old-2";
    EXPECT_EQ(set_aside(run), aside);
    EXPECT_FALSE(fs::exists(run));
    EXPECT_TRUE(fs::exists(aside / "history.csv"));
    EXPECT_FALSE(fs::exists(aside / RunLock::file));
    scratch.write("run/history.csv", "c");
    const auto lock = RunLock::take(run);
    EXPECT_THROW(set_aside(run), Failure) << "a run uses it";
    EXPECT_TRUE(fs::exists(run / "history.csv"));
}

TEST(SetAside, WindowsAreRowsAfterTheFirstOrLaterCheckpoints) {
    const ScratchFolder scratch;
    const auto kept = [&](const char* run) { return windows_kept(scratch.path() / run); };
    const auto has = [&](const char* run) { return has_windows(scratch.path() / run); };
    EXPECT_EQ(kept("nowhere"), 0);
    EXPECT_FALSE(has("nowhere"));
    scratch.write("start/history.csv", "step,time\n0,0\n");
    fs::create_directories(scratch.path() / "start/checkpoints/w00000000");
    EXPECT_EQ(kept("start"), 0);
    EXPECT_FALSE(has("start"));
    scratch.write("rows/history.csv", "step,time\n0,0\n10,0.1\n20,0.");
    EXPECT_EQ(kept("rows"), 10) << "the last row is none";
    EXPECT_TRUE(has("rows"));
    fs::create_directories(scratch.path() / "rows/checkpoints/w00000005");
    EXPECT_EQ(kept("rows"), 10);
    fs::create_directories(scratch.path() / "set/checkpoints/w00000010");
    fs::create_directories(scratch.path() / "set/checkpoints/w100000000");
    EXPECT_EQ(kept("set"), 100000000);
    EXPECT_TRUE(has("set"));
}

}  // namespace
}  // namespace turbidite
