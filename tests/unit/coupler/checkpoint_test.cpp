// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Checkpoints without MPI: when they are due, what is in their folder, and that a run that goes on
// from one has the history of a run in one part.
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <thread>

#include "tests/unit/coupler/loopback_job.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

std::string text_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void overwrite(const fs::path& file, std::size_t at, char value) {
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    out.seekp(static_cast<std::streamoff>(at));
    out.put(value);
}

/// history.csv without its last four columns, the wall times.
std::vector<std::vector<std::string>> history_of(const TestFolder& folder) {
    Rows rows = read_csv(folder.files().history);
    const std::size_t wall = column(rows.at(0), "wall_step");
    for (auto& row : rows)
        if (row.size() > wall)
            row.erase(row.begin() + wall, row.begin() + std::min(wall + 4, row.size()));
    return rows;
}

Job job_with_checkpoints(const std::string& scheme) {
    Job job;
    job.settings = test_settings(scheme, scheme != "dry");
    if (scheme == "dry") job.settings.set("run.scheme", scheme);
    job.settings.set("checkpoint.windows", std::int64_t{2});
    job.floor = 4.4995;
    return job;
}

Names sets_in(const TestFolder& folder) {
    return CheckpointSets(folder.path()).names();
}

TEST(StoredFile, InPiecesIsTheSameAsWhole) {
    const TestFolder folder("pieces");
    const Bytes bytes{'p', 'i', 'e', 'c', 'e', 's'};
    const StoredFile whole = store(folder.path(), "whole", bytes);
    PieceWriter writer(folder.path(), "pieces");
    writer.write(bytes.data(), 2);
    writer.write(bytes.data() + 2, 0);
    writer.write(bytes.data() + 2, 4);
    const StoredFile pieces = writer.finish();
    EXPECT_EQ(pieces.name, "pieces");
    EXPECT_EQ(pieces.bytes, whole.bytes);
    EXPECT_EQ(pieces.crc32, whole.crc32);
    EXPECT_EQ(load(folder.path(), pieces), bytes);
    PieceReader reader(folder.path(), pieces);
    EXPECT_EQ(reader.size(), 6u);
    char part[4] = {};
    reader.read(4, part, 2);
    EXPECT_EQ(std::string(part), "es");
    reader.read(0, part, 3);
    EXPECT_EQ(std::string(part), "pie");
    EXPECT_THROW(reader.read(4, part, 3), Failure);
    EXPECT_EQ(reader.all(), bytes) << "after a read that failed, too";
}

TEST(StoredFile, IsComparedBeforeAPieceIsRead) {
    const TestFolder folder("damaged-pieces");
    const StoredFile file = store(folder.path(), "file", Bytes(100, 'a'));
    overwrite(folder.path() / "file", 99, 'b');
    EXPECT_THROW(PieceReader(folder.path(), file), Failure);
}

// What ranks do together between the two is done by all of them.
TEST(StoredFile, IsMadeByTheFirstWrite) {
    const TestFolder folder("late-pieces");
    PieceWriter writer(folder.path() / "none", "file"), empty(folder.path() / "none", "empty");
    EXPECT_THROW(writer.write("a", 1), Failure);
    EXPECT_THROW(empty.finish(), Failure);
}

TEST(CheckpointRule, CountsFromTheBeginningOfTheRun) {
    Settings settings = test_settings();
    const RunValues run = run_values(settings);
    EXPECT_FALSE(CheckpointRule(settings, run).any());
    settings.set("checkpoint.windows", std::int64_t{3});
    settings.set("checkpoint.interval", 5.0 * run.step / run.time);
    const CheckpointRule rule(settings, run);
    EXPECT_TRUE(rule.any());
    for (const std::int64_t due : {3, 5, 6, 9, 10}) EXPECT_TRUE(rule.due(due)) << due;
    for (const std::int64_t not_due : {1, 2, 4, 7, 8}) EXPECT_FALSE(rule.due(not_due)) << not_due;
}

// Which stands for the beginning and the end of a run alone.
TEST(CheckpointRule, AnIntervalBeyondAllWindowsIsNeverDue) {
    Settings settings = test_settings();
    settings.set("checkpoint.interval", 1e30);
    const CheckpointRule rule(settings, run_values(settings));
    EXPECT_TRUE(rule.any());
    for (const std::int64_t windows : {1, 1000, 123456789}) EXPECT_FALSE(rule.due(windows));
}

TEST(CheckpointRule, KnowsWallTime) {
    Settings settings = test_settings();
    settings.set("checkpoint.wall_minutes", 2.0);
    CheckpointRule rule(settings, run_values(settings));
    const auto now = CheckpointRule::Clock::now();
    EXPECT_FALSE(rule.due(1, now + std::chrono::seconds(110)));
    EXPECT_TRUE(rule.due(1, now + std::chrono::seconds(130)));
    rule.written(now + std::chrono::seconds(130));
    EXPECT_FALSE(rule.due(1, now + std::chrono::seconds(200)));
}

TEST(Checkpoint, SetsAreWrittenBeforeTheFirstWindowByRuleAndAtTheEnd) {
    const TestFolder folder("checkpoint-sets");
    Job job = job_with_checkpoints("split");
    job.settings.set("checkpoint.keep", std::int64_t{9});
    job.fluid_ranks = 2;
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_EQ(sets_in(folder), (Names{"w00000006", "w00000004", "w00000002", "w00000000"}));
    EXPECT_EQ(job.status.checkpoints.written, 4);
    const Manifest manifest = CheckpointSets(folder.path()).verified("w00000004");
    EXPECT_EQ(manifest.windows, 4);
    EXPECT_EQ(manifest.fluid.size(), 2u);
    EXPECT_EQ(manifest.settings.text("run.hash"), "0123456789abcdef");
    EXPECT_GT(manifest.grains.at(0).bytes, 0);
}

TEST(Checkpoint, TheNewestStay) {
    const TestFolder folder("checkpoint-keep");
    Job job = job_with_checkpoints("dry");
    job.run(folder);
    EXPECT_EQ(sets_in(folder), (Names{"w00000006", "w00000004"}));
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().filename().string().find(".checkpoint"), std::string::npos);
}

struct Going {
    const char* scheme;
    int grains_ranks, fluid_ranks;
};
class GoingOn : public testing::TestWithParam<Going> {
 protected:
    Job job() const {
        Job job = job_with_checkpoints(GetParam().scheme);
        job.grains_ranks = GetParam().grains_ranks;
        job.fluid_ranks = GetParam().fluid_ranks;
        job.settings.set("checkpoint.keep", std::int64_t{9});
        return job;
    }
    std::string name(const char* what) const {
        return std::string("checkpoint-") + what + GetParam().scheme +
               std::to_string(10 * GetParam().grains_ranks + GetParam().fluid_ranks);
    }
};

TEST_P(GoingOn, GivesTheHistoryOfARunInOnePart) {
    const TestFolder whole_folder(name("whole-")), folder(name("parts-"));
    Job whole = job();
    whole.run(whole_folder);
    Job first = job();
    first.grains_fault = [](const std::string& function, std::int64_t window) {
        if (function == "apply_kick" && window == 4) throw std::runtime_error("lost");
    };
    first.run(folder);
    EXPECT_EQ(first.status.code, ExitCode::participant_failed);
    ASSERT_EQ(sets_in(folder).front(), "w00000004");
    Job second = job();
    second.resume = "w00000002";  // rows and sets after it are there already
    std::vector<std::int64_t> played;
    second.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "apply_kick" && GetParam().grains_ranks == 1) played.push_back(window);
    };
    second.run(folder);
    EXPECT_EQ(second.status.code, ExitCode::done) << second.status.reason;
    if (GetParam().grains_ranks == 1) {
        EXPECT_EQ(played, (std::vector<std::int64_t>{2, 3, 4, 5}));
    }
    EXPECT_EQ(history_of(folder), history_of(whole_folder));
    for (const char* series : {"grains.pvd", "contacts.pvd", "grains_00000006.vtp"})
        EXPECT_EQ(text_of(folder.path() / "grains" / series),
                  text_of(whole_folder.path() / "grains" / series))
            << series;
    EXPECT_EQ(second.status.statistics.windows_done, 6);
    EXPECT_EQ(second.status.statistics.maxima.penetration,
              whole.status.statistics.maxima.penetration);
    EXPECT_EQ(sets_in(folder), sets_in(whole_folder));
}

INSTANTIATE_TEST_SUITE_P(Schemes, GoingOn,
                         testing::Values(Going{"split", 1, 1}, Going{"split", 2, 3},
                                         Going{"joint", 1, 2}, Going{"dry", 1, 1}));

// The row of the stop is out of turn, and no run in one part has it.
TEST(Checkpoint, AStoppedRunGoesOnAsIfItHadNotBeenStopped) {
    const TestFolder whole_folder("checkpoint-not-stopped"), folder("checkpoint-stopped");
    Job whole = job_with_checkpoints("split");
    whole.run(whole_folder);
    Job first = job_with_checkpoints("split");
    first.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 1) std::ofstream(folder.path() / "STOP");
    };
    first.run(folder);
    EXPECT_EQ(first.status.code, ExitCode::interrupted);
    EXPECT_NE(first.status.reason.find("after window 3; its output and a checkpoint are written"),
              std::string::npos)
        << first.status.reason;
    EXPECT_EQ(read_csv(folder.files().history).back().front(), "3");
    Job second = job_with_checkpoints("split");
    second.resume = "w00000003";
    second.run(folder);
    EXPECT_EQ(second.status.code, ExitCode::done) << second.status.reason;
    EXPECT_EQ(history_of(folder), history_of(whole_folder));
}

// Nothing follows that the row of the stop would not belong to.
TEST(Checkpoint, ARunThatEndsWhereItWasStoppedKeepsItsLastRow) {
    const TestFolder folder("checkpoint-ends-stopped");
    Job first = job_with_checkpoints("split");
    first.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 1) std::ofstream(folder.path() / "STOP");
    };
    first.run(folder);
    const std::string rows = text_of(folder.files().history);
    const std::string grains = text_of(folder.files().series / "grains.pvd");
    const std::string contacts = text_of(folder.files().series / "contacts.pvd");
    EXPECT_EQ(read_csv(folder.files().history).back().front(), "3");
    Job second = job_with_checkpoints("split");
    second.settings.set("run.windows", std::int64_t{3});
    second.resume = "w00000003";
    second.run(folder);
    EXPECT_EQ(second.status.code, ExitCode::done) << second.status.reason;
    EXPECT_EQ(second.status.statistics.windows_done, 3);
    EXPECT_EQ(text_of(folder.files().history), rows);
    EXPECT_EQ(text_of(folder.files().series / "grains.pvd"), grains);
    EXPECT_EQ(text_of(folder.files().series / "contacts.pvd"), contacts);
}

// Wall times of the first row are those of its windows.
TEST(Checkpoint, WhatTheStartTakesBelongsToNoWindow) {
    const TestFolder folder("checkpoint-slow-start");
    const auto slow = [](const char* call) {
        return [call](const std::string& function, std::int64_t) {
            if (function == call) std::this_thread::sleep_for(std::chrono::seconds(1));
        };
    };
    Job first = job_with_checkpoints("split");
    first.settings.set("checkpoint.windows", std::int64_t{6});  // before the first window and last
    first.settings.set("run.output_every", std::int64_t{1});
    first.grains_fault = slow("save");
    first.run(folder);
    Job second = job_with_checkpoints("split");
    second.settings.set("run.output_every", std::int64_t{1});
    second.settings.set("run.windows", std::int64_t{8});
    second.grains_fault = slow("restore");
    second.resume = "w00000006";
    second.run(folder);
    EXPECT_EQ(second.status.code, ExitCode::done) << second.status.reason;
    const Rows rows = read_csv(folder.files().history);
    ASSERT_EQ(rows.size(), 10u);
    for (const std::size_t row : {2u, 8u})  // of the first window of each part
        for (const char* name : {"wall_step", "wall_coupling"})
            EXPECT_LT(std::stod(rows[row][column(rows[0], name)]), 1.0) << row << " " << name;
}

TEST(Checkpoint, FilesAskForOutputAndForACheckpointOnce) {
    const TestFolder folder("checkpoint-asked");
    Job job;
    job.settings.set("run.output_every", std::int64_t{100});
    job.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 1) std::ofstream(folder.path() / "WRITE");
        if (function == "advance" && window == 3) std::ofstream(folder.path() / "CHECKPOINT");
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    const Rows rows = read_csv(folder.files().history);
    ASSERT_EQ(rows.size(), 4u);  // header, t = 0, window 3, the end
    EXPECT_EQ(rows[2].front(), "3");
    EXPECT_EQ(sets_in(folder), Names{"w00000005"});
    EXPECT_FALSE(fs::exists(folder.path() / "WRITE"));
    EXPECT_FALSE(fs::exists(folder.path() / "CHECKPOINT"));
}

TEST(Checkpoint, AParticipantThatCannotSaveIsNamedAndTheRunGoesOn) {
    const TestFolder folder("checkpoint-unable");
    Job job = job_with_checkpoints("split");
    job.grains_save = false;
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_TRUE(sets_in(folder).empty());
    EXPECT_NE(text_of(folder.files().log)
                  .find("grains (scripted) cannot save its state; the run has no checkpoints"),
              std::string::npos);
}

// A manifest is read from a folder that may come from elsewhere.
TEST(CheckpointSets, FilesOutsideOfTheirFolderAreRefused) {
    const TestFolder folder("checkpoint-elsewhere");
    Job job = job_with_checkpoints("split");
    job.run(folder);
    const CheckpointSets sets(folder.path());
    Manifest manifest = sets.manifest("w00000006");
    const fs::path set = folder.path() / "checkpoints" / "w00000006";
    const Bytes secret(7, 's');
    store(folder.path(), "secret", secret);
    const std::string secret_file = folder.path() / "secret";
    for (const std::string& name : Names{"../../secret", secret_file, "a/../../b"}) {
        manifest.grains[0] = {name, 7, crc32_of(secret)};
        std::ofstream(set / "manifest.json") << manifest_text(manifest);
        try {
            sets.verified("w00000006");
            ADD_FAILURE() << name;
        } catch (const Failure& failure) {
            EXPECT_NE(std::string(failure.what()).find("which is no name of a file in its folder"),
                      std::string::npos)
                << failure.what();
        }
        EXPECT_THROW(load(set, manifest.grains[0]), Failure) << name;
    }
}

TEST(CheckpointSets, TwoRanksHaveTwoFiles) {
    const TestFolder folder("checkpoint-one-file");
    const CheckpointSets sets(folder.path());
    const fs::path place = folder.path() / sets.begin(4);
    Manifest manifest;
    manifest.windows = 4;
    manifest.coupler = store(place, "coupler", {'c'});
    manifest.grains = {store(place, "grains", {'g'}), store(place, "grains", {'g'})};
    try {
        sets.commit(manifest);
        ADD_FAILURE() << "one file for two ranks";
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("grains rank 1: "), std::string::npos)
            << failure.what();
    }
    EXPECT_TRUE(sets.names().empty());
}

TEST(CheckpointSets, ADamagedFileIsNamed) {
    const TestFolder folder("checkpoint-damaged");
    Job job = job_with_checkpoints("split");
    job.run(folder);
    const CheckpointSets sets(folder.path());
    const auto fault = [&](const std::string& name) -> std::string {
        try {
            sets.verified(name);
        } catch (const Failure& failure) {
            return failure.what();
        }
        return "";
    };
    const fs::path set = folder.path() / "checkpoints" / "w00000006";
    EXPECT_EQ(fault("w00000006"), "");
    overwrite(set / "grains.rank0", 100, 'x');
    EXPECT_NE(fault("w00000006").find("grains.rank0 is damaged: its checksum differs"),
              std::string::npos)
        << fault("w00000006");
    fs::resize_file(set / "grains.rank0", 100);
    EXPECT_NE(fault("w00000006").find("has 100 bytes instead of"), std::string::npos);
    fs::remove(set / "grains.rank0");
    EXPECT_NE(fault("w00000006").find("grains.rank0 is missing"), std::string::npos);
    overwrite(set / "manifest.json", 3, '}');
    EXPECT_NE(fault("w00000006").find("not the manifest of a checkpoint"), std::string::npos);
    EXPECT_EQ(fault("w00000004"), "");
}

using ChangeOfPart = std::function<void(SavedPart&)>;

/// From its set of window 4 on, the grains' rank 0 tells something else than what it has written.
Job job_with_a_liar(const ChangeOfPart& change) {
    Job job = job_with_checkpoints("split");
    job.from_grains = [change](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::saved || message.envelope.window < 3) return true;
        SavedPart part = decode<SavedPart>(message.payload);
        change(part);
        bytes = frame({message.envelope, encode(part)});
        return true;
    };
    return job;
}

struct Lie {
    const char* name;
    const char* told;  ///< in the warning
    ChangeOfPart change;
};
class ALie : public testing::TestWithParam<Lie> {};

// Two sets of two are good when the lies begin: they stay, though newer ones are announced.
TEST_P(ALie, DoesNotCountAndTheLastGoodSetsStay) {
    const TestFolder folder(std::string("checkpoint-lie-") + GetParam().name);
    Job job = job_with_a_liar(GetParam().change);
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    ASSERT_EQ(sets_in(folder), (Names{"w00000002", "w00000000"}));
    EXPECT_EQ(job.status.checkpoints.written, 2);
    for (const std::string& name : sets_in(folder))
        EXPECT_NO_THROW(CheckpointSets(folder.path()).verified(name)) << name;
    const std::string log = text_of(folder.files().log);
    for (const char* part : {"no checkpoint after window 4: grains rank 0", GetParam().told,
                             "The last one is checkpoints/w00000002."})
        EXPECT_NE(log.find(part), std::string::npos) << part << "\n" << log;
    for (const auto& entry : fs::directory_iterator(folder.path()))
        EXPECT_EQ(entry.path().filename().string().find(".checkpoint"), std::string::npos);

    Job second = job_with_checkpoints("split");
    second.resume = "w00000002";
    second.run(folder);
    EXPECT_EQ(second.status.code, ExitCode::done) << second.status.reason;
    EXPECT_EQ(sets_in(folder), (Names{"w00000006", "w00000004"}));
}

INSTANTIATE_TEST_SUITE_P(
    Lies, ALie,
    testing::Values(Lie{"checksum", "its checksum differs",
                        [](SavedPart& part) { part.file.crc32 ^= 1; }},
                    Lie{"size", "bytes instead of", [](SavedPart& part) { part.file.bytes += 1; }},
                    Lie{"another", "is missing", [](SavedPart& part) { part.file.name = "state"; }},
                    Lie{"absolute", "is no name of a file in its folder",
                        [](SavedPart& part) { part.file.name = "/etc/hostname"; }},
                    Lie{"above", "is no name of a file in its folder",
                        [](SavedPart& part) { part.file.name = "../" + part.file.name; }},
                    Lie{"folder", "is no name of a file in its folder",
                        [](SavedPart& part) { part.file.name = ".."; }},
                    Lie{"nameless", "is no name of a file in its folder",
                        [](SavedPart& part) { part.file.name = ""; }},
                    Lie{"couplers", "coupler", [](SavedPart& part) { part.file.name = "coupler"; }},
                    Lie{"manifest", "manifest.json",
                        [](SavedPart& part) { part.file.name = "manifest.json"; }}),
    [](const auto& info) { return std::string(info.param.name); });

TEST(Checkpoint, WithoutAnySetThatVerifiesThereIsNoneAndTheRunGoesOn) {
    const TestFolder folder("checkpoint-no-good-set");
    Job job = job_with_checkpoints("split");
    job.fluid_ranks = 2;
    int count = 0;
    job.from_fluid = [&](Bytes& bytes) {
        Message message = unframe(bytes);
        if (message.envelope.kind != Kind::saved) return true;
        SavedPart part = decode<SavedPart>(message.payload);
        if (part.file.name != "fluid.rank1") return true;
        part.file.crc32 ^= 1, ++count;
        bytes = frame({message.envelope, encode(part)});
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_EQ(count, 4);
    EXPECT_TRUE(sets_in(folder).empty());
    EXPECT_EQ(job.status.checkpoints.written, 0);
    EXPECT_NE(text_of(folder.files().log).find("no checkpoint after window 6: fluid rank 1"),
              std::string::npos);
}

/// No file may grow beyond so many bytes, as on a full disk.
class SmallFiles {
 public:
    explicit SmallFiles(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
        getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit{bytes, before_.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~SmallFiles() {
        setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

 private:
    void (*handler_)(int);
    rlimit before_{};
};

// A rank that went its own way would leave the others in what they do together.
TEST(Checkpoint, ARankThatCannotOpenItsFileSavesWithTheOthers) {
    const TestFolder folder("checkpoint-no-file");
    Job job = job_with_checkpoints("split");
    job.grains_ranks = 2;
    std::atomic<int> saves{0};
    job.grains_fault = [&](const std::string& function, std::int64_t) {
        saves += function == "save";
    };
    job.to_grains = [&](Bytes& bytes) {
        const Message message = unframe(bytes);
        if (message.envelope.kind == Kind::save)
            fs::create_directories(folder.path() / decode<CheckpointPlace>(message.payload).folder /
                                   "grains.rank1");
        return true;
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_TRUE(sets_in(folder).empty());
    EXPECT_EQ(saves, 8);  // both ranks, after 0, 2, 4 and 6 windows
    const std::string log = text_of(folder.files().log);
    EXPECT_NE(log.find("grains rank 1: cannot write"), std::string::npos) << log;
}

TEST(Checkpoint, AFileOfTheOutputThatIsGoneCostsTheSetAlone) {
    const TestFolder folder("checkpoint-gone");
    Job job = job_with_checkpoints("split");
    job.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 3) fs::remove(folder.files().history);
    };
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_EQ(sets_in(folder), (Names{"w00000002", "w00000000"}));
    const std::string log = text_of(folder.files().log);
    EXPECT_NE(log.find("no checkpoint after window 4: cannot write"), std::string::npos) << log;
}

TEST(Checkpoint, AFullDiskEndsTheRecordingAndNotTheRun) {
    const TestFolder folder("recording-full");
    Job job = job_with_checkpoints("split");
    job.settings.set("checkpoint.windows", std::int64_t{0});
    job.recordings = folder.path();
    std::optional<SmallFiles> full;
    job.grains_fault = [&](const std::string& function, std::int64_t window) {
        if (function == "advance" && window == 1) full.emplace(4096);
    };
    job.settings.set("run.output_every", std::int64_t{100});
    job.run(folder);
    full.reset();
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    for (const char* name : {"grains.frames", "fluid.frames"}) {
        EXPECT_EQ(fs::file_size(folder.path() / name), 4096u) << name;
        EXPECT_NE(job.told.find(std::string(name) + ": is the disk full?"), std::string::npos)
            << job.told;
    }
}

TEST(Checkpoint, AFullDiskLeavesTheLastSetAndTheRunGoesOn) {
    const TestFolder folder("checkpoint-full");
    Job job = job_with_checkpoints("split");
    std::optional<SmallFiles> full;
    job.grains_fault = [&](const std::string& function, std::int64_t window) {
        // The state of the three grains has more bytes.
        if (function == "apply_kick" && window == 3) full.emplace(700);
        if (function == "advance" && window == 4) full.reset();
    };
    job.settings.set("run.output_every", std::int64_t{100});
    job.run(folder);
    EXPECT_EQ(job.status.code, ExitCode::done) << job.status.reason;
    EXPECT_EQ(sets_in(folder), (Names{"w00000006", "w00000002"}));
    EXPECT_NO_THROW(CheckpointSets(folder.path()).verified("w00000002"));
    const std::string log = text_of(folder.files().log);
    EXPECT_NE(log.find("no checkpoint after window 4: grains rank 0: cannot write"),
              std::string::npos)
        << log;
    EXPECT_NE(log.find("The last one is checkpoints/w00000002."), std::string::npos) << log;
}

}  // namespace
}  // namespace turbidite
