// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Every kind of mistake in a case has a message with the place, the value and the remedy; a valid
// case resolves to a text that loads to itself.
#include "launcher/case/case_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "coupler/protocol/case_hash.hpp"
#include "launcher/case/files/run_folder.hpp"
#include "launcher/case/grains/population.hpp"
#include "launcher/case/keys/keys.hpp"
#include "tests/unit/case/aliases.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

constexpr auto good_case =
    "domain:\n"           // line 1
    "  size: [12, 24]\n"  // 2
    "grains:\n"           // 3
    "  count: 20\n"       // 4
    "fluid:\n"            // 5
    "  reynolds: 36\n"    // 6
    "time:\n"             // 7
    "  step: 0.01\n"      // 8
    "  end: 1\n";         // 9; further text starts at line 10

class CaseFile : public CaseTest {
 protected:
    CaseFile() : CaseTest(good_case) {}
};
TEST_F(CaseFile, FillsDefaults) {
    const ResolvedCase box = load();
    EXPECT_EQ(box.name, "box");
    EXPECT_EQ(box.settings.text("grains.adapter"), "yade-nscd");
    EXPECT_DOUBLE_EQ(box.settings.real("contact.friction"), 0.3);
    EXPECT_EQ(box.settings.integer("run.windows"), 100);      // 1 / 0.01
    EXPECT_EQ(box.settings.integer("run.output_every"), 50);  // 0.5 / 0.01
    EXPECT_EQ(box.population.size(), 20u);
    ASSERT_EQ(box.shapes.size(), 1u);
    EXPECT_EQ(box.shapes[0].kind, "disc");
}

TEST_F(CaseFile, EveryDefaultIsAllowed) {
    // Fully defaulted keys written out explicitly must pass their own checks.
    std::vector<std::string> set;
    for (const KeySpec& key : key_table())
        if (key.need == Need::fallback) set.push_back(key.name + "=" + key.fallback);
    EXPECT_EQ(load("", set).yaml, load().yaml);
}

TEST_F(CaseFile, ResolvedTextLoadsToItself) {
    const ResolvedCase box = load("scales: {kind: sedimentation}\n");
    const ResolvedCase again = load_case(folder.write("again.yaml", box.yaml));
    EXPECT_EQ(again.yaml, box.yaml);
    EXPECT_EQ(again.settings.text("run.hash"), box.settings.text("run.hash"));
    EXPECT_EQ(box.settings.text("run.hash"), case_hash(box.yaml));
}

TEST_F(CaseFile, ResolvedTextNamesEveryAvailableKeyOrLeavesAReason) {
    const std::string yaml = load().yaml;
    for (const KeySpec& key : key_table())
        if (key.available && key.need != Need::conditional && !has_words(key)) {
            EXPECT_SAYS(yaml, key.name.substr(key.name.find('.') + 1) + ":");
        }
}

TEST_F(CaseFile, HashFollowsEveryChange) {
    const std::string hash = load().settings.text("run.hash");
    EXPECT_NE(load("", {"contact.friction=0.31"}).settings.text("run.hash"), hash);
    EXPECT_NE(load("", {"random.seed=2"}).settings.text("run.hash"), hash);
    EXPECT_EQ(load("", {"contact.friction=0.30"}).settings.text("run.hash"), hash);
}

TEST_F(CaseFile, RunFolderReadsBackTheSameCase) {
    folder.write("grains.csv", "id,x,y,radius\n7,3.1,4.7,0.5\n3,9,20.25,0.4\n");
    const ResolvedCase box = load("", {"grains.file=grains.csv"});
    const RunFolder run{folder.path() / "run"};
    folder.write("run/case.yaml", box.yaml);
    folder.write("run/grains/initial.csv", box.grains_csv);
    const ResolvedCase again = load_run_folder(run.root);
    EXPECT_EQ(again.settings.entries(), box.settings.entries());
    ASSERT_EQ(again.population.size(), 2u);
    EXPECT_EQ(again.population[0].id, 7);
    EXPECT_EQ(again.population[1].position, box.population[1].position);
    EXPECT_EQ(again.population[1].radius, 0.4);
}

TEST_F(CaseFile, RunFolderPrefersItsOwnGrains) {
    const ResolvedCase box = load();
    folder.write("run/case.yaml", box.yaml);
    folder.write("run/grains/initial.csv", "id,x,y\n5,2,2\n");
    EXPECT_EQ(load_run_folder(folder.path() / "run").population.at(0).id, 5);
}

TEST_F(CaseFile, OverridesReplaceValuesOfTheFile) {
    const ResolvedCase box = load("", {"time.step=0.02", "domain.size=[6, 8]", "grains.count=3"});
    EXPECT_EQ(box.settings.integer("run.windows"), 50);
    EXPECT_DOUBLE_EQ(box.settings.real("run.size_x"), 6.0);
    EXPECT_EQ(box.population.size(), 3u);
}

TEST_F(CaseFile, UnknownKeyNamesTheNearest) {
    const std::string text = refusal("contact:\n  fricton: 0.3\n");
    EXPECT_SAYS(text, "box.yaml line 11: contact.fricton is unknown");
    EXPECT_SAYS(text, "Did you mean contact.friction?");
    EXPECT_SAYS(text, "1 error, nothing was started. Exit code 2.");
}

TEST_F(CaseFile, UnknownKeyOnTheCommandLineNamesTheNearest) {
    const std::string text = refusal("", {"contact.fricton=0.3"});
    EXPECT_SAYS(text, "--set: contact.fricton is unknown");
    EXPECT_SAYS(text, "contact.friction");
}

TEST_F(CaseFile, KeyWithoutItsGroupNamesTheKey) {
    EXPECT_SAYS(refusal("friction: 0.3\n"), "Did you mean contact.friction?");
}

TEST_F(CaseFile, MisspeltGroupNamesTheKey) {
    EXPECT_SAYS(refusal("grain: {adapter: yade-nscd}\n"), "Did you mean grains.adapter?");
}

TEST_F(CaseFile, GroupGivenAValue) {
    EXPECT_SAYS(refusal("contact: 0.3\n"), "contact is a group of keys, not a key");
}

TEST_F(CaseFile, AllErrorsAtOnce) {
    const std::string text =
        refusal("contact:\n  friction: -0.3\n  recovery_fraction: 1.2\nlimits: {stall: 3}\n",
                {"time.step=0"});
    EXPECT_SAYS(text,
                "box.yaml line 11: contact.friction = -0.3\n  A friction coefficient must be "
                "zero or positive. Use 0 for smooth grains.");
    EXPECT_SAYS(text, "box.yaml line 12: contact.recovery_fraction = 1.2");
    EXPECT_SAYS(text, "It must be a number from 0 up to 1");
    EXPECT_SAYS(text, "limits.stall is unknown");
    EXPECT_SAYS(text, "--set: time.step = 0");
    EXPECT_SAYS(text, "4 errors, nothing was started. Exit code 2.");
}

TEST_F(CaseFile, ZeroAndNegativeStep) {
    for (const char* step : {"0", "-0.01"}) {
        const std::string text = refusal("", {std::string("time.step=") + step});
        EXPECT_SAYS(text, std::string("time.step = ") + step);
        EXPECT_SAYS(text, "must be above 0");
    }
}

TEST_F(CaseFile, NumbersMustBeFinite) {
    for (const char* value : {".nan", "nan", ".inf", "-inf"}) {
        const std::string text = refusal("", {std::string("contact.friction=") + value});
        EXPECT_SAYS(text, "contact.friction = ");
        EXPECT_SAYS(text, "finite");
    }
}

TEST_F(CaseFile, WrongTypes) {
    EXPECT_SAYS(refusal("", {"contact.friction=rough"}), "\"rough\" is not a number.");
    EXPECT_SAYS(refusal("", {"contact.friction=0.3x"}), "\"0.3x\" is not a number.");
    EXPECT_SAYS(refusal("", {"contact.friction=[0.3, 0.4]"}), "A list is not allowed here.");
    EXPECT_SAYS(refusal("", {"grains.count=2.5"}), "\"2.5\" is not a whole number.");
    EXPECT_SAYS(refusal("", {"fluid.enabled=maybe"}), "Either true or false.");
    EXPECT_SAYS(refusal("", {"domain.size=[12]"}), "Width and height of the box in D");
    EXPECT_SAYS(refusal("", {"domain.size=12"}), "Write for example size: [12, 24].");
    EXPECT_SAYS(refusal("", {"contact.friction="}), "contact.friction has no value");
}

TEST_F(CaseFile, NullTakesAKeyOutOfTheCase) {
    const std::string square = "grains.vertices=[0, 0, 1, 0, 1, 1, 0, 1]";
    EXPECT_FALSE(load("", {square, "grains.vertices=~"}).settings.has("grains.vertices"));
    EXPECT_SAYS(refusal("", {"grains.shape=polygon", "grains.vertices=~"}),
                "grains.vertices is missing");
    EXPECT_SAYS(refusal("", {"domain.size=~"}), "domain.size has no value");
    EXPECT_EQ(refusal("", {"domain.size=~"}).find("missing"), std::string::npos);
}

TEST_F(CaseFile, DuplicateKey) {
    const std::string text = refusal("contact:\n  friction: 0.3\n  friction: 0.4\n");
    EXPECT_SAYS(text, "line 12: contact.friction is given twice");
    EXPECT_SAYS(text, "It is already 0.3 in line 11.");
}

TEST_F(CaseFile, MissingKeys) {
    const auto file = folder.write("empty.yaml", "dimension: 2\n");
    try {
        load_case(file);
        FAIL() << "an empty case was accepted";
    } catch (const CaseRefused& refused) {
        const std::string text = refused.what();
        EXPECT_SAYS(text, "empty.yaml: domain.size is missing");
        EXPECT_SAYS(text, "time.step is missing");
        EXPECT_SAYS(text, "time.end is missing");
        EXPECT_SAYS(text, "grains.count is missing (needed with grains.generator: random");
        EXPECT_SAYS(text, "fluid.reynolds is missing (needed with a fluid");
        EXPECT_SAYS(text, "5 errors");
    }
}

TEST_F(CaseFile, MissingFileAndBadYaml) {
    try {
        load_case(folder.path() / "nowhere.yaml", {"time.end=5"});
        FAIL() << "a missing file was accepted";
    } catch (const CaseRefused& refused) {
        EXPECT_SAYS(std::string(refused.what()), "nowhere.yaml: cannot be read");
        EXPECT_SAYS(std::string(refused.what()), "1 error,") << "not the keys that --set lacks";
    }
    const std::string text = refusal("contact: {friction: 0.3\n");
    EXPECT_SAYS(text, "box.yaml line 1");
    EXPECT_SAYS(text, "is not YAML");
}

// The parser takes it for a key of that name.
TEST_F(CaseFile, AMergeKeyIsCalledAMergeKey) {
    const std::string text = refusal("contact:\n  <<: {friction: 0.3}\n");
    EXPECT_SAYS(text, "has the merge key <<");
    EXPECT_EQ(text.find("Did you mean"), std::string::npos) << text;
}

TEST_F(CaseFile, AKeyIsGivenOnceInAnOverride) {
    EXPECT_SAYS(refusal("", {"contact={friction: 0.5, friction: 0.1}"}), "is given twice");
}

TEST_F(CaseFile, ASecondDocumentIsRefused) {
    EXPECT_SAYS(refusal("---\ncontact: {friction: 0.3}\n"), "begins a second document");
}

// The parser calls a tab an illegal map value, in this or in another line.
TEST_F(CaseFile, ATabIsCalledATab) {
    const std::string text = refusal("contact:\n\tfriction: 0.3\n");
    EXPECT_SAYS(text, "is indented with a tab");
    EXPECT_SAYS(text, "YAML wants spaces");
    EXPECT_EQ(text.find("is not YAML"), std::string::npos) << text;
    // Elsewhere a tab is no fault, and does not hide one.
    EXPECT_EQ(refusal("contact: {friction:\t0.3}\n"), "");
    EXPECT_SAYS(refusal("contact: {friction:\t0.3\n"), "is not YAML");
}

TEST_F(CaseFile, AnEmptyFileIsCalledEmpty) {
    for (const auto& [content, fault] :
         {std::pair("", "empty.yaml: is empty"), std::pair("# none\n", "contains no keys"),
          // Of which the parser makes empty documents without end.
          std::pair(",\ncontact: {friction: 0.3}\n", "begins a second document")}) {
        try {
            load_case(folder.write("empty.yaml", content));
            FAIL() << "an empty file was accepted";
        } catch (const CaseRefused& refused) {
            EXPECT_SAYS(std::string(refused.what()), fault);
        }
    }
}

TEST_F(CaseFile, AliasesOfAliasesAreBounded) {
    const std::string text = powers_of_ten();
    EXPECT_LT(text.size(), 600u);
    EXPECT_SAYS(refusal(text), "stands for more than 20000 values");
    EXPECT_SAYS(refusal(text), "box.yaml line ");
    EXPECT_SAYS(refusal("x: &x {y: *x}\n"), "is nested more than 100 levels deep");
    EXPECT_SAYS(refusal("x: &x [1, *x]\n"), "is nested more than 100 levels deep");
    EXPECT_SAYS(refusal("", {"x=&x [1, *x]"}), "is nested more than 100 levels deep");
}

TEST_F(CaseFile, FewAliasesAreWelcome) {
    const Settings settings =
        load("contact: {friction: &mu 0.25, materials: {steel: {friction: *mu}}}\n").settings;
    EXPECT_EQ(settings.real("contact.materials.steel.friction"), 0.25);
}

TEST_F(CaseFile, ManyKeysAreComparedOnce) {
    std::string text;
    for (int n = 0; n < 9000; ++n) text += "k" + std::to_string(n) + ": 1\n";
    const std::string refused = refusal(text + "k17: 2\n");
    EXPECT_SAYS(refused, "k17 is given twice");
    EXPECT_SAYS(refused, "It is already 1 in line 27.");
}

TEST_F(CaseFile, TextsAreUtf8AndDoNotControlTheTerminal) {
    const std::string text = refusal("contact: {law: \"coul\xf6mb\"}\n");
    EXPECT_SAYS(text, "box.yaml line 10: has the value \"coul\ufffdmb\"");
    EXPECT_SAYS(text, "Save the file as UTF-8");
    EXPECT_SAYS(refusal("contact: {law: \"\\e[31mred\"}\n"), "control characters");
    EXPECT_SAYS(refusal("", {"contact.l\x1b[2J=1"}), "control characters");
    EXPECT_EQ(refusal("# a comment in Latin-1: \xb5\n"), "");
}

TEST_F(CaseFile, ACommandIsOneProgram) {
    const auto refusal_of = [&](const std::string& command) {
        return refusal("", {"grains.adapter=external", "grains.command=\"" + command + "\""});
    };
    EXPECT_SAYS(refusal_of("code : sh -c 'x'"), "takes a word \":\" for the end of the program");
    EXPECT_SAYS(refusal_of("code ':' -n 2 sh"), "Put the command with it into a script.");
    EXPECT_EQ(refusal_of("code a:b 'c : d'"), "");
}

TEST_F(CaseFile, AMisspeltAdapterGetsTheNearest) {
    EXPECT_SAYS(refusal("", {"grains.adapter=yade-nsdc"}), "Use yade-nscd.");
    EXPECT_SAYS(refusal("", {"grains.adapter=lamps-md"}), "Use lammps-md.");
}

// By letters alone `yade` is nearest to yade-md, and density to domain.size.
TEST_F(CaseFile, AWordOfANameFindsAllThatHaveIt) {
    EXPECT_SAYS(refusal("", {"grains.adapter=yade"}), "Use yade-nscd or yade-md.");
    EXPECT_SAYS(refusal("", {"grains.adapter=md"}), "Use yade-md or lammps-md or standalone-md.");
    EXPECT_SAYS(refusal("", {"grains.density=2"}), "Did you mean grains.density_ratio? (");
    EXPECT_SAYS(refusal("", {"density=2"}), "grains.density_ratio");
    EXPECT_SAYS(refusal("", {"frition=2"}), "Did you mean contact.friction? (");  // a typing error
}

TEST_F(CaseFile, AllFaultsOfAGrainsFileAtOnce) {
    const std::string text = refusal_of_grains(
        "id,x,y,radius\n0,1,1,0.5\n1,abc,2,0.5\n2,3\n0,3,3,-1\n5,900,1,0.5\nx,5,5,0.5\n");
    for (const char* fault :
         {"g.csv line 3: x = abc", "g.csv line 4: 2 values in \"2,3\"",
          "g.csv line 5: grain id 0 is given twice", "g.csv line 5: grain 0: radius = -1",
          "g.csv line 6: grain 5 at (900, 1) is outside", "g.csv line 7: id = x", "6 errors"})
        EXPECT_SAYS(text, fault);
    EXPECT_LT(text.find("line 3"), text.find("line 4"));
    // No grain can be read: nothing else is checked.
    EXPECT_SAYS(refusal_of_grains("id,x,y\n0,a,1\n"), "1 error,");
}

TEST_F(CaseFile, SomeAdaptersRunOnSeveralRanks) {
    const std::string text = refusal("", {"grains.ranks=2"});
    EXPECT_SAYS(text, "yade-nscd runs on one rank in this version.");
    EXPECT_SAYS(text, "Use 1, or grains.adapter: standalone-nscd or lammps-md.");
    const Settings settings = load("", {"grains.ranks=2", "grains.adapter=lammps-md"}).settings;
    EXPECT_EQ(settings.integer("grains.ranks"), 2);
    EXPECT_EQ(settings.text("coupling.scheme"), "split");
    EXPECT_SAYS(refusal("", {"grains.adapter=lammps-md", "grains.shape=triangle"}),
                "lammps-md supports discs and, in space, spheres.");
    const std::vector<std::string> soft = {"grains.adapter=standalone-md", "grains.shape=triangle"};
    EXPECT_EQ(load("", soft).shapes[0].kind, "triangle");
    const auto few = load("", {soft[0], soft[1], "contact.md_substeps=12"}).notes;
    EXPECT_EQ(std::count_if(few.begin(), few.end(),
                            [](const std::string& note) {
                                return note.find("contact.md_substeps = 12: polygons") == 0;
                            }),
              1);
}

TEST_F(CaseFile, RanksOfTheContactEngineHaveOneSolverAndNoProblemFiles) {
    std::vector<std::string> engine = {"grains.adapter=standalone-nscd", "grains.ranks=2"};
    EXPECT_EQ(refusal("", engine), "");
    engine.insert(engine.end(), {"contact.solver=central-path", "contact.dump_interval=1"});
    const std::string text = refusal("", engine);
    EXPECT_SAYS(text, "central-path solves contacts on one rank.");
    EXPECT_SAYS(text, "Contact problems shared by several ranks are not written");
    engine[1] = "grains.ranks=1";
    EXPECT_EQ(refusal("", engine), "");
}

TEST_F(CaseFile, VariantsOfLaterVersions) {
    EXPECT_SAYS(refusal("", {"grains.ranks=2"}), "one rank in this version");
}

/// Longer than any file system takes.
TEST_F(CaseFile, AFileWithAnImpossibleNameIsNotThere) {
    const std::string name(5000, 'x');
    for (const std::string key : {"grains.file", "domain.walls_file", "grains.script"})
        EXPECT_SAYS(refusal("", {key + "=" + name + ".py"}), "There is no file");
}

TEST_F(CaseFile, WindowsAreRepeatedByCodesWithSubSteps) {
    const std::string scheme = "coupling.scheme=sub-iterated";
    const ResolvedCase md = load("", {scheme, "grains.adapter=lammps-md"});
    EXPECT_TRUE(md.settings.flag("run.repeats_windows"));
    EXPECT_EQ(md.settings.real("run.slip_tolerance"), 1e-5);
    EXPECT_FALSE(load("").settings.flag("run.repeats_windows"));
    EXPECT_SAYS(refusal("", {scheme}), "takes the fluid's inertia into its contacts");
    EXPECT_SAYS(refusal("", {scheme, "grains.adapter=lammps-md", "grains.ranks=2"}),
                "With several ranks grains cannot repeat a window");
}

TEST_F(CaseFile, JointReportsWhichKeysHaveNoEffect) {
    const ResolvedCase joint = load("coupling: {scheme: joint}\n");
    for (const std::string& note : joint.notes)
        EXPECT_EQ(note.find("has no effect"), std::string::npos) << note;
    EXPECT_EQ(joint.settings.real("coupling.tolerance"), 1e-4);
    EXPECT_EQ(joint.settings.integer("coupling.iterations"), 10);
    const ResolvedCase contact = load("coupling: {scheme: joint, positions: contact}\n");
    ASSERT_FALSE(contact.notes.empty());
    EXPECT_SAYS(contact.notes.back(),
                "coupling.positions has no effect with coupling.scheme: joint");
    const ResolvedCase dry = load("coupling: {scheme: joint}\n", {"fluid.enabled=false"});
    ASSERT_FALSE(dry.notes.empty());
    EXPECT_SAYS(dry.notes.back(), "coupling.scheme have no effect without a fluid");
    EXPECT_SAYS(refusal("", {"coupling.iterations=0"}), "coupling.iterations = 0");
    EXPECT_SAYS(refusal("", {"coupling.tolerance=0"}), "coupling.tolerance = 0");
}

TEST_F(CaseFile, EveryFluidRankHasFourLayersOfCells) {
    for (const char* set : {"fluid.ranks=4096", "fluid.ranks=0"}) {
        const std::string text = refusal("", {set});
        EXPECT_SAYS(text, std::string("fluid.ranks = ") + (set + sizeof "fluid.ranks"));
    }
    EXPECT_SAYS(refusal("", {"fluid.ranks=4096"}), "A rank needs at least 4 rows of cells");
    EXPECT_SAYS(refusal("", {"fluid.ranks=4096", "fluid.decomposition=columns"}), "4 columns");
    EXPECT_EQ(refusal("", {"fluid.ranks=2"}), "");
    EXPECT_EQ(refusal("", {"fluid.ranks=4096", "fluid.enabled=false"}), "");
}

TEST_F(CaseFile, CyclicSidesComeInPairs) {
    const std::string text = refusal("", {"domain.left=cyclic"});
    EXPECT_SAYS(text, "--set: domain.left = cyclic");
    EXPECT_SAYS(text, "domain.right = wall");
    EXPECT_EQ(refusal("", {"domain.left=cyclic", "domain.right=cyclic"}), "");
}

// Two grains of 1 D could touch on both sides of a box that repeats after 1.5 D, or just after 2 D;
// one grain could not, nor could two that are fixed.
TEST_F(CaseFile, GrainsTouchOnOneSideOnly) {
    folder.write("two.csv", "id,x,y\n1,0.75,1\n2,0.75,3\n");
    folder.write("one.csv", "id,x,y\n1,0.75,1\n");
    folder.write("fixed.csv", "id,x,y,motion\n1,0.75,1,fixed\n2,0.75,3,fixed\n");
    const auto with = [&](const char* file, const char* size) {
        return refusal("", {std::string("grains.file=") + file, std::string("domain.size=") + size,
                            "domain.left=cyclic", "domain.right=cyclic"});
    };
    const std::string text = with("two.csv", "[1.5, 8]");
    EXPECT_SAYS(text, "domain.size = [1.5, 8]");
    EXPECT_SAYS(text, "more than the two largest grains apart, 2 D");
    EXPECT_SAYS(with("two.csv", "[2, 8]"), "more than the two largest grains apart, 2 D");
    EXPECT_EQ(with("two.csv", "[2.125, 8]"), "");
    EXPECT_EQ(with("one.csv", "[1.5, 8]"), "");
    EXPECT_EQ(with("fixed.csv", "[2, 8]"), "");
}

// Bridges of up to 0.3 D act on both sides of a box that repeats after up to 2 D + 2 0.3 D.
TEST_F(CaseFile, GrainsAttractOnOneSideOnly) {
    folder.write("two.csv", "id,x,y\n1,0.75,1\n2,0.75,3\n");
    const auto with = [&](const char* size) {
        return refusal(
            "", {"grains.file=two.csv", std::string("domain.size=") + size, "domain.left=cyclic",
                 "domain.right=cyclic", "contact.adhesion=wet", "contact.adhesion_force=1",
                 "contact.adhesion_range=0.3", "fluid.enabled=false"});
    };
    const std::string text = with("[2.2, 8]");
    EXPECT_SAYS(text, "domain.size = [2.2, 8]");
    EXPECT_SAYS(text,
                "more than the two largest grains and twice contact.adhesion_range = 0.3 D apart, "
                "2.6 D");
    EXPECT_SAYS(text, "a smaller contact.adhesion_range");
    EXPECT_SAYS(with("[2.6, 8]"), "2.6 D");
    EXPECT_EQ(with("[2.65, 8]"), "");
}

// The transport of a window is divided into up to 1000 sub-steps of 2/3 of a cell for jets of 8
// u_c: at 16 cells per diameter up to 1000 2/3 / (8 16) = 5.21 t_c.
TEST_F(CaseFile, ExplicitTransportLimitsTheStep) {
    EXPECT_EQ(refusal("", {"time.step=0.07", "time.end=20"}), "");
    EXPECT_EQ(refusal("", {"time.step=5.2", "time.end=20"}), "");
    const std::string text = refusal("", {"time.step=5.3", "time.end=20"});
    EXPECT_SAYS(text, "time.step = 5.3");
    EXPECT_SAYS(text, "at most 5.2 t_c");
    EXPECT_EQ(refusal("", {"time.step=5.3", "time.end=20", "fluid.enabled=false"}), "");
}

TEST_F(CaseFile, MeshNeedsWholeCells) {
    // 12.3 x 16 = 196.8 cells; the nearest whole number is 197 = 12.3125 D.
    EXPECT_SAYS(refusal("", {"domain.size=[12.3, 24]"}), "Use 12.3125 D.");
}

TEST_F(CaseFile, AnUnknownTransportSchemeIsAnsweredWithTheNearest) {
    const std::string set = "fluid.transport_scheme=";
    EXPECT_SAYS(refusal("", {set + "Gauss limitedLinerV 1"}), "Use Gauss limitedLinearV 1.");
    EXPECT_SAYS(refusal("", {set + "Gauss limitedLinear"}), "limitedLinear needs a parameter");
    EXPECT_SAYS(refusal("", {set + "Gauss linearUpwind"}), "Use Gauss linearUpwind grad(U).");
    EXPECT_SAYS(refusal("", {set + "vanLeer"}), "Use Gauss vanLeer.");
    EXPECT_SAYS(refusal("", {set + "Gauss"}), "Use Gauss limitedLinearV 1.");
    EXPECT_EQ(refusal("", {set + "bounded Gauss upwind"}), "");
    const std::string none = refusal("", {set + "Gauss nonsense"});  // CoBlended is as near
    EXPECT_SAYS(none, "has no scheme nonsense. Use Gauss ");
    EXPECT_EQ(none.find("Blended"), std::string::npos) << none;
}

TEST_F(CaseFile, WordsThatATransportSchemeDoesNotReadAreRefused) {
    const std::string set = "fluid.transport_scheme=Gauss ";
    EXPECT_SAYS(refusal("", {set + "LUST grad(p)"}), "of LUST is grad(U), not grad(p). Use");
    EXPECT_SAYS(refusal("", {set + "linear 3"}), "linear takes no parameter, so \"3\" means");
    EXPECT_SAYS(refusal("", {set + "linearUpwind grad(U) bar"}), "takes one parameter, so \"bar\"");
    EXPECT_EQ(refusal("", {set + "LUST grad(U)"}), "");
    EXPECT_SAYS(refusal("", {"fluid.transport_scheme=gauss LUST grad(U)"}),
                "Use Gauss LUST grad(U).");
}

TEST_F(CaseFile, TheParameterOfALimiterIsFrom0To1) {
    const auto said = [this](const std::string& name, const std::string& k) {
        return refusal("", {"fluid.transport_scheme=Gauss " + name + " " + k});
    };
    for (const std::string name : {"limitedLinearV", "limitedLinear", "Gamma", "limitedCubicV"}) {
        for (const char* k : {"0", "0.5", "1"}) EXPECT_EQ(said(name, k), "") << name << " " << k;
        for (const std::string k : {"-1", "2", "x", "nan"})
            EXPECT_SAYS(said(name, k),
                        "a number from 0 to 1, not " + k + ". Use Gauss " + name + " 1.");
    }
}

/// 2 nu/u^2 at u = 6 u_c, where jets of settling clouds begin: 2/(36 Re) = 0.00154 t_c at Re = 36.
TEST_F(CaseFile, CentralTransportInFirstOrderIsRefusedBeyondItsStep) {
    const std::string scheme = "fluid.transport_scheme=Gauss linear";
    const std::string first_order = "fluid.time_scheme=first-order";
    EXPECT_EQ(refusal("", {scheme, first_order, "time.step=0.0015"}), "");
    const std::string text = refusal("", {scheme, first_order, "time.step=0.0016"});
    EXPECT_SAYS(text, "fluid.transport_scheme = Gauss linear");
    EXPECT_SAYS(text, "2/(36 Re) = 0.00154 t_c");
    EXPECT_SAYS(text, "time.step = 0.0016");
    EXPECT_SAYS(text, "Use fluid.time_scheme: second-order, Gauss limitedLinearV 1");
    EXPECT_EQ(refusal("", {first_order, "time.step=0.0016",
                           "fluid.transport_scheme=Gauss limitedLinearV 1"}),
              "");
    EXPECT_EQ(refusal("", {scheme, first_order, "time.step=0.0016", "fluid.enabled=false"}), "");
    EXPECT_EQ(refusal("", {scheme, "time.step=0.0016"}), "");
}

// Sub-steps of 2/3 of a cell at 6 u_c: 0.00154 t_c with 72 cells per diameter, whatever the window.
TEST_F(CaseFile, CentralTransportInFirstOrderMayTakeAnyStepWhereItIsCutFinely) {
    const std::string scheme = "fluid.transport_scheme=Gauss linear";
    const std::string first_order = "fluid.time_scheme=first-order";
    EXPECT_EQ(refusal("", {scheme, first_order, "time.step=0.05", "fluid.cells_per_diameter=75"}),
              "");
    EXPECT_SAYS(refusal("", {scheme, first_order, "time.step=0.05", "fluid.cells_per_diameter=70"}),
                "unstable for steps above");
}

TEST_F(CaseFile, TransportInFirstOrderIsNotedBeyondTheStepOfFasterJets) {
    const auto notes = [&](const std::string& scheme, const std::string& step,
                           const std::string& order = "first-order") {
        std::string all;
        for (const std::string& note : load("", {"fluid.transport_scheme=Gauss " + scheme,
                                                 "time.step=" + step, "fluid.time_scheme=" + order})
                                           .notes)
            all += note + "\n";
        return all;
    };
    EXPECT_SAYS(notes("QUICK", "0.0016"), "fluid.transport_scheme = Gauss QUICK");
    EXPECT_EQ(notes("QUICK", "0.0015").find("fluid.transport_scheme"), std::string::npos);
    EXPECT_EQ(notes("QUICK", "0.0016", "second-order").find("fluid.transport_scheme"),
              std::string::npos);
    EXPECT_SAYS(notes("linear", "0.0015"), "2/(64 Re) = 0.000868 t_c");
    EXPECT_EQ(notes("linear", "0.0008").find("fluid.transport_scheme"), std::string::npos);
}

// The fallback of the scheme is not one for first order: who names only the order is told.
TEST_F(CaseFile, FirstOrderAloneIsTold) {
    std::string notes;
    for (const std::string& note : load("", {"fluid.time_scheme=first-order"}).notes)
        notes += note + "\n";
    EXPECT_SAYS(notes, "Gauss limitedLinearV 1 stays bounded");
    EXPECT_EQ(load("").settings.text("fluid.time_scheme"), "second-order");
}

TEST_F(CaseFile, EndAndStep) {
    EXPECT_SAYS(refusal("", {"time.end=0.001"}), "time.end = 0.001");
    const ResolvedCase odd = load("", {"time.step=0.03", "output.interval=0.3"});
    EXPECT_EQ(odd.settings.integer("run.windows"), 33);  // 1 / 0.03 = 33.3
    ASSERT_FALSE(odd.notes.empty());
    EXPECT_SAYS(odd.notes.back(), "33 windows at 0.99 t_c");
}

TEST_F(CaseFile, ReynoldsIsDerivedFromPhysicalValues) {
    EXPECT_SAYS(refusal("scales: {kind: physical, diameter: 0.001, gravity: 9.81, fluid_density: "
                        "1000, viscosity: 1e-6}\n"),
                "follows from scales.viscosity");
    EXPECT_SAYS(refusal("scales: {kind: physical}\n"), "scales.viscosity is missing");
}

TEST_F(CaseFile, GrainsFileIsLookedUpBesideTheCase) {
    const std::string text = refusal("", {"grains.file=missing.csv"});
    EXPECT_SAYS(text, "--set: grains.file = missing.csv");
    EXPECT_SAYS(text, (folder.path() / "missing.csv").string());
    folder.write("one.csv", "id,x,y\n0,6,6\n");
    EXPECT_EQ(load("", {"grains.file=one.csv"}).population.size(), 1u);
}

TEST_F(CaseFile, OverlapInAGrainsFile) {
    const std::string text = refusal_of_grains("id,x,y\n4,6,6\n9,6.75,6\n");  // 0.75 D apart
    EXPECT_SAYS(text, "g.csv line 3: grains 4 and 9 overlap by 0.25 D");
}

TEST_F(CaseFile, GrainOutsideTheBox) {
    // Its upper end is at 12.25, the box ends at 12.
    EXPECT_SAYS(refusal_of_grains("id,x,y\n4,6,6\n5,11.75,6\n"),
                "g.csv line 3: grain 5 at (11.75, 6) is outside the box: 0.25 D beyond its right");
}

TEST_F(CaseFile, MoreGrainsThanTheBoxHolds) {
    const std::string text = refusal("", {"grains.count=1000"});
    EXPECT_SAYS(text, "grains.count = 1000");
    EXPECT_SAYS(text, "holds at most");
}

TEST_F(CaseFile, CompacityOutsideTheLattice) {
    const std::string text = refusal("", {"grains.generator=lattice", "grains.compacity=0.5"});
    EXPECT_SAYS(text, "grains.compacity = 0.5");
    EXPECT_SAYS(text, "0.7854");
}

TEST_F(CaseFile, RegionOfTheGenerator) {
    const std::vector<std::string> column = {"grains.generator=lattice", "domain.size=[60, 60]",
                                             "fluid.enabled=false", "grains.region=[25, 50]"};
    EXPECT_EQ(load("", column).population.size(), 1397u);
    const auto with = [&](const std::string& region) {
        std::vector<std::string> overrides = column;
        overrides.back() = "grains.region=" + region;
        return refusal("", overrides);
    };
    const std::string larger = with("[25, 61]");
    EXPECT_SAYS(larger, "grains.region = [25, 61]");
    EXPECT_SAYS(larger, "domain.size = [60, 60]");
    EXPECT_EQ(larger.find("outside the box"), std::string::npos);  // reported once
    EXPECT_SAYS(with("[0.5, 50]"), "each at least one grain");
    EXPECT_SAYS(with("25"), "Write for example region: [25, 50]");
}

TEST_F(CaseFile, DensityOfDryGrainsKeepsItsUnit) {
    const ResolvedCase dry = load("", {"fluid.enabled=false"});
    EXPECT_EQ(dry.settings.real("run.fluid_density"), 0.0);
    EXPECT_EQ(dry.population.at(0).density, 1.5);
}

/// coupling.scheme: auto is what the adapter can do best; what is named is taken as it is.
TEST_F(CaseFile, TheSchemeFollowsTheAdapter) {
    const std::string quickstart = TURBIDITE_SOURCE_DIR "/configs/quickstart.yaml";
    const auto scheme = [&](const std::vector<std::string>& set) {
        return load_case(quickstart, set).settings.text("coupling.scheme");
    };
    EXPECT_EQ(scheme({}), "joint");
    EXPECT_EQ(scheme({"grains.adapter=standalone-nscd"}), "joint");
    EXPECT_EQ(scheme({"grains.adapter=yade-md"}), "split");
    EXPECT_EQ(scheme({"grains.adapter=external", "grains.command=my-grains"}), "split");
    EXPECT_EQ(scheme({"coupling.scheme=split"}), "split");
    EXPECT_EQ(load_case(quickstart, {}).settings.text("run.scheme"), "joint");
    EXPECT_EQ(load_case(quickstart, {"fluid.enabled=false"}).settings.text("run.scheme"), "dry");
}

/// They reproduce the paper's fluid, whatever the default is.
TEST_F(CaseFile, ThePapersCasesNameItsTransport) {
    for (const char* name :
         {"sedimentation-discs", "sedimentation-triangles", "avalanche", "avalanche-closed"}) {
        const Settings settings =
            load_case(std::string(TURBIDITE_SOURCE_DIR "/configs/") + name + ".yaml", {}).settings;
        EXPECT_EQ(settings.text("fluid.time_scheme"), "first-order") << name;
        EXPECT_EQ(settings.text("fluid.transport_scheme"), "Gauss limitedLinearV 1") << name;
    }
}

}  // namespace
}  // namespace turbidite
