// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "launcher/study/other_defaults.hpp"
#include "launcher/study/study_plan.hpp"
#include "launcher/study/study_record.hpp"
#include "launcher/version.hpp"
#include "tests/unit/case/aliases.hpp"
#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

const char* const a_case = R"(
domain: {size: [8, 8]}
grains: {adapter: standalone-nscd, generator: lattice, region: [4, 4]}
fluid: {enabled: false}
contact: {friction: 0.3}
time: {step: 0.01, end: 1}
)";

class StudyTest : public ::testing::Test {
 protected:
    ScratchFolder scratch;

    void SetUp() override { scratch.write("column.yaml", a_case); }

    Study study(const std::string& text) const {
        scratch.write("study.yaml", text);
        return read_study(scratch.path() / "study.yaml");
    }

    std::vector<PlannedRun> plan(const std::string& text,
                                 const std::vector<std::string>& overrides = {}) const {
        return plan_study(study(text), overrides);
    }

    std::string refusal(const std::string& text) const {
        try {
            plan(text);
        } catch (const CaseRefused& refused) {
            return refused.what();
        }
        ADD_FAILURE() << "nothing was refused";
        return "";
    }
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST_F(StudyTest, PlaysEveryCombination) {
    const auto runs = plan(R"(
case: column.yaml
set: {time: {end: 0.5}}
variants: {smooth: {contact.friction: 0}, rough: {contact: {friction: 0.5}}}
sweep: {grains.compacity: [0.8, 0.9], random: {seed: [1, 2, 3]}}
)");
    ASSERT_EQ(runs.size(), 12u);
    EXPECT_EQ(runs.front().path(), "study/smooth-compacity-0.8-seed-1");
    EXPECT_EQ(runs.back().path(), "study/rough-compacity-0.9-seed-3");
    const Settings last = runs.back().resolve().settings;
    EXPECT_EQ(last.real("contact.friction"), 0.5);
    EXPECT_EQ(last.real("grains.compacity"), 0.9);
    EXPECT_EQ(last.integer("random.seed"), 3);
    EXPECT_EQ(last.real("time.end"), 0.5);
    const std::vector<std::pair<std::string, std::string>> values = {
        {"variant", "rough"}, {"grains.compacity", "0.9"}, {"random.seed", "3"}};
    EXPECT_EQ(runs.back().values, values);
    EXPECT_NE(runs.front().hash, runs.back().hash);
}

TEST_F(StudyTest, ListsAreValuesToo) {
    const auto runs = plan("{case: column.yaml, sweep: {grains.region: [[4, 4], [6, 4]]}}");
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[1].name, "region-6_4");
    EXPECT_GT(runs[1].resolve().population.size(), runs[0].resolve().population.size());
}

TEST_F(StudyTest, ListsAreWrittenInAnyForm) {
    const std::string in_block = R"(
case: column.yaml
set:
  grains.region:
    - 6
    - 4
)";
    const auto runs = plan(in_block);
    ASSERT_EQ(runs.size(), 1u);
    EXPECT_EQ(runs[0].resolve().settings.text("grains.region"),
              plan("{case: column.yaml, set: {grains.region: [6, 4]}}")[0].resolve().settings.text(
                  "grains.region"));
}

// As an override a text is read again, where " #" begins a comment and ": " a map.
TEST_F(StudyTest, TextsInQuotesAreReadAsInACase) {
    const char* const grains = "id,x,y,radius\n1,4,4,0.5\n";
    for (const std::string name :
         {"grains #2.csv", "a: b.csv", "~", "[1, 2]", "two \"words\".csv"}) {
        scratch.write(name, grains);
        const std::string file = "{adapter: standalone-nscd, file: '" + name + "'}";
        const std::string rest =
            "domain: {size: [8, 8]}\nfluid: {enabled: false}\ntime: {step: 0.01, end: 1}\n";
        scratch.write("own.yaml", rest + "grains: " + file + "\n");
        scratch.write("of.yaml", rest + "grains: {adapter: standalone-nscd}\n");
        const std::string own = plan("{case: own.yaml}")[0].yaml;
        EXPECT_EQ(plan("{case: of.yaml, set: {grains.file: '" + name + "'}}")[0].yaml, own);
        const auto swept = plan("{case: of.yaml, sweep: {grains.file: ['" + name + "']}}");
        EXPECT_EQ(swept[0].yaml, own);
        EXPECT_EQ(swept[0].values[0].second, name);
        const auto quick = plan_study(study("{case: of.yaml, quick: {grains.file: '" + name +
                                            "'}, sweep: {grains.file: [none.csv]}}"),
                                      {}, true);
        EXPECT_EQ(quick[0].yaml, own);
        EXPECT_EQ(quick[0].values[0].second, name);
    }
}

TEST_F(StudyTest, HasPartsAndRunsWithoutASweep) {
    const auto runs = plan(R"(
parts:
  one: {case: column.yaml}
  many: {case: column.yaml, sweep: {random.seed: [1, 2]}}
)");
    ASSERT_EQ(runs.size(), 3u);
    EXPECT_EQ(runs[0].path(), "one/column");
    EXPECT_EQ(runs[2].path(), "many/seed-2");
}

TEST_F(StudyTest, OverridesGoToEveryRun) {
    for (const PlannedRun& run :
         plan("{case: column.yaml, sweep: {contact.friction: [0, 0.5]}}", {"time.end=0.1"}))
        EXPECT_EQ(run.resolve().settings.real("time.end"), 0.1);
}

TEST_F(StudyTest, ErrorsInAnyRunAreReportedOnceAndBeforeAnyStarts) {
    const std::string text = refusal(R"(
parts:
  first: {case: column.yaml, sweep: {contact.friction: [0.1, 0.2, -1], random.seed: [1, 2]}}
  second: {case: column.yaml, set: {contact.frictoin: 0.2}, sweep: {random.seed: [1, 2]}}
)");
    EXPECT_SAYS(text, "run first/friction--1-seed-1");
    EXPECT_SAYS(text, "contact.friction = -1");
    EXPECT_SAYS(text, "contact.frictoin is unknown");
    EXPECT_SAYS(text, "2 errors, nothing was started");
}

TEST_F(StudyTest, TheFileItselfIsRefusedWithLines) {
    const std::string text = refusal(R"(
out: somewhere
parts:
  a: {case: nowhere.yaml}
  b: {set: {time.end: 1}}
  c: {case: column.yaml, sweep: {random.seed: 3}, sweeep: {}}
)");
    EXPECT_SAYS(text, "study.yaml line 4: case: nowhere.yaml does not exist");
    EXPECT_SAYS(text, "study.yaml line 5: b has no case");
    EXPECT_SAYS(text, "study.yaml line 6: sweep.random.seed is not a list of values");
    EXPECT_SAYS(text, "Did you mean sweep?");
    EXPECT_SAYS(text, "4 errors");
}

TEST_F(StudyTest, PartsThatAreNoMapsAreRefusedWithLines) {
    const std::string text = refusal(R"(
parts:
  a: 3
  b: [column.yaml]
  c:
  d: {case: [column.yaml]}
)");
    EXPECT_SAYS(text, "study.yaml line 3: a contains no keys");
    EXPECT_SAYS(text, "study.yaml line 4: b contains no keys");
    EXPECT_SAYS(text, "c contains no keys");
    EXPECT_SAYS(text, "study.yaml line 6: d has no case");
    EXPECT_SAYS(text, "4 errors");
}

TEST_F(StudyTest, NothingIsReadThatIsNoStudy) {
    for (const char* text : {"3", "[1]", "", "parts: [1]", "{[a]: 3}", "out: [a]", "{case: {a: 1}}",
                             "{case: column.yaml, set: 3}", "{case: column.yaml, sweep: [1]}",
                             "{case: column.yaml, variants: {a: 3}}", "{case: column.yaml, out: }",
                             "{case: column.yaml, set: {a: &x [*x]}}"})
        EXPECT_SAYS(refusal(text), "nothing was started. Exit code 2.") << text;
}

// A part called "../x", or a run "..", would be played in somebody else's folder.
TEST_F(StudyTest, FoldersOfRunsLieInTheFolderOfTheStudy) {
    for (const char* name : {"../x", "a/b", "/tmp", "..", ".", "''", "a b", "it's", ".hidden"})
        EXPECT_SAYS(refusal("parts: {\"" + std::string(name == std::string("''") ? "" : name) +
                            "\": {case: column.yaml}}"),
                    "is no name of a part")
            << name;
    for (const char* name : {"..", ".", "///", "  "})
        EXPECT_SAYS(refusal("{case: column.yaml, variants: {\"" + std::string(name) +
                            "\": {time.end: 0.5}}}"),
                    "has a run called \"")
            << name;
    EXPECT_EQ(plan("parts: {a-b_c+1.5: {case: column.yaml}}").at(0).path(), "a-b_c+1.5/column");
}

TEST_F(StudyTest, AliasesOfAliasesAreBounded) {
    const std::string text = powers_of_ten();
    EXPECT_SAYS(refusal("case: column.yaml\nset: *a5\n" + text), "is not YAML");
    EXPECT_SAYS(refusal(text + "case: column.yaml\nset: *a5\n"), "more than 20000 values");
}

// Ten lists of ten values are two hundred bytes and ten thousand million runs.
TEST_F(StudyTest, TheNumberOfRunsIsBounded) {
    std::string text = "case: column.yaml\nsweep:\n";
    for (int n = 0; n < 10; ++n)
        text += "  k" + std::to_string(n) + ": [0, 1, 2, 3, 4, 5, 6, 7, 8, 9]\n";
    EXPECT_SAYS(refusal(text), "has 1e+10 runs");
    EXPECT_SAYS(refusal(text), "10000 runs at most");
}

TEST_F(StudyTest, WhatIsWrongWithFileAndCasesIsNamedTogether) {
    const std::string text = refusal(R"(
parts:
  a: {case: nowhere.yaml}
  b: {case: column.yaml, sweeep: {random.seed: [1]}, sweep: {random.seed: [1, 1]}}
  c: {case: column.yaml, sweep: {contact.friction: [0.1, 0.2, -1]}}
)");
    EXPECT_SAYS(text, "case: nowhere.yaml does not exist");
    EXPECT_SAYS(text, "sweeep is unknown");
    EXPECT_SAYS(text, "two runs b/seed-1");
    EXPECT_SAYS(text, "run c/friction--1");
    EXPECT_SAYS(text, "4 errors, nothing was started");
}

TEST_F(StudyTest, QuickTakesItsKeysInPlaceOfTheFullOnes) {
    const Study both = study(R"(
case: column.yaml
set: {time.end: 2, contact.friction: 0.1}
full: {time.step: 0.001}
quick: {time.end: 0.2, contact.friction: 0.2}
sweep: {random.seed: [1, 2]}
variants: {rough: {contact.friction: 0.5}, plain: {}}
)");
    const auto full = plan_study(both, {}), quick = plan_study(both, {}, true);
    ASSERT_EQ(full.size(), 4u);
    ASSERT_EQ(quick.size(), 4u);
    EXPECT_EQ(full[2].path(), quick[2].path());
    const Settings f = full[2].resolve().settings, q = quick[2].resolve().settings;
    EXPECT_EQ(f.real("time.end"), 2);
    EXPECT_EQ(f.real("time.step"), 0.001);
    EXPECT_EQ(f.real("contact.friction"), 0.1);
    EXPECT_EQ(q.real("time.end"), 0.2);
    EXPECT_EQ(q.real("time.step"), 0.01);
    EXPECT_EQ(q.real("contact.friction"), 0.2);
    EXPECT_EQ(quick[0].resolve().settings.real("contact.friction"), 0.5) << "of the variant";
    EXPECT_GT(full[2].seconds, quick[2].seconds);
    EXPECT_GT(full[2].disk, quick[2].disk);
    EXPECT_DOUBLE_EQ(predicted_disk({&full[0], &full[2]}), full[0].disk + full[2].disk);
    EXPECT_SAYS(forecast_text({&full[0], &full[2]}), " of files");
}

TEST_F(StudyTest, AQuickKeyTakesThePlaceOfItsSweep) {
    const Study both = study(R"(
case: column.yaml
quick: {random: {seed: 2}}
sweep: {random.seed: [1, 2, 3], contact.friction: [0, 0.5]}
)");
    EXPECT_EQ(plan_study(both, {}).size(), 6u);
    const auto quick = plan_study(both, {}, true);
    ASSERT_EQ(quick.size(), 2u);
    EXPECT_EQ(quick[1].path(), "study/seed-2-friction-0.5");
    EXPECT_EQ(quick[1].values[0].second, "2");
}

// Names, tables and figures say what was played.
TEST_F(StudyTest, SetReplacesTheListOfASweptKey) {
    const std::string sweep = "{case: column.yaml, sweep: {contact.friction: [0.1, 0.2]}}";
    for (const std::string set : {"contact.friction=0.9", "contact={friction: 0.9}"}) {
        const auto runs = plan(sweep, {set});
        ASSERT_EQ(runs.size(), 1u) << set;
        EXPECT_EQ(runs[0].path(), "study/friction-0.9");
        EXPECT_EQ(runs[0].values[0].second, "0.9");
        EXPECT_EQ(runs[0].resolve().settings.real("contact.friction"), 0.9);
    }
    EXPECT_EQ(plan(sweep, {"time.end=0.5"}).size(), 2u);
}

TEST_F(StudyTest, AVariantDoesNotSetWhatIsSwept) {
    EXPECT_SAYS(refusal("{case: column.yaml, variants: {rough: {contact: {friction: 0.9}}}, "
                        "sweep: {contact.friction: [0.2]}}"),
                "variant rough sets contact.friction, which is swept");
}

TEST_F(StudyTest, KeysAreGivenOnce) {
    EXPECT_SAYS(
        refusal("{case: column.yaml, set: {contact.friction: 0.1, contact: {friction: 0.4}}}"),
        "set gives contact.friction twice");
    EXPECT_SAYS(
        refusal("case: column.yaml\nsweep: {random.seed: [3]}\nsweep: {random.seed: [4]}\n"),
        "sweep is given twice");
    EXPECT_SAYS(refusal("case: column.yaml\n---\ncase: column.yaml\n"), "second document");
    EXPECT_SAYS(refusal("parts:\n  a: {case: column.yaml}\n  a: {case: column.yaml, set: "
                        "{contact.friction: 0.9}}\n"),
                "part a is given twice");
    EXPECT_SAYS(refusal("{case: column.yaml, variants: {}}"), "variants contains no names");
    EXPECT_FALSE(is_study(scratch.path()));
}

TEST_F(StudyTest, FiguresAreKnownSets) {
    EXPECT_EQ(study("{case: column.yaml, figures: paper}").figures, "paper");
    EXPECT_SAYS(refusal("{case: column.yaml, figures: papers}"), "figures: papers is unknown");
}

TEST_F(StudyTest, QuickIsRefusedWhereThereIsNone) {
    try {
        plan_study(study("{case: column.yaml}"), {}, true);
        ADD_FAILURE() << "nothing was refused";
    } catch (const CaseRefused& refused) {
        EXPECT_SAYS(std::string(refused.what()), "has no quick form");
    }
}

TEST_F(StudyTest, AKeyIsSweptOnce) {
    EXPECT_SAYS(refusal("case: column.yaml\nsweep:\n  contact: {friction: [0.1, 0.2]}\n"
                        "  contact.friction: [0.3]"),
                "study.yaml line 4: sweep gives contact.friction twice");
    EXPECT_SAYS(refusal("{case: column.yaml, sweep: {contact.friction: [0.1, 0.2, 1e-1]}}"),
                "sweep.contact.friction has 0.1 and 1e-1, which are one value");
    EXPECT_EQ(plan("{case: column.yaml, sweep: {contact.friction: [0.1, 0.2]}}").size(), 2u);
}

TEST_F(StudyTest, ValuesThatAreNoNumbersAreNotEqual) {
    const std::string text = refusal("{case: column.yaml, sweep: {contact.friction: [0.1, nan]}}");
    EXPECT_SAYS(text, "contact.friction = nan");
    EXPECT_EQ(text.find("are one value"), std::string::npos) << text;
}

// A sweep of a key that changes nothing would look like a result.
TEST_F(StudyTest, NotesOfItsRunsAreToldOnce) {
    const std::string text =
        remarks_text(plan("{case: column.yaml, set: {fluid.enabled: false}, "
                          "sweep: {fluid.reynolds: [1, 2, 5]}}"));
    EXPECT_SAYS(text, "note: fluid.reynolds");
    EXPECT_SAYS(text, "(3 of 3 runs; the first is study/reynolds-1)");
    EXPECT_EQ(text.find("fluid.reynolds"), text.rfind("fluid.reynolds")) << text;
}

TEST_F(StudyTest, ANameWithASpaceBecomesAFolder) {
    scratch.write("my study.yaml", "{case: column.yaml, sweep: {random.seed: [1, 2]}}");
    const Study study = read_study(scratch.path() / "my study.yaml");
    EXPECT_EQ(study.name, "my_study");
    EXPECT_EQ(plan_study(study, {}).front().path(), "my_study/seed-1");
}

TEST_F(StudyTest, AValueListedTwiceIsRefused) {
    EXPECT_SAYS(refusal("{case: column.yaml, sweep: {random.seed: [1, 2, 1]}}"),
                "two runs study/seed-1");
}

TEST_F(StudyTest, ARunIsDoneWhenItsCaseIsThePlannedOne) {
    const char* const text = "{case: column.yaml, sweep: {random.seed: [1, 2, 3]}}";
    const auto runs = plan(text);
    const auto leave = [&](const PlannedRun& run, const std::string& hash, const char* status) {
        std::filesystem::create_directories(scratch.path() / run.path());
        std::ofstream(scratch.path() / run.path() / "run.json")
            << nlohmann::json{{"case_hash", hash},
                              {"status", status},
                              {"error", "why"},
                              {"windows", 100},
                              {"windows_done", 100}};
    };
    leave(runs[0], runs[0].hash, "done");
    leave(runs[1], "another case", "done");
    leave(runs[2], runs[2].hash, "physics refused");
    EXPECT_EQ(state_of(runs[0], scratch.path()), RunState::done);
    EXPECT_EQ(state_of(runs[1], scratch.path()), RunState::missing);
    EXPECT_EQ(state_of(runs[2], scratch.path()), RunState::failed);
    Study played = study(text);
    played.command = {"turbidite", "study", "my study.yaml", "--quick"};
    write_study_record(played, runs, scratch.path());
    const auto record = nlohmann::json::parse(std::ifstream(scratch.path() / "study.json"));
    EXPECT_EQ(record["command"], nlohmann::json(played.command));
    EXPECT_EQ(record["runs"][0]["status"], "done");
    EXPECT_EQ(record["runs"][1]["status"], "missing");
    EXPECT_EQ(record["runs"][2]["status"], "physics refused");
    EXPECT_EQ(record["runs"][2]["error"], "why");
    EXPECT_EQ(record["runs"][2]["values"]["random.seed"], "3");
}

// Whoever writes the record next need not know it: another call of the study, one that plays
// others.
TEST_F(StudyTest, KeepsWhyARunCouldNotBePlayedUntilItIs) {
    const std::string text = "{case: column.yaml, sweep: {random.seed: [1, 2]}}";
    const auto runs = plan(text);
    const auto error = [&](std::size_t i) {
        const auto record = nlohmann::json::parse(std::ifstream(scratch.path() / "study.json"));
        return record["runs"][i]["error"].get<std::string>();
    };
    write_study_record(study(text), runs, scratch.path(), {{runs[0].path(), "no room"}});
    EXPECT_EQ(error(0), "no room");
    EXPECT_EQ(error(1), "");
    write_study_record(study(text), runs, scratch.path());
    EXPECT_EQ(error(0), "no room");
    write_study_record(study(text), runs, scratch.path(), {{runs[0].path(), "another"}});
    EXPECT_EQ(error(0), "another");
    std::filesystem::create_directories(scratch.path() / runs[0].path());
    std::ofstream(scratch.path() / runs[0].path() / "run.json")
        << nlohmann::json{{"case_hash", runs[0].hash},
                          {"status", "done"},
                          {"exit_code", 0},
                          {"windows", 100},
                          {"windows_done", 100}};
    write_study_record(study(text), runs, scratch.path());
    EXPECT_EQ(error(0), "");
}

// Killed, stopped on request, refused: only the first two go on, and only from a checkpoint.
TEST_F(StudyTest, ARunThatWasCutOffHasBegun) {
    const auto run = plan("{case: column.yaml, sweep: {random.seed: [1]}}").at(0);
    const std::filesystem::path folder = scratch.path() / run.path();
    const auto state = [&](const nlohmann::json& code) {
        const bool killed = code.is_null();
        std::ofstream(folder / "run.json") << nlohmann::json{
            {"case_hash", run.hash}, {"status", killed ? "prepared" : "x"}, {"exit_code", code}};
        return state_of(run, scratch.path());
    };
    std::filesystem::create_directories(folder);
    EXPECT_EQ(state(nullptr), RunState::missing);
    EXPECT_EQ(state(130), RunState::failed);
    std::filesystem::create_directories(folder / "checkpoints/w00000040");
    for (const nlohmann::json& code :
         {nlohmann::json(nullptr), nlohmann::json(130), nlohmann::json(143)})
        EXPECT_EQ(state(code), RunState::begun) << code;
    EXPECT_EQ(state(6), RunState::failed);
}

TEST_F(StudyTest, DoneMeansThatAllWindowsAreDone) {
    const auto run = plan("{case: column.yaml, sweep: {random.seed: [1]}}").at(0);
    const std::filesystem::path folder = scratch.path() / run.path();
    std::filesystem::create_directories(folder);
    const auto state = [&](const nlohmann::json& windows, const nlohmann::json& done) {
        std::ofstream(folder / "run.json") << nlohmann::json{{"case_hash", run.hash},
                                                             {"status", "done"},
                                                             {"exit_code", 0},
                                                             {"windows", windows},
                                                             {"windows_done", done}};
        return state_of(run, scratch.path());
    };
    EXPECT_EQ(state(100, 100), RunState::done);
    EXPECT_EQ(state(100, 57), RunState::failed);
    EXPECT_EQ(state(100, nullptr), RunState::failed);
    std::filesystem::create_directories(folder / "checkpoints/w00000040");
    EXPECT_EQ(state(100, 57), RunState::begun) << "it goes on";
}

// Out of memory, a node that failed, a file server that was away: the next time may be better.
TEST_F(StudyTest, ARunThatFailedByChanceMayGoOn) {
    const auto run = plan("{case: column.yaml, sweep: {random.seed: [1]}}").at(0);
    const std::filesystem::path folder = scratch.path() / run.path();
    std::filesystem::create_directories(folder / "checkpoints/w00000040");
    for (const int code : {3, 4, 5, 6}) {
        std::ofstream(folder / "run.json")
            << nlohmann::json{{"case_hash", run.hash}, {"status", "failed"}, {"exit_code", code}};
        EXPECT_EQ(state_of(run, scratch.path()), RunState::failed);
        EXPECT_EQ(may_go_on(run, scratch.path()), code == 4 || code == 5) << code;
    }
    std::filesystem::remove_all(folder / "checkpoints");
    EXPECT_FALSE(may_go_on(run, scratch.path()));
}

/// A run that another version of the program has done: the resolved case in its folder is the
/// planned one after these changes.
class OtherVersion : public StudyTest {
 protected:
    PlannedRun run;

    void SetUp() override {
        StudyTest::SetUp();
        run = plan("{case: column.yaml, sweep: {random.seed: [1]}}").at(0);
    }

    void leave(const std::vector<std::pair<std::string, std::string>>& changes,
               const std::string& before_pouring = "", const nlohmann::json& more = {}) {
        std::string text = run.yaml;
        for (const auto& [from, to] : changes) {
            const auto at = text.find(from);
            ASSERT_NE(at, std::string::npos) << from << "\n" << text;
            text.replace(at, from.size(), to);
        }
        scratch.write(run.path() + "/case.yaml", text);
        nlohmann::json record = {{"case_hash", "of that version"},
                                 {"hash_before_pouring", before_pouring},
                                 {"status", "done"},
                                 {"exit_code", 0},
                                 {"windows", 100},
                                 {"windows_done", 100}};
        if (!more.is_null()) record.update(more);
        scratch.write(run.path() + "/run.json", record.dump());
    }

    RunState state() const { return state_of(run, scratch.path()); }
    std::string changes() const {
        std::string text;
        const auto found = other_defaults(run, scratch.path() / run.path());
        for (const std::string& change : found.value_or(std::vector<std::string>{"another case"}))
            text += change + "\n";
        return text;
    }
};

TEST_F(OtherVersion, RunsWithOtherDefaultsAreKept) {
    leave({{"  rolling_friction: 0", "  rolling_friction: 0.125"}});
    EXPECT_EQ(state(), RunState::kept);
    EXPECT_SAYS(changes(), "contact.rolling_friction: 0.125, now 0 by default");
}

// A key that was named when the run was played, and is not any more, is no default.
TEST_F(OtherVersion, RunsWithKeysThatWereNamedAreMissing) {
    const std::vector<std::pair<std::string, std::string>> changed{
        {"  rolling_friction: 0", "  rolling_friction: 0.125"}};
    leave(changed, "", {{"given", {"contact.friction"}}});
    EXPECT_EQ(state(), RunState::kept);
    leave(changed, "", {{"given", {"contact.friction", "contact.rolling_friction"}}});
    EXPECT_EQ(state(), RunState::missing);
    // Where it is not known which ones were: this program has the same defaults.
    const nlohmann::json versions = {{"turbidite", version()}, {"commit", commit()}};
    leave(changed, "", {{"versions", versions}});
    EXPECT_EQ(state(), RunState::missing);
}

// The plan knows the case, not the packing that its pouring leaves.
TEST_F(OtherVersion, PouredRunsAreKnownByTheirPlan) {
    const std::string fingerprint = run.yaml.substr(run.yaml.find("fingerprint"), 28);
    const std::pair<std::string, std::string> poured{fingerprint, "fingerprint 0123456789abcdef"};
    leave({poured}, run.hash);
    EXPECT_EQ(state(), RunState::done);
    leave({poured, {"  rolling_friction: 0", "  rolling_friction: 0.125"}}, "of that version");
    EXPECT_EQ(state(), RunState::kept);
    // Which pouring raises to limits.penetration.
    leave({poured,
           {"  rolling_friction: 0", "  rolling_friction: 0.125"},
           {"  overlap: 0 ", "  overlap: 0.2 "}},
          "of that version");
    EXPECT_EQ(changes(), "contact.rolling_friction: 0.125, now 0 by default\n");
    leave({poured, {"  overlap: 0 ", "  overlap: 0.1 "}}, "of that version");
    EXPECT_SAYS(changes(), "grains.overlap: 0.1, now 0 by default");
    leave({poured, {"  friction: 0.3", "  friction: 0.4"}}, "of that version");
    EXPECT_EQ(state(), RunState::missing);
    leave({poured});
    EXPECT_EQ(state(), RunState::missing);
    const std::string head = "# Resolved case";
    leave({poured, {head, "# Script of the grains, fingerprint 0123456789abcdef\n" + head}},
          "of that version");
    EXPECT_EQ(state(), RunState::missing) << "another script";
    run.yaml.insert(run.yaml.find("grains:\n") + 8, "  extra_file: ball.csv\n");
    leave({poured}, "of that version");
    EXPECT_EQ(state(), RunState::missing) << "what stands in the file of further grains";
}

TEST_F(OtherVersion, RunsWithMoreOrFewerKeysAreKept) {
    leave({{"  rolling_friction: 0", "  an_old_key: 7"}});
    EXPECT_EQ(state(), RunState::kept);
    EXPECT_SAYS(changes(), "contact.an_old_key: 7, now nothing by default");
    EXPECT_SAYS(changes(), "contact.rolling_friction: nothing, now 0 by default");
}

TEST_F(OtherVersion, RunsOfAnotherCaseAreMissing) {
    leave({{"  friction: 0.3", "  friction: 0.4"}});  // which column.yaml gives
    EXPECT_EQ(state(), RunState::missing);
    leave({{"  seed: 1", "  seed: 2"}});  // which the study gives
    EXPECT_EQ(state(), RunState::missing);
    leave({{"fingerprint ", "fingerprint f"}});
    EXPECT_EQ(state(), RunState::missing) << "other grains";
    leave({{"contact:", "contact: ["}});
    EXPECT_EQ(state(), RunState::missing) << "unreadable";
}

TEST_F(StudyTest, IsToldFromACase) {
    scratch.write("study.yaml", "{case: column.yaml}");
    EXPECT_TRUE(is_study(scratch.path() / "study.yaml"));
    EXPECT_FALSE(is_study(scratch.path() / "column.yaml"));
    EXPECT_FALSE(is_study(scratch.path() / "nowhere.yaml"));
}

TEST(Shipped, CasesAndStudiesAreValid) {
    int cases = 0, studies = 0;
    for (const auto& entry : std::filesystem::directory_iterator(TURBIDITE_SOURCE_DIR "/configs")) {
        if (entry.path().extension() != ".yaml" || entry.path().stem() == "expected") continue;
        const bool study = is_study(entry.path());
        EXPECT_NO_THROW(study ? void(plan_study(read_study(entry.path()), {}))
                              : void(load_case(entry.path())))
            << entry.path();
        if (entry.path().filename() == "paper.yaml") {
            EXPECT_NO_THROW(plan_study(read_study(entry.path()), {}, true));
        }
        ++(study ? studies : cases);
    }
    EXPECT_GE(cases, 1);
    EXPECT_GE(studies, 1);
}

}  // namespace
}  // namespace turbidite
