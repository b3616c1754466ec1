// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/folder/foam_warnings.hpp"

#include <gtest/gtest.h>

#include "tests/unit/case/scratch_folder.hpp"

namespace turbidite {
namespace {

// The texts are those of OpenFOAM 1912.
std::string warning(const std::string& text) {
    return "--> FOAM Warning : \n"
           "    From function virtual void Foam::probes::findElements(const Foam::fvMesh&)\n"
           "    in file probes/probes.C at line 125\n"
           "    " +
           text + "\n";
}

std::string text_of(const std::string& log) {
    const ScratchFolder scratch;
    scratch.write("fluid.log", log);
    return foam_warning_text(foam_warnings(scratch.path() / "fluid.log"), "logs/fluid.log");
}

TEST(FoamWarnings, AreCountedByTheirWords) {
    EXPECT_EQ(text_of("forces drag:\n" + warning("Cannot find any patch matching nothere") +
                      "    rho: rhoInf\n" + warning("yPlus will not be calculated") +
                      "forces drag write:\n" + warning("yPlus will not be calculated")),
              "OpenFOAM warned 3 times in logs/fluid.log: \"Cannot find any patch matching "
              "nothere\", \"yPlus will not be calculated\" (2 times)");
    EXPECT_EQ(text_of(warning("Skipping location.")),
              "OpenFOAM warned once in logs/fluid.log: \"Skipping location.\"");
}

TEST(FoamWarnings, ThatAreManyAreNotAllQuoted) {
    std::string log;
    for (const char* text : {"a", "b", "c", "d", "e"}) log += warning(text);
    EXPECT_EQ(text_of(log),
              "OpenFOAM warned 5 times in logs/fluid.log: \"a\", \"b\", \"c\" and 2 others");
}

// Of the file that a dictionary is read from: another head, and its file on the next line.
TEST(FoamWarnings, OfADictionaryAreFound) {
    EXPECT_EQ(text_of("--> FOAM IOWarning : \n"
                      "    From function void Foam::old()\n"
                      "    in file db/dictionary.C at line 99\n"
                      "    Reading fluid/system/functions.points at line 5.\n"),
              "OpenFOAM warned once in logs/fluid.log: \"Reading "
              "fluid/system/functions.points at line 5.\"");
}

TEST(FoamWarnings, OfALogWithoutAnyOrOfNoneAreNone) {
    EXPECT_EQ(text_of("fluid rank 0: ready\n"), "");
    EXPECT_TRUE(foam_warnings("/nowhere/fluid.log").empty());
    EXPECT_EQ(text_of("--> FOAM Warning : \n"), "") << "a log that ends there";
}

}  // namespace
}  // namespace turbidite
