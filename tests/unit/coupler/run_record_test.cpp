// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupler/output/run_record.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

/// The record of a run of 40 windows that is resumed from its 30th.
nlohmann::json record_after(const RunStatus& status) {
    ScratchFolder folder;
    const auto file = folder.write("run.json", R"({
        "windows_done": 40, "warnings": [{"about": "contacts", "text": "deep"}],
        "maxima": {"penetration": 0.25}, "contact": {"residual_max": 0.5},
        "parts": [{"from_window": 0, "windows_done": 40, "status": "done"},
                  {"from_window": 30, "windows_done": 30, "status": "prepared"}]})");
    write_run_record(file, status, {});
    std::ifstream in(file);
    return nlohmann::json::parse(in);
}

// The coupler has not read the checkpoint: its own figures are of no window.
TEST(RunRecord, APartThatFailsAtItsStartLeavesWhatIsKnownOfTheRun) {
    RunStatus status;
    status.code = ExitCode::handshake_refused;
    status.reason = "grains rank 0 did not come";
    const nlohmann::json record = record_after(status);
    EXPECT_EQ(record["status"], "handshake refused");
    EXPECT_EQ(record["error"], "grains rank 0 did not come");
    EXPECT_EQ(record["windows_done"], 30);  // the later ones were taken out before it started
    EXPECT_EQ(record["warnings"].size(), 1u);
    EXPECT_EQ(record["maxima"]["penetration"], 0.25);
    EXPECT_EQ(record["contact"]["residual_max"], 0.5);
    EXPECT_EQ(record["parts"][1]["windows_done"], 30);
    EXPECT_EQ(record["parts"][1]["status"], "handshake refused");
    EXPECT_EQ(record["parts"][0]["status"], "done");
}

TEST(RunRecord, APartThatWentOnWritesItsOwn) {
    RunStatus status;
    status.code = ExitCode::stalled;
    status.statistics.windows_done = 33;
    status.statistics.maxima.penetration = 0.5;
    const nlohmann::json record = record_after(status);
    EXPECT_EQ(record["windows_done"], 33);
    EXPECT_EQ(record["warnings"].size(), 0u);
    EXPECT_EQ(record["maxima"]["penetration"], 0.5);
    EXPECT_EQ(record["parts"][1]["windows_done"], 33);
    EXPECT_EQ(record["parts"][1]["status"], "stalled");
}

}  // namespace
}  // namespace turbidite
