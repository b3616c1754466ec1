// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/population.hpp"

#include <gtest/gtest.h>

#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

constexpr PackingBox box{.width = 10.0, .height = 10.0};

std::string texts(const std::vector<CaseProblem>& problems) {
    return problems.empty() ? "" : format_problems(problems);
}

std::string read_errors(const std::string& csv) {
    const ScratchFolder folder;
    return texts(read_population_csv(folder.write("grains.csv", csv)).problems);
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(PopulationFile, ReadsOptionalColumnsInAnyOrder) {
    const ScratchFolder folder;
    const PopulationFile read = read_population_csv(folder.write(
        "grains.csv", "radius, id, x, y, z\r\n0.4, 7, 1.5, 2.5, 0\r\n\n0.5,8,4,4,0\n"));
    ASSERT_EQ(texts(read.problems), "");
    ASSERT_EQ(read.grains.size(), 2u);
    EXPECT_EQ(read.grains[0].id, 7);
    EXPECT_EQ(read.grains[0].radius, 0.4);
    EXPECT_EQ(read.source.lines, (std::vector<int>{2, 4}));
}

TEST(PopulationFile, RadiusIsHalfADiameterUnlessGiven) {
    const ScratchFolder folder;
    EXPECT_EQ(read_population_csv(folder.write("g.csv", "id,x,y\n0,1,1\n")).grains[0].radius, 0.5);
}

TEST(PopulationFile, WritesWhatItReads) {
    const ScratchFolder folder;
    const Packing grains{{.id = 3, .x = 1.0 / 3.0, .y = 2e-7, .radius = 0.1},
                         {.id = 4000000000, .x = 5.0, .y = 9.9, .radius = 0.5}};
    folder.write("g.csv", population_csv(grains));
    const Packing again = read_population_csv(folder.path() / "g.csv").grains;
    ASSERT_EQ(again.size(), 2u);
    EXPECT_EQ(again[0].x, grains[0].x);
    EXPECT_EQ(again[0].y, grains[0].y);
    EXPECT_EQ(again[1].id, 4000000000);
}

TEST(PopulationFile, GrainsFollowMotionsByName) {
    const ScratchFolder folder;
    const auto read = [&](const std::string& rows) {
        return read_population_csv(folder.write("g.csv", "id,x,y,vx,motion\n" + rows),
                                   plain_discs(), {"default"}, {"shake"});
    };
    EXPECT_FALSE(read("1,1,1,0,\n").grains.at(0).prescribed);
    const PopulationFile good = read("1,1,1,0,shake\n2,3,1,0,free\n3,5,1,0,fixed\n");
    ASSERT_EQ(texts(good.problems), "");
    EXPECT_TRUE(good.grains[0].prescribed);
    EXPECT_EQ(good.grains[0].motion, "shake");
    EXPECT_EQ(good.grains[2].motion, "");
    EXPECT_SAYS(population_csv(good.grains), "1,1,1,0.5,shake\n2,3,1,0.5,free\n");
    EXPECT_SAYS(texts(read("1,1,1,0,shale\n").problems), "there are shake");
    EXPECT_SAYS(texts(read("1,1,1,0.5,shake\n").problems), "follows motion shake and has");
}

// As pandas writes what is missing.
TEST(PopulationFile, AnEmptyFieldHasWhatAFileWithoutTheColumnHas) {
    const ScratchFolder folder;
    const PopulationFile read =
        read_population_csv(folder.write("g.csv",
                                         "id,x,y,radius,density,material,shape,motion\n1,1,1,,,,,\n"
                                         "2,3,1,0.4,2,steel,disc,fixed\n"),
                            plain_discs(), {"default", "steel"}, {});
    ASSERT_EQ(texts(read.problems), "");
    EXPECT_EQ(read.grains[0].radius, 0.5);
    EXPECT_FALSE(read.grains[0].density);
    EXPECT_EQ(read.grains[0].material, 0);
    EXPECT_FALSE(read.grains[0].prescribed);
    EXPECT_EQ(read.grains[1].radius, 0.4);
    EXPECT_EQ(read.grains[1].material, 1);
    EXPECT_SAYS(read_errors("id,x,y,spin\n0,1,1,\n"), "line 2: spin = ");
}

// Beside one with a density of its own.
TEST(PopulationFile, GrainsWithoutADensityAreWrittenWithoutOne) {
    PlacedGrain heavy, usual;
    heavy.id = 1, heavy.x = 1.0, heavy.y = 1.0, heavy.density = 6.0;
    usual.id = 2, usual.x = 3.0, usual.y = 1.0;
    const ScratchFolder folder;
    for (const Packing& grains : {Packing{heavy, usual}, Packing{usual, heavy}}) {
        const PopulationFile again =
            read_population_csv(folder.write("g.csv", population_csv(grains)));
        ASSERT_EQ(texts(again.problems), "");
        for (std::size_t k = 0; k < 2; ++k)
            EXPECT_EQ(again.grains[k].density, grains[k].density) << k;
    }
}

TEST(PopulationFile, ErrorsNameTheLine) {
    const std::string twice = read_errors("id,x,y,x\n0,1,1,1\n");
    EXPECT_SAYS(twice, "column \"x\" occurs more than once");
    EXPECT_EQ(twice.find("more than once"), twice.rfind("more than once")) << twice;
    EXPECT_SAYS(read_errors("id,x,y\n0,1,1\n1,2\n"), "grains.csv line 3: 2 values in \"1,2\"");
    EXPECT_SAYS(read_errors("id,x,y\n0,one,1\n"), "grains.csv line 2: x = one");
    EXPECT_SAYS(read_errors("id,x,y\n0,nan,1\n"), "grains.csv line 2: x = nan");
    EXPECT_SAYS(read_errors("id,x,y\n0.5,1,1\n"), "line 2: id = 0.5");
    EXPECT_SAYS(read_errors("id,x,y,z\n0,1,1,1\n"), "In two dimensions z is 0.");
    EXPECT_SAYS(read_errors("id,x\n0,1\n"), "line 1: column \"y\" is missing");
    EXPECT_SAYS(read_errors("id,x,y,mass\n0,1,1,1\n"), "line 1: column \"mass\" is unknown");
    EXPECT_SAYS(read_errors("id,x,y\n"), "contains no grain");
}

TEST(PopulationFile, WhatAFileIsInsteadIsSaid) {
    for (const char* empty : {"", "\n\n", "# id,x,y\n"})
        EXPECT_SAYS(read_errors(empty), "grains.csv: is empty");
    for (const auto& [text, separator] :
         {std::pair("id;x;y\n0;1,5;1\n", "semicolons"), std::pair("id\tx\ty\n0\t1\t1\n", "tabs")}) {
        const std::string said = read_errors(text);
        EXPECT_SAYS(said, std::string("line 1: has ") + separator + " between its columns");
        EXPECT_SAYS(said, "1 error");  // not one for each column that is missing then
    }
    EXPECT_EQ(read_errors("id,\tx,\ty\n0,\t1,\t1\n"), "");
}

// A blank within a number may have been a comma: 1 .5 is not 1.5.
TEST(PopulationFile, BlanksWithinANumberAreFaults) {
    EXPECT_SAYS(read_errors("id,x,y\n0,1 .5,1\n"), "grains.csv line 2: x = 1 .5");
    EXPECT_SAYS(read_errors("id,x,y\n1 2,1,1\n"), "line 2: id = 1 2");
    EXPECT_EQ(read_errors("id , x,y \n 0 ,1.5 , 1\r\n"), "");
}

// As spreadsheets save "CSV UTF-8".
TEST(PopulationFile, AByteOrderMarkIsNoPartOfAName) {
    EXPECT_EQ(read_errors("\xEF\xBB\xBFid,x,y\n0,1,1\n"), "");
}

TEST(Population, RepeatedIdsAndBadRadii) {
    const Packing grains{{.id = 1, .x = 2, .y = 2},
                         {.id = 1, .x = 5, .y = 5},
                         {.id = 2, .x = 8, .y = 8, .radius = 0.0},
                         {.id = 3, .x = 8, .y = 2, .radius = -0.5}};
    const std::string text = texts(check_population(grains, {"g.csv", {2, 3, 4, 5}}, box, {}));
    EXPECT_SAYS(text, "g.csv line 3: grain id 1 is given twice");
    EXPECT_SAYS(text, "g.csv line 4: grain 2: radius = 0");
    EXPECT_SAYS(text, "g.csv line 5: grain 3: radius = -0.5");
    EXPECT_SAYS(text, "3 errors");
}

TEST(Population, GrainsOfAllSizesAreCompared) {
    // 3 - 0.1 - 2.95 = -0.05: the small grain is entirely inside the large one.
    const Packing grains{{.id = 0, .x = 3, .y = 5, .radius = 2.95},
                         {.id = 1, .x = 6, .y = 5, .radius = 0.1}};
    EXPECT_SAYS(texts(check_population(grains, {"g", {}}, box, {})),
                "grains 0 and 1 overlap by 0.05 D");
}

TEST(Population, OneFarAboveTheOthersMeetsThem) {
    // The large one comes in the middle: it meets the row below it, and the last one meets it.
    Packing grains;
    for (int i = 0; i < 9; ++i) grains.push_back({.id = i, .x = 1.0 + i, .y = 0.5});
    grains.push_back({.id = 20, .x = 5, .y = 3.5, .radius = 2.75});
    grains.push_back({.id = 21, .x = 5, .y = 6.5});
    const std::string text = texts(check_population(grains, {"g", {}}, box, {}));
    EXPECT_SAYS(text, "grains 4 and 20 overlap by 0.25 D");
    EXPECT_SAYS(text, "grains 20 and 21 overlap by 0.25 D");
    // Those beside number 4 are at a distance of 3.1623 from it.
    EXPECT_SAYS(text, "grains 3 and 20 overlap by 0.08772 D");
    EXPECT_SAYS(text, "4 errors");
}

TEST(Population, TouchingIsNoOverlap) {
    const Packing grains{{.id = 0, .x = 0.5, .y = 0.5}, {.id = 1, .x = 1.5, .y = 0.5}};
    EXPECT_EQ(texts(check_population(grains, {"g", {}}, box, {})), "");
}

TEST(Population, CyclicSidesAreJoined) {
    // 0.2 and 9.8 are at a distance of 0.4 across the cyclic sides: an overlap of 0.6.
    const Packing grains{{.id = 0, .x = 0.2, .y = 5}, {.id = 1, .x = 9.8, .y = 5}};
    PackingBox joined = box;
    joined.periodic_x = true;
    const SolidSides sides{{false, false, true, true}};
    EXPECT_SAYS(texts(check_population(grains, {"g", {}}, joined, sides)), "overlap by 0.6 D");
    EXPECT_EQ(texts(check_population(grains, {"g", {}}, box, sides)), "");
}

TEST(Population, FreeSidesAskOnlyForTheCentre) {
    const Packing grains{{.id = 0, .x = 9.8, .y = 5}};
    EXPECT_EQ(texts(check_population(grains, {"g", {}}, box, {{true, false, true, true}})), "");
    EXPECT_SAYS(texts(check_population(grains, {"g", {}}, box, {})), "beyond its right side");
}

TEST(Population, LongListsAreCutWithACount) {
    Packing grains;
    for (int i = 0; i < 30; ++i) grains.push_back({.id = i, .x = -5.0 - 2.0 * i, .y = 5.0});
    const auto problems = check_population(grains, {"g", {}}, box, {});
    EXPECT_EQ(problems.size(), 10u);
    EXPECT_SAYS(texts(problems), "(20 more grains outside not shown.)");
}

}  // namespace
}  // namespace turbidite
