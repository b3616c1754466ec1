// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The disk becomes full during a run.
#include "tests/failure/failing_run.hpp"
#include "tests/failure/small_disk.hpp"

namespace turbidite {
namespace {

class FullDisk : public FailingRun {
 protected:
    void SetUp() override {
        FailingRun::SetUp();
        with_reports();  // the report finds no room either
        if (shell(on_small_disk("true")).code != 0) GTEST_SKIP() << no_small_disk;
    }
};

TEST_F(FullDisk, IsReportedAndGoodDataIsKept) {
    const Answer answer =
        shell(on_small_disk("timeout 100 " TURBIDITE_PROGRAM " run small.yaml --out disk/run; "
                            "echo code $?; cp -r disk/run/run.json disk/run/history.csv ."));
    EXPECT_SAYS(answer.out, "code 4\n");
    EXPECT_SAYS(answer.err, "The run failed: ");
    EXPECT_SAYS(answer.err, "is the disk full?");
    // No partial record and no partial row: the header, t = 0 and at least one window, all with as
    // many columns as the header.
    EXPECT_TRUE(nlohmann::json::parse(text(scratch.path() / "run.json")).contains("case"));
    const std::string history = text(scratch.path() / "history.csv");
    ASSERT_FALSE(history.empty());
    EXPECT_EQ(history.back(), '\n');
    const auto rows = std::count(history.begin(), history.end(), '\n');
    EXPECT_GE(rows, 3);
    const auto header_end = history.begin() + static_cast<std::ptrdiff_t>(history.find('\n'));
    EXPECT_EQ(std::count(history.begin(), history.end(), ','),
              rows * std::count(history.begin(), header_end, ','));
}

}  // namespace
}  // namespace turbidite
