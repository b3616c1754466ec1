// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/prepare_run.hpp"

#include <gtest/gtest.h>

#include "coupler/protocol/failure.hpp"
#include "launcher/job/folder/run_json.hpp"
#include "tests/call_trace.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

std::string refusal(const RunOrder& order) {
    try {
        make_run_folder(order, "case");
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_input);
        return failure.what();
    }
    return "";
}

ResolvedCase dry_case(const ScratchFolder& scratch) {
    return load_case(scratch.write("dry.yaml",
                                   "domain: {size: [8, 9]}\ngrains: {count: 7}\n"
                                   "fluid: {enabled: false}\ntime: {step: 0.1, end: 1}\n"));
}

TEST(PrepareRun, FolderIsAbsoluteAndNew) {
    const ScratchFolder scratch;
    const RunFolder folder = make_run_folder({.out = scratch.path() / "new/run/"}, "case");
    EXPECT_EQ(folder.root, scratch.path() / "new/run");
    EXPECT_TRUE(fs::is_directory(folder.logs()));
}

TEST(PrepareRun, RefusesAFolderInUse) {
    const ScratchFolder scratch;
    scratch.write("run/case.yaml", "# Resolved case: old\n");
    const std::string text = refusal({.out = scratch.path() / "run"});
    EXPECT_SAYS(text, "is not empty");
    EXPECT_SAYS(text, "--force");
    EXPECT_SAYS(text, "Exit code 2.");
}

TEST(PrepareRun, ForceRemovesOnlyWhatARunWrites) {
    const ScratchFolder scratch;
    scratch.write("run/case.yaml", "# Resolved case: old\n");
    scratch.write("run/STOP", "130");
    scratch.write("run/probes.csv", "time\n");
    scratch.write("run/view.py", "old");
    scratch.write("run/contacts/problem_10.dat", "old");
    scratch.write("run/thesis.tex", "mine");
    const RunFolder folder =
        make_run_folder({.out = scratch.path() / "run", .force = true}, "case");
    EXPECT_FALSE(fs::exists(folder.resolved_case()));
    EXPECT_FALSE(fs::exists(folder.stop()));
    EXPECT_FALSE(fs::exists(folder.root / "probes.csv"));
    EXPECT_FALSE(fs::exists(folder.view()));
    EXPECT_FALSE(fs::exists(folder.root / "contacts"));
    EXPECT_TRUE(fs::exists(folder.root / "thesis.tex"));
}

// logs/ and fluid/ are common names: without a run beside them they belong to someone else.
TEST(PrepareRun, ForceTouchesNoFolderWithoutARun) {
    const ScratchFolder scratch;
    scratch.write("home/logs/diary.log", "mine");
    for (const bool force : {false, true}) {
        const std::string text = refusal({.out = scratch.path() / "home", .force = force});
        EXPECT_SAYS(text, "is not empty, and no run is in it");
        EXPECT_EQ(text.find("--force"), std::string::npos) << text;  // it would be refused
    }
    EXPECT_TRUE(fs::exists(scratch.path() / "home/logs/diary.log"));
}

// It may be anything: notes, another program's list of versions.
TEST(PrepareRun, AFileCalledLockOfSomebodysOwnStays) {
    const ScratchFolder scratch;
    scratch.write("mine/lock", "data");
    scratch.write("mine/notes.txt", "mine");
    EXPECT_SAYS(refusal({.out = scratch.path() / "mine"}), "lock has content");
    EXPECT_TRUE(fs::exists(scratch.path() / "mine/lock"));
}

// `turbidite new` writes a case.yaml, and grains of one's own may lie beside it.
TEST(PrepareRun, ForceTouchesNoCaseThatSomebodyHasWritten) {
    const ScratchFolder scratch;
    scratch.write("home/case.yaml", "# mine\ndomain: {size: [8, 8]}\n");
    scratch.write("home/grains/mine.csv", "id,x,y\n");
    for (const bool force : {false, true}) {
        const std::string text = refusal({.out = scratch.path() / "home", .force = force});
        EXPECT_SAYS(text, "is not empty, and no run is in it");
    }
    EXPECT_TRUE(fs::exists(scratch.path() / "home/case.yaml"));
    EXPECT_TRUE(fs::exists(scratch.path() / "home/grains/mine.csv"));
}

// Killed, or on a full disk: what is there is written anew, and nothing else is taken for it.
TEST(PrepareRun, ARunThatEndedBeforeItHadACaseLeavesAnEmptyFolder) {
    const ScratchFolder scratch;
    scratch.write("run/lock", "");
    scratch.write("run/grains/initial.csv", "id,");
    scratch.write("run/grains/walls.csv.part.123", "x");
    fs::create_directories(scratch.path() / "run/logs");
    EXPECT_EQ(make_run_folder({.out = scratch.path() / "run"}, "case").root,
              scratch.path() / "run");
    scratch.write("run/grains/mine.csv", "1");
    EXPECT_SAYS(refusal({.out = scratch.path() / "run"}), "is not empty, and no run is in it");
}

TEST(PrepareRun, DefaultFolderIsFreshAndPlain) {
    const ScratchFolder scratch;
    const fs::path before = fs::current_path();
    fs::current_path(scratch.path());
    const RunFolder first = make_run_folder({}, "my \"case\"");
    const RunFolder second = make_run_folder({}, "my \"case\"");
    fs::current_path(before);
    EXPECT_NE(first.root, second.root);
    EXPECT_SAYS(first.root.filename().string(), "my__case_-");
}

TEST(PrepareRun, RefusesAFileAndPathsOpenFoamCannotRead) {
    const ScratchFolder scratch;
    scratch.write("file", "x");
    EXPECT_SAYS(refusal({.out = scratch.path() / "file", .force = true}), "is a file");
    EXPECT_SAYS(refusal({.out = scratch.path() / "my run"}),
                "has a space, a quote or a backslash in its path");
    EXPECT_SAYS(refusal({.out = scratch.path() / "back\\slash"}), "backslash in its path");
    EXPECT_EQ(refusal({.out = scratch.path() / "my run", .for_openfoam = false}), "");
    EXPECT_SAYS(refusal({.out = scratch.path() / "file/run"}), "cannot be created");
}

TEST(PrepareRun, RunFolderLoadsToTheSameCase) {
    const ScratchFolder scratch;
    const ResolvedCase resolved = dry_case(scratch);
    const RunFolder folder = make_run_folder({.out = scratch.path() / "run"}, resolved.name);
    prepare_run(resolved, folder, {"mpirun", "x"});
    EXPECT_EQ(load_run_folder(folder.root).settings.entries(), resolved.settings.entries());
    const auto record = read_run_json(folder.record());
    EXPECT_EQ(record.at("case_hash"), resolved.settings.text("run.hash"));
    EXPECT_EQ(record.at("command"), "mpirun x");
    EXPECT_EQ(record.at("out"), folder.root.string());
    EXPECT_EQ(record.at("grains"), 7);
    EXPECT_EQ(record.at("windows"), 10);
    EXPECT_TRUE(record.at("exit_code").is_null());
}

TEST(PrepareRun, AScriptShowsTheRunInParaView) {
    const ScratchFolder scratch;
    const Programs programs = find_programs();
    const auto size = [](const RunFolder& folder) { return fs::file_size(folder.view()); };
    const RunFolder folder = make_run_folder({.out = scratch.path() / "run"}, "case");
    add_view(folder, programs);
    EXPECT_EQ(size(folder), fs::file_size(programs.view()));
    // A script of the user's stays.
    const RunFolder other = make_run_folder({.out = scratch.path() / "other"}, "case");
    scratch.write("other/view.py", "mine");
    add_view(other, programs);
    EXPECT_EQ(size(other), 4u);
}

// Before the job begins, and with it the first checkpoint: a power cut then leaves a folder with
// which `resume` can do something.
TEST(PrepareRun, TheDiskHasCaseGrainsAndMesh) {
    const ScratchFolder scratch;
    const ResolvedCase resolved = load_case(scratch.write(
        "wet.yaml",
        "domain: {size: [4, 4]}\ngrains: {count: 3, adapter: standalone-nscd}\n"
        "fluid: {cells_per_diameter: 4, reynolds: 30, ranks: 2}\ntime: {step: 0.1, end: 1}\n"));
    const trace::Recorder recorder;
    const RunFolder folder = make_run_folder({.out = scratch.path() / "runs/mine"}, "wet");
    prepare_run(resolved, folder, {"mpirun"});
    auto there = trace::on_disk(recorder.calls());
    std::vector<fs::path> needed{folder.resolved_case(), folder.record(), folder.root,
                                 folder.root.parent_path(), scratch.path()};
    for (const fs::path& tree : {folder.grains(), folder.fluid()}) {
        needed.push_back(tree);
        for (const auto& entry : fs::recursive_directory_iterator(tree)) needed.push_back(entry);
    }
    for (const char* file : {"grains/initial.csv", "fluid/constant/polyMesh/points",
                             "fluid/processor1/constant/polyMesh/points", "fluid/0/U"})
        EXPECT_TRUE(fs::exists(folder.root / file)) << file;
    for (const fs::path& path : needed)
        EXPECT_TRUE(there[path] == trace::version_of(path)) << path << " is not on the disk";
}

TEST(PrepareRun, MissingProgramsAreNamed) {
    const ScratchFolder scratch;
    try {
        require_programs(dry_case(scratch), {scratch.path() / "turbidite-nothing"});
        FAIL() << "a missing program was accepted";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_input);
        EXPECT_SAYS(std::string(failure.what()), "turbidite-nothing is missing");
    }
}

}  // namespace
}  // namespace turbidite
