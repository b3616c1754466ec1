// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `turbidite study`: a sweep that is run, continued and refused.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <sstream>

#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const char* const a_column = R"(
domain: {size: [8, 8]}
grains: {adapter: standalone-nscd, generator: lattice, region: [4, 4]}
fluid: {enabled: false}
time: {step: 0.01, end: 0.5}
output: {interval: 0.1}
)";

class StudyRuns : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("column.yaml", a_column);
        scratch.write("frictions.yaml",
                      "{case: column.yaml, sweep: {contact.friction: [0, 0.3, 0.6]}}");
    }

    Answer study(const std::string& arguments) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " study frictions.yaml --out s " + arguments);
    }

    std::filesystem::file_time_type written(const std::string& run) const {
        return std::filesystem::last_write_time(scratch.path() / "s/frictions" / run /
                                                "history.csv");
    }

    /// The cells of a column of study.csv.
    std::vector<std::string> column(const std::string& name) const {
        std::istringstream table(text(scratch.path() / "s/study.csv"));
        std::vector<std::string> cells;
        std::size_t at = 0;
        for (std::string line; std::getline(table, line);) {
            std::vector<std::string> row;
            std::istringstream words(line + ",");
            for (std::string word; std::getline(words, word, ',');) row.push_back(word);
            if (cells.empty())
                at =
                    static_cast<std::size_t>(std::find(row.begin(), row.end(), name) - row.begin());
            cells.push_back(at < row.size() ? row[at] : "");
        }
        cells.erase(cells.begin());
        return cells;
    }

    long lines(const std::string& file) const {
        const std::string content = text(scratch.path() / file);
        return std::count(content.begin(), content.end(), '\n');
    }
};

TEST_F(StudyRuns, PlaysWhatIsMissingAndTabulatesAll) {
    const Answer first = study("");
    ASSERT_EQ(first.code, 0) << first.out << first.err;
    EXPECT_SAYS(first.out, "[3/3] frictions/friction-0.6");
    EXPECT_SAYS(first.out, "3 of 3 runs done");
    EXPECT_EQ(lines("s/study.csv"), 4);
    EXPECT_SAYS(text(scratch.path() / "s/study.html"), "Against contact.friction");
    EXPECT_GT(std::filesystem::file_size(scratch.path() /
                                         "s/pictures/frictions-contact.friction-peak_velocity.png"),
              1000u);

    // Of a dry column that collapses: its energy is accounted for.
    for (const std::string& defect : column("energy_defect")) EXPECT_LT(std::stod(defect), 1e-6);
    EXPECT_NE(column("to_contacts")[0], "");
    EXPECT_EQ(column("to_fluid")[0], "");
    EXPECT_EQ(column("bed_height")[0], "") << "an avalanche";

    std::filesystem::remove_all(scratch.path() / "s/frictions/friction-0.3");
    const auto before = written("friction-0.6");
    const Answer second = study("");
    ASSERT_EQ(second.code, 0) << second.err;
    EXPECT_SAYS(second.out, "3 runs, 2 of them done");
    EXPECT_SAYS(second.out, "frictions/friction-0.3");
    EXPECT_EQ(second.out.find("[1/3]"), std::string::npos) << second.out;
    EXPECT_EQ(written("friction-0.6"), before);
}

TEST_F(StudyRuns, GoesOnAfterARunThatFails) {
    // With windows of half a t_c, grains fall through the floor of the second run.
    scratch.write("frictions.yaml",
                  "{case: column.yaml, variants: {good: {}, coarse: {time.step: 0.5, time.end: 5, "
                  "limits.penetration: 1e-9}, fine: {time.step: 0.005}}}");
    const Answer answer = study("");
    EXPECT_EQ(answer.code, 6) << answer.out << answer.err;
    EXPECT_SAYS(answer.out, "2 of 3 runs done");
    const std::string table = text(scratch.path() / "s/study.csv");
    EXPECT_SAYS(table, "physics refused");
    EXPECT_SAYS(table, "limits.penetration");
    EXPECT_SAYS(text(scratch.path() / "s/study.html"), "coarse</code>: physics refused");
}

/// A PATH with a program in the place of mpirun alone.
std::string with_mpirun(const ScratchFolder& scratch, const std::string& script) {
    const fs::path file = scratch.write("bin/mpirun", script);
    fs::permissions(file, fs::perms::owner_all);
    return "PATH=" + file.parent_path().string();
}

// Which a shell, too, ends with when it finds no command: it says nothing about mpirun.
TEST_F(StudyRuns, GoesOnWhereARunCannotBePlayed) {
    const fs::path notes = scratch.path() / "s/frictions/friction-0/notes.txt";
    fs::create_directories(notes.parent_path());
    scratch.write("s/frictions/friction-0/notes.txt", "the user's");
    const Answer answer = study("");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "frictions/friction-0: it cannot be played: ");
    EXPECT_SAYS(answer.err, "is not empty, and no run is in it");
    EXPECT_SAYS(answer.out, "2 of 3 runs done");
    EXPECT_EQ(column("status"), (std::vector<std::string>{"missing", "done", "done"}));
    EXPECT_SAYS(text(scratch.path() / "s/study.csv"), "is not empty, and no run is in it");
    EXPECT_SAYS(text(scratch.path() / "s/study.html"), "frictions/friction-0</code>: missing. ");
    EXPECT_EQ(text(notes), "the user's");
}

TEST_F(StudyRuns, GoesOnAfterAProgramThatEndsWith127) {
    const std::string path =
        with_mpirun(scratch,
                    "#!/bin/sh\nfor word; do case $before in *turbidite-member) run=$word;; esac; "
                    "before=$word; "
                    "done\nprintf '4\\ngrains rank 0\\nended with status 127' > "
                    "$run/logs/first_end\nexit 127\n");
    const Answer answer =
        shell(path + ":$PATH " + TURBIDITE_PROGRAM + " study frictions.yaml --out s");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "grains rank 0 ended with status 127");
    EXPECT_SAYS(answer.out, "0 of 3 runs done");
    for (const char* run : {"friction-0", "friction-0.3", "friction-0.6"})
        EXPECT_SAYS(text(scratch.path() / "s/frictions" / run / "run.json"), "\"failed\"");
}

TEST_F(StudyRuns, GoesOnWhereNoJobCanBeStarted) {
    const std::string path = with_mpirun(scratch, "#!/no/such/shell\n");
    // Another mpirun would be taken instead.
    const Answer answer = shell(path + " " + TURBIDITE_PROGRAM + " study frictions.yaml --out s");
    EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
    EXPECT_SAYS(answer.err,
                "friction-0.6: it stays as it is, and the next call tries again: mpirun cannot be "
                "started: No such file or directory");
    EXPECT_SAYS(answer.out, "0 of 3 runs done");
    EXPECT_EQ(lines("s/study.csv"), 4);
}

// Interrupted during its second run; the same command then runs the rest.
TEST_F(StudyRuns, IsContinuedAfterAnInterruption) {
    scratch.write(
        "frictions.yaml",
        "{case: column.yaml, sweep: {time.end: [0.1, 40, 0.2]}, set: {time.step: 0.001}}");
    const Answer stopped = shell(
        std::string(TURBIDITE_PROGRAM) +
        " study frictions.yaml --out s & job=$!; until [ -s s/frictions/end-40/history.csv ]; do "
        "sleep 0.1; done; kill -INT $job; wait $job");
    EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
    EXPECT_SAYS(stopped.out, "1 of 3 runs done");
    EXPECT_EQ(stopped.out.find("[3/3]"), std::string::npos) << stopped.out;
    scratch.write(
        "frictions.yaml",
        "{case: column.yaml, sweep: {time.end: [0.1, 0.3, 0.2]}, set: {time.step: 0.001}}");
    const Answer rest = study("");
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_SAYS(rest.out, "3 runs, 1 of them done");
    EXPECT_SAYS(rest.out, "3 of 3 runs done");
}

// Its last window is over before the run could be stopped: it is done, and the study stops.
TEST_F(StudyRuns, IsStoppedByASignalAfterTheLastWindowOfARun) {
    const Answer stopped =
        shell(std::string(TURBIDITE_PROGRAM) +
              " study frictions.yaml --out s & job=$!; until grep -q '\"status\": \"done\"' "
              "s/frictions/friction-0/run.json; do sleep 0.02; done 2> /dev/null; kill -INT $job; "
              "wait $job");
    EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
    EXPECT_EQ(stopped.out.find("[3/3]"), std::string::npos) << stopped.out;
    EXPECT_FALSE(fs::exists(scratch.path() / "s/frictions/friction-0/STOP"));
}

TEST_F(StudyRuns, ARunWhoseReportWasInterruptedGetsItNextTime) {
    scratch.write("frictions.yaml", "{case: column.yaml, sweep: {contact.friction: [0.3]}}");
    const std::string with_reports =
        "export TURBIDITE_REPORT=on; " + std::string(TURBIDITE_PROGRAM);
    const Answer stopped = shell(with_reports +
                                 " study frictions.yaml --out s & job=$!; until pgrep -P $job "
                                 "python3; do sleep 0.1; done > /dev/null; sleep 0.5; "
                                 "kill -INT $job; wait $job");
    EXPECT_EQ(stopped.code, 130) << stopped.out << stopped.err;
    EXPECT_SAYS(stopped.err, "Stopped. turbidite report ");
    EXPECT_EQ(stopped.err.find("Traceback"), std::string::npos) << stopped.err;
    EXPECT_FALSE(fs::exists(scratch.path() / "s/frictions/friction-0.3/report.html"));
    const Answer rest = shell(with_reports + " study frictions.yaml --out s");
    EXPECT_EQ(rest.code, 0) << rest.err;
    EXPECT_SAYS(rest.out, "report of frictions/friction-0.3\n");
    EXPECT_TRUE(fs::exists(scratch.path() / "s/frictions/friction-0.3/report.html"));
}

/// The window of the newest checkpoint of a run, 0 without any. A set stays for two checkpoints
/// only, less than a moment of a machine that does other work.
int last_checkpoint(const fs::path& run) {
    int last = 0;
    std::error_code none;
    for (const auto& set : fs::directory_iterator(run / "checkpoints", none))
        if (const std::string name = set.path().filename(); name[0] == 'w')
            last = std::max(last, std::atoi(name.c_str() + 1));
    return last;
}

std::vector<int> numbers_after(const std::string& words, const std::string& text) {
    std::vector<int> numbers;
    for (std::size_t at = text.find(words); at != std::string::npos;
         at = text.find(words, at + words.size()))
        numbers.push_back(std::atoi(text.c_str() + at + words.size()));
    return numbers;
}

// Killed with SIGKILL, the job with it, in three different runs; the table is that of a study that
// nothing ended, and no run that had got to a checkpoint starts afresh.
TEST_F(StudyRuns, KilledThreeTimesItGivesTheSameTable) {
    scratch.write(
        "frictions.yaml",
        "{case: column.yaml, sweep: {contact.friction: [0, 0.3, 0.6]}, set: {time.end: 4, "
        "time.step: 0.002, checkpoint.windows: 50}}");
    const std::string line = std::string(TURBIDITE_PROGRAM) + " study frictions.yaml --out ";
    ASSERT_EQ(shell("timeout 100 " + line + "whole").code, 0);
    std::string said;
    const auto kill_when = [&](const std::function<bool()>& due) {
        const pid_t run = begin(line + "s");
        for (int i = 0; i < 6000 && !due(); ++i)
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        const Answer killed = kill_all(run, scratch.path() / "s");
        EXPECT_EQ(killed.code, 128 + SIGKILL) << killed.out << killed.err;
        said += killed.out;
    };
    const fs::path runs = scratch.path() / "s/frictions";
    kill_when([&] { return last_checkpoint(runs / "friction-0") >= 100; });
    kill_when([&] { return last_checkpoint(runs / "friction-0.3") >= 450; });
    kill_when([&] { return fs::exists(runs / "friction-0.6/history.csv"); });
    const Answer rest = study("");
    EXPECT_EQ(rest.code, 0) << rest.err;
    said += rest.out;
    const std::vector<int> gone_on = numbers_after("goes on after window ", said);
    ASSERT_GE(gone_on.size(), 2u) << said;
    EXPECT_GE(gone_on[0], 100);
    EXPECT_GE(gone_on[1], 450);
    EXPECT_SAYS(rest.out, "3 of 3 runs done");
    const auto table = [&](const char* folder) {
        return lines_without_wall_times(text(scratch.path() / folder / "study.csv"));
    };
    EXPECT_EQ(table("s"), table("whole"));
    EXPECT_EQ(table("s").size(), 4u);
}

// What another version has done with other defaults is hours of work, and its results.
TEST_F(StudyRuns, RunsOfAnotherVersionStayUnlessTheyAreAskedForAgain) {
    scratch.write("frictions.yaml", "{case: column.yaml, sweep: {random.seed: [1, 2]}}");
    ASSERT_EQ(study("").code, 0);
    // As if rolling_friction had been 0.1 by default when seed-1 was played.
    const fs::path run = scratch.path() / "s/frictions/seed-1";
    std::string resolved = text(run / "case.yaml");
    const std::string now = "  rolling_friction: 0", then = "  rolling_friction: 0.1";
    ASSERT_NE(resolved.find(now), std::string::npos);
    resolved.replace(resolved.find(now), now.size(), then);
    scratch.write("s/frictions/seed-1/case.yaml", resolved);
    nlohmann::json record = nlohmann::json::parse(text(run / "run.json"));
    record["case_hash"] = "of another version";
    scratch.write("s/frictions/seed-1/run.json", record.dump());
    scratch.write("s/frictions/seed-1/mine.txt", "notes");
    const auto before = written("seed-1");

    EXPECT_SAYS(study("--dry-run").out, "kept ");
    const Answer kept = study("");
    EXPECT_EQ(kept.code, 0) << kept.err;
    EXPECT_SAYS(kept.out, "2 runs, 2 of them done");
    EXPECT_SAYS(kept.err, "frictions/seed-1 was played with contact.rolling_friction: 0.1, now 0");
    EXPECT_SAYS(kept.err, "--again");
    EXPECT_EQ(written("seed-1"), before);

    const auto other = written("seed-2");
    const Answer again = study("--again");
    EXPECT_EQ(again.code, 0) << again.err;
    EXPECT_SAYS(again.err, "the run that was there is now " + run.string() + "-old-1");
    EXPECT_SAYS(again.out, "2 of 2 runs done");
    EXPECT_EQ(text(run.string() + "-old-1/mine.txt"), "notes");
    EXPECT_EQ(written("seed-1-old-1"), before);
    EXPECT_NE(written("seed-1"), before);
    EXPECT_EQ(written("seed-2"), other);
    EXPECT_EQ(study("").err, "");
}

TEST_F(StudyRuns, ARunOfAnotherCaseIsPutAside) {
    scratch.write("frictions.yaml", "{case: column.yaml, sweep: {random.seed: [1]}}");
    ASSERT_EQ(study("").code, 0);
    const auto before = written("seed-1");
    scratch.write("frictions.yaml",
                  "{case: column.yaml, sweep: {random.seed: [1]}, set: {contact.friction: 0.1}}");
    const Answer answer = study("");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.err, "frictions/seed-1: the run that was there is now ");
    EXPECT_EQ(written("seed-1-old-1"), before);
}

class StudyGoesOn : public StudyRuns {
 protected:
    const fs::path run = scratch.path() / "s/frictions/seed-1";
    std::vector<std::string> whole;

    /// A run that was killed, by its record, after its last checkpoint but one.
    void SetUp() override {
        StudyRuns::SetUp();
        scratch.write(
            "frictions.yaml",
            "{case: column.yaml, sweep: {random.seed: [1]}, set: {checkpoint.windows: 10}}");
        ASSERT_EQ(study("").code, 0);
        whole = history();
        fs::remove_all(run / "checkpoints/w00000050");
        ASSERT_TRUE(fs::exists(run / "checkpoints/w00000040"));
        nlohmann::json record = nlohmann::json::parse(text(run / "run.json"));
        record["status"] = "prepared", record["exit_code"] = nullptr, record["windows_done"] = 0;
        scratch.write("s/frictions/seed-1/run.json", record.dump());
    }

    std::vector<std::string> history() const { return lines_of_history("s/frictions/seed-1"); }

    /// Of the settings in its manifest.
    void change_settings(const std::function<void(nlohmann::ordered_json&)>& change) const {
        const fs::path file = run / "checkpoints/w00000040/manifest.json";
        auto manifest = nlohmann::ordered_json::parse(text(file));
        change(manifest["settings"]);
        std::ofstream(file) << manifest.dump(2);
    }
};

TEST_F(StudyGoesOn, WithSettingsThatOnlyOneVersionKnows) {
    change_settings([](nlohmann::ordered_json& settings) {
        settings["run.of_an_earlier_version"] = "1";
        settings["contact.of_an_earlier_version"] = "1";
        settings.erase("contact.rolling_friction");
        settings.erase("run.slip_tolerance");
    });
    const Answer answer = study("");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "goes on after window 40,");
    EXPECT_FALSE(fs::exists(run.string() + "-old-1"));
    EXPECT_EQ(history(), whole);
}

TEST_F(StudyGoesOn, AndPutsAsideWhatCannotGoOn) {
    change_settings([](nlohmann::ordered_json& settings) { settings["contact.friction"] = "0.7"; });
    const Answer answer = study("");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.err, "it starts afresh: ");
    EXPECT_SAYS(answer.err, "contact.friction is 0.3, in the checkpoint 0.7");
    EXPECT_SAYS(answer.err, "frictions/seed-1: the run that was there is now ");
    EXPECT_TRUE(fs::exists(run.string() + "-old-1/checkpoints/w00000040/manifest.json"));
    EXPECT_EQ(history(), whole);
}

// A disk that is full, here a folder where a file is to be written: the next call may find it
// empty.
TEST_F(StudyGoesOn, AndLeavesWhatSomethingElseIsInTheWayOf) {
    scratch.write("s/frictions/seed-1/run.json.part/x", "");
    const Answer blocked = study("");
    EXPECT_EQ(blocked.code, 4) << blocked.out << blocked.err;
    EXPECT_SAYS(blocked.err,
                "frictions/seed-1: it stays as it is, and the next call tries again: ");
    EXPECT_TRUE(fs::exists(run / "checkpoints/w00000040"));
    EXPECT_FALSE(fs::exists(run.string() + "-old-1"));
    fs::remove_all(run / "run.json.part");
    const Answer answer = study("");
    EXPECT_EQ(answer.code, 0) << answer.err;
    EXPECT_SAYS(answer.out, "goes on after window 40,");
    EXPECT_EQ(history(), whole);
}

// Two processes share a study: every run is played once, both play some, at least once both at the
// same time, and the last to end writes the table of all.
TEST_F(StudyRuns, TwoAtOnceShareTheRuns) {
    scratch.write("frictions.yaml",
                  "{case: column.yaml, sweep: {random.seed: [1, 2, 3, 4, 5]}, set: {time.end: 2, "
                  "time.step: 0.002}}");
    const std::string line =
        "timeout 100 " + std::string(TURBIDITE_PROGRAM) + " study frictions.yaml --out s";
    const Answer answer =
        shell(fmt::format("{0} > first & {0} > second; code=$?; wait %1 && exit $code", line));
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    const std::string first = text(scratch.path() / "first"),
                      second = text(scratch.path() / "second");
    EXPECT_SAYS(first + second, "being played by another `turbidite study`");
    EXPECT_SAYS(first + second, "5 of 5 runs done");
    for (int seed = 1; seed <= 5; ++seed) {
        const std::string start = fmt::format("[{}/5] frictions/seed-{}", seed, seed);
        EXPECT_NE(first.find(start) == std::string::npos, second.find(start) == std::string::npos)
            << start << "\n"
            << first << second;
    }
    EXPECT_SAYS(first, "/5] frictions/seed-");
    EXPECT_SAYS(second, "/5] frictions/seed-");
    EXPECT_EQ(column("status"), std::vector<std::string>(5, "done"));
}

// The second process comes to the end of the list after the run has failed in the first. Before
// that run there is another one, so that both have begun when it fails.
TEST_F(StudyRuns, ARunThatFailsIsPlayedByOneOfTwo) {
    scratch.write("frictions.yaml",
                  "{case: column.yaml, variants: {a: {}, coarse: {time.step: 0.5, time.end: 5, "
                  "limits.penetration: 1e-9}, b: {}, c: {}}, set: {time.end: 2, time.step: "
                  "0.002}}");
    const std::string line =
        "timeout 100 " + std::string(TURBIDITE_PROGRAM) + " study frictions.yaml --out s";
    shell(fmt::format("{0} > first & {0} > second; wait", line));
    const std::string said = text(scratch.path() / "first") + text(scratch.path() / "second");
    const std::string announced = "] frictions/coarse";
    const auto played = said.find(announced);
    EXPECT_NE(played, std::string::npos) << said;
    EXPECT_EQ(said.find(announced, played + 1), std::string::npos) << said;
    EXPECT_SAYS(text(scratch.path() / "s/study.csv"), "physics refused");
    EXPECT_SAYS(said, "3 of 4 runs done");
}

TEST_F(StudyRuns, NothingStartsWhenARunIsWrong) {
    scratch.write("frictions.yaml",
                  "{case: column.yaml, sweep: {contact.friction: [0, 0.3, -0.6]}}");
    for (const char* command : {"study frictions.yaml --out s", "check frictions.yaml"}) {
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) + " " + command);
        EXPECT_EQ(answer.code, 2) << command;
        EXPECT_SAYS(answer.err, "contact.friction = -0.6");
        EXPECT_FALSE(std::filesystem::exists(scratch.path() / "s"));
    }
}

TEST_F(StudyRuns, SaysBeforehandThatTheDiskIsTooSmall) {
    const Answer room = study("--dry-run");
    EXPECT_EQ(room.err, "");
    const Answer none = study("--dry-run --set time.end=1e10");
    EXPECT_EQ(none.code, 0);
    EXPECT_SAYS(none.err, " GB of files are to come, ");
    EXPECT_SAYS(none.err, " are free in " + scratch.path().string());
}

TEST_F(StudyRuns, AnotherStudyInTheFolderIsTold) {
    scratch.write("frictions.yaml",
                  "{case: column.yaml, set: {time.end: 0.1}, sweep: {contact.friction: [0.3]}}");
    ASSERT_EQ(study("").code, 0);
    EXPECT_EQ(study("--dry-run").err, "");
    fs::copy_file(scratch.path() / "frictions.yaml", scratch.path() / "others.yaml");
    const std::string others = std::string(TURBIDITE_PROGRAM) + " study others.yaml --out s";
    const Answer told = shell(others + " --dry-run");
    EXPECT_SAYS(told.err, "has the table and figures of another study");
    EXPECT_SAYS(told.err, "frictions.yaml --out");
    EXPECT_SAYS(study("--dry-run --set time.end=0.2").out, "changed ");
    EXPECT_SAYS(study("--dry-run --set time.end=0.2").err, "is renamed to ...-old-1");
    const Answer a_case = shell(std::string(TURBIDITE_PROGRAM) + " study column.yaml");
    EXPECT_EQ(a_case.code, 2);
    EXPECT_SAYS(a_case.err, "column.yaml is a case, which is one run");
    const Answer nowhere =
        shell(std::string(TURBIDITE_PROGRAM) + " study frictions.yaml --out /proc/nowhere");
    EXPECT_EQ(nowhere.code, 2);
    EXPECT_SAYS(nowhere.err, "/proc/nowhere cannot be made");
}

TEST_F(StudyRuns, ARecordOfSomethingElseStays) {
    scratch.write("frictions.yaml",
                  "{case: column.yaml, set: {time.end: 0.1}, sweep: {contact.friction: [0.3]}}");
    fs::create_directories(scratch.path() / "s");
    for (const char* foreign : {"{\"study\": \"of my own\"}\n", "[1, 2]\n"}) {
        scratch.write("s/study.json", foreign);
        const Answer refused = study("");
        EXPECT_EQ(refused.code, 2);
        EXPECT_SAYS(refused.err, "s/study.json would be overwritten. It is not of a study.");
        EXPECT_EQ(text(scratch.path() / "s/study.json"), foreign);
    }
    scratch.write("s/study.json", "");  // holds nothing that could be lost
    EXPECT_EQ(study("").code, 0);
}

TEST_F(StudyRuns, ADryRunListsTheRuns) {
    const Answer answer = study("--dry-run");
    EXPECT_EQ(answer.code, 0);
    EXPECT_SAYS(answer.out, "to do: roughly ");
    EXPECT_SAYS(answer.out, " MB of files\n");
    EXPECT_SAYS(answer.out, " s  frictions/friction-0.3");
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "s"));
}

}  // namespace
}  // namespace turbidite
