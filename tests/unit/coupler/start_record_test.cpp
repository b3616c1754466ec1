// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Who of a job has not come as far as a step of its start.
#include "coupler/protocol/files/start_record.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

#include "coupler/protocol/files/run_files.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

class StartRecords : public ::testing::Test {
 protected:
    StartRecords() {
        settings.set("fluid.ranks", std::int64_t{1});
        settings.set("grains.ranks", std::int64_t{6});
    }
    ~StartRecords() override { ::unsetenv(member_variable); }

    /// What turbidite-member does for a program, and then the program.
    void start(Role role, int rank, const std::vector<StartStep>& steps) const {
        const std::string file = begin_start_record(
            scratch.path(), {role, rank, "node07", 10 + rank, "/bin/code", "logs/code.log"});
        ::setenv(member_variable, file.c_str(), 1);
        for (const StartStep step : steps) note_start(step);
    }

    std::vector<StartRecord> late_at(StartStep step) const {
        return not_yet_at(step, scratch.path(), {Role::fluid, Role::grains}, settings);
    }

    ScratchFolder scratch;
    Settings settings;
};

TEST_F(StartRecords, KeepWhoItIsAndTheLastStep) {
    start(Role::grains, 1, {StartStep::mpi_init, StartStep::split});
    const auto record = read_start_record(scratch.path(), Role::grains, 1);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->host, "node07");
    EXPECT_EQ(record->pid, 11);
    EXPECT_EQ(record->program, "/bin/code");
    EXPECT_EQ(record->log, "logs/code.log");
    EXPECT_EQ(record->step, StartStep::split);
    // The log is that of the program's place in the job, whatever rank it has in its own world.
    EXPECT_EQ(started_log(), "logs/code.log");
    ::unsetenv(member_variable);
    EXPECT_EQ(started_log(), "");
    EXPECT_FALSE(read_start_record(scratch.path(), Role::grains, 0));
}

TEST_F(StartRecords, BeginAnewWithEveryStart) {
    start(Role::fluid, 0, {StartStep::mpi_init, StartStep::split});
    start(Role::fluid, 0, {});
    EXPECT_EQ(read_start_record(scratch.path(), Role::fluid, 0)->step, StartStep::none);
}

TEST_F(StartRecords, NameTheRanksThatHaveNotTakenAStep) {
    start(Role::fluid, 0, {StartStep::mpi_init, StartStep::split});
    for (int rank = 0; rank < 6; ++rank) start(Role::grains, rank, {StartStep::mpi_init});
    EXPECT_TRUE(late_at(StartStep::mpi_init).empty());
    const auto late = late_at(StartStep::split);
    ASSERT_EQ(late.size(), 6u);
    const std::string text = late_start_text(StartStep::split, late, 2.5);
    EXPECT_EQ(text.find("nothing from grains rank 0 (/bin/code, host node07, pid 10, log "
                        "logs/code.log) within limits.start = 2.5 s: it has called MPI_Init, but "
                        "has not taken part in the split of MPI_COMM_WORLD\n  nor from grains "
                        "rank 1 ("),
              0u)
        << text;
    EXPECT_NE(text.find("\n  nor from 2 other ranks"), std::string::npos) << text;
    EXPECT_EQ(late_at(StartStep::announcement).size(), 7u);
}

// MPI_Finalize of a program that has never joined: it will not come any more.
TEST_F(StartRecords, NameThoseThatLeaveInsteadOfJoining) {
    start(Role::fluid, 0,
          {StartStep::mpi_init, StartStep::split, StartStep::announcement, StartStep::end});
    start(Role::grains, 0, {StartStep::mpi_init, StartStep::end});
    start(Role::grains, 1, {StartStep::mpi_init});
    const auto left = [this](StartStep step) {
        return left_before(step, scratch.path(), {Role::fluid, Role::grains}, settings);
    };
    EXPECT_TRUE(left(StartStep::mpi_init).empty());
    ASSERT_EQ(left(StartStep::split).size(), 1u);
    EXPECT_EQ(late_at(StartStep::split).size(), 2u);
    EXPECT_EQ(left_text(left(StartStep::split)),
              "grains rank 0 (/bin/code, host node07, pid 10, log logs/code.log) has left MPI "
              "(MPI_Finalize) without joining the run");
}

TEST_F(StartRecords, NameThoseThatStayAfterTheEnd) {
    start(Role::fluid, 0, {StartStep::announcement, StartStep::end});
    start(Role::grains, 3, {StartStep::announcement});
    const auto late = late_at(StartStep::end);
    ASSERT_EQ(late.size(), 1u);
    EXPECT_EQ(late_end_text(late, 600.0),
              "the run is over, but grains rank 3 (/bin/code, host node07, pid 13, log "
              "logs/code.log) has not ended within limits.stall_hard = 600 s and is killed");
}

// A program started by hand has no record.
TEST_F(StartRecords, MayBeMissing) {
    note_start(StartStep::split);
    EXPECT_TRUE(late_at(StartStep::split).empty());
    EXPECT_EQ(late_start_text(StartStep::split, {}, 120.0),
              "not all programs of the job have joined within limits.start = 120 s");
}

}  // namespace
}  // namespace turbidite
