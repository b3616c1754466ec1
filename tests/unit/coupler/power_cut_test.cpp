// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What the disk has, and when: a power cut at any moment leaves whole checkpoints. Killing
// processes does not show it, since the kernel then still writes what they have written.
#include <gtest/gtest.h>

#include "tests/call_trace.hpp"
#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;
using trace::Call;

std::vector<Call> before(const std::vector<Call>& calls, std::size_t count) {
    return {calls.begin(), calls.begin() + static_cast<std::ptrdiff_t>(count)};
}

class PowerCut : public testing::Test {
 protected:
    const TestFolder folder{"power-cut"};
    const fs::path sets = folder.path() / "checkpoints";
    std::vector<Call> calls;

    void SetUp() override {
        Job job;
        job.settings.set("checkpoint.windows", std::int64_t{2});
        job.grains_ranks = job.fluid_ranks = 2;
        const trace::Recorder recorder;
        job.run(folder);
        calls = recorder.calls();
        ASSERT_EQ(job.status.code, ExitCode::done) << job.status.reason;
        ASSERT_EQ(job.status.checkpoints.written, 4);
    }

    bool puts_a_set_in_place(const Call& call) const {
        return call.kind == Call::Kind::rename && call.to.parent_path() == sets;
    }
    bool takes_a_set_away(const Call& call) const {
        return call.kind == Call::Kind::rename && call.path.parent_path() == sets;
    }
};

TEST_F(PowerCut, ASetIsOnTheDiskBeforeItGetsItsName) {
    int found = 0;
    for (std::size_t i = 0; i < calls.size(); ++i) {
        if (!puts_a_set_in_place(calls[i])) continue;
        ++found;
        EXPECT_EQ(calls[i].content.size(), 6u);  // four ranks, the coupler, the manifest
        auto there = trace::on_disk(before(calls, i));
        for (const auto& [file, version] : calls[i].content)
            EXPECT_TRUE(there[file] == version) << file;
        EXPECT_TRUE(there[calls[i].path] == calls[i].version) << calls[i].path;
    }
    EXPECT_EQ(found, 4);
}

TEST_F(PowerCut, TheRowsBeforeASetAreOnTheDiskWithIt) {
    const fs::path history = folder.files().history;
    std::vector<long> lengths;
    for (std::size_t i = 0; i < calls.size(); ++i)
        if (puts_a_set_in_place(calls[i]))
            lengths.push_back(trace::on_disk(before(calls, i))[history].size);
    ASSERT_EQ(lengths.size(), 4u);
    EXPECT_GT(lengths[0], 0);
    EXPECT_GT(lengths[3], lengths[0]);
}

TEST_F(PowerCut, WhatTheSeriesNamesIsOnTheDiskWithASet) {
    const auto written = [&](const Call& call) {
        return call.kind == Call::Kind::rename && call.to.extension() == ".vtp";
    };
    std::size_t outputs = 0, names = 0;
    for (std::size_t i = 0; i < calls.size(); ++i) {
        if (!puts_a_set_in_place(calls[i])) continue;
        auto there = trace::on_disk(before(calls, i));
        for (std::size_t k = 0; k < i; ++k) {
            if (!written(calls[k])) continue;
            ++outputs;
            EXPECT_TRUE(there[calls[k].to] == calls[k].version) << calls[k].to;
            names += std::any_of(
                calls.begin() + static_cast<std::ptrdiff_t>(k),
                calls.begin() + static_cast<std::ptrdiff_t>(i), [&](const Call& c) {
                    return c.kind == Call::Kind::sync && c.path == calls[k].to.parent_path();
                });
        }
    }
    EXPECT_GE(outputs, 4u);
    EXPECT_EQ(names, outputs);
}

// Its new name is a change of `checkpoints`, and `checkpoints` one of the run folder.
TEST_F(PowerCut, AnOldSetGoesWhenTheDiskHasTheNameOfTheNewOne) {
    int taken = 0;
    bool sets_synced = false, run_synced = false;
    for (const Call& call : calls) {
        if (puts_a_set_in_place(call)) sets_synced = run_synced = false;
        if (call.kind == Call::Kind::sync && call.path == sets) sets_synced = true;
        if (call.kind == Call::Kind::sync && call.path == folder.path()) run_synced = sets_synced;
        if (!takes_a_set_away(call)) continue;
        ++taken;
        EXPECT_TRUE(sets_synced && run_synced) << call.path;
    }
    EXPECT_EQ(taken, 2);
}

TEST_F(PowerCut, TheRecordIsOnTheDiskInTheEnd) {
    const fs::path record = folder.files().record;
    EXPECT_TRUE(trace::on_disk(calls)[record] == trace::version_of(record));
    const auto named = std::find_if(calls.begin(), calls.end(),
                                    [&](const Call& call) { return call.to == record; });
    ASSERT_NE(named, calls.end());
    EXPECT_TRUE(std::any_of(named, calls.end(), [&](const Call& call) {
        return call.kind == Call::Kind::sync && call.path == folder.path();
    }));
}

}  // namespace
}  // namespace turbidite
