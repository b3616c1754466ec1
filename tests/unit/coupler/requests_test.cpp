// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/hub/requests.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "coupler/protocol/files/whole_file.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

class Requested : public ::testing::Test {
 protected:
    ScratchFolder folder;
    const RequestFiles requests{folder.path()};

    std::optional<ExitCode> stop_by(const std::string& text) const {
        folder.write("STOP", text);
        return requests.take().stop;
    }
};

TEST_F(Requested, NothingIsAskedForWithoutAFile) {
    const Requests asked = requests.take();
    EXPECT_EQ(asked.stop, std::nullopt);
    EXPECT_FALSE(asked.write || asked.checkpoint);
}

TEST_F(Requested, TheTextOfAStopFileIsTheExitCode) {
    EXPECT_EQ(stop_by("143\n"), ExitCode::terminated);
    EXPECT_EQ(stop_by("130\n"), ExitCode::interrupted);
    for (const char* other : {"", "0", "4", "please"})
        EXPECT_EQ(stop_by(other), ExitCode::interrupted) << other;
}

TEST_F(Requested, EveryFileIsObeyedOnce) {
    for (const char* name : {"STOP", "WRITE", "CHECKPOINT"}) folder.write(name, "");
    const Requests asked = requests.take();
    EXPECT_TRUE(asked.stop && asked.write && asked.checkpoint);
    const Requests again = requests.take();
    EXPECT_FALSE(again.stop || again.write || again.checkpoint);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

// As `turbidite run` writes it on SIGTERM, while the coupler looks for it.
TEST_F(Requested, AStopFileIsNeverTakenWithoutItsCode) {
    constexpr int times = 2000;
    std::atomic<int> seen = 0;
    std::thread user([&] {
        for (int i = 0; i < times; ++i) {
            write_whole(folder.path() / "STOP", [](std::ostream& file) { file << 143; });
            while (seen == i) std::this_thread::yield();
        }
    });
    int with_another_code = 0;
    while (seen < times)
        if (const auto stop = requests.take().stop) {
            with_another_code += *stop != ExitCode::terminated;
            ++seen;
        }
    user.join();
    EXPECT_EQ(with_another_code, 0);
}

}  // namespace
}  // namespace turbidite
