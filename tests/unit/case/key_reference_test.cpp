// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/key_reference.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <sstream>

#include "coupler/keys/nearest_name.hpp"
#include "coupler/protocol/failure.hpp"
#include "launcher/case/keys/keys.hpp"

namespace turbidite {
namespace {

TEST(KeyReference, IsWhatTheDocumentHolds) {
    std::ifstream file(TURBIDITE_SOURCE_DIR "/docs/case-reference.md");
    const std::string document{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(document, key_reference()) << "run `turbidite keys > docs/case-reference.md`";
}

TEST(KeyReference, FitsATerminal) {
    for (const int width : {60, 120}) {
        std::istringstream help(key_help({"contact", "fluid.splitting"}, width));
        std::string line;
        int lines = 0, friction = 0, others = 0;
        while (std::getline(help, line)) {
            ++lines;
            EXPECT_LE(static_cast<int>(line.size()), width) << line;
            friction += line.rfind("contact.friction", 0) == 0;
            others += line.rfind("fluid.splitting_tolerance", 0) == 0;
        }
        EXPECT_GT(lines, 50);
        EXPECT_EQ(friction, 1);
        EXPECT_EQ(others, 0);  // fluid.splitting is a key, not a group
    }
    EXPECT_THROW(key_help({"fluid.spliting"}, 80), Failure);
}

TEST(KeyTable, IsComplete) {
    std::set<std::string> names;
    for (const KeySpec& key : key_table()) {
        EXPECT_TRUE(names.insert(key.name).second) << key.name << " is registered twice";
        EXPECT_FALSE(key.help.empty()) << key.name;
        EXPECT_EQ(key.type == KeyType::choice, !key.choices.empty()) << key.name;
        EXPECT_EQ(key.need == Need::fallback, !key.fallback.empty()) << key.name;
        EXPECT_EQ(key.need == Need::conditional, key.required != nullptr) << key.name;
    }
}

TEST(NearestName, CountsEdits) {
    EXPECT_EQ(edit_distance("fricton", "friction"), 1u);     // one letter missing
    EXPECT_EQ(edit_distance("yade-nsdc", "yade-nscd"), 1u);  // neighbours swapped
    EXPECT_EQ(edit_distance("", "abc"), 3u);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // the textbook example
}

TEST(NearestName, IsToldWhereOneIsAlike) {
    const std::vector<std::string> options = {"--set", "--out", "--force"};
    EXPECT_EQ(did_you_mean("--forse", options, "All."), "Did you mean --force? All.");
    EXPECT_EQ(did_you_mean("--no-report", options, "All."), "All.");
    EXPECT_EQ(did_you_mean("yade", {"yade-md", "yade-nscd", "lammps-md"}, ""),
              "Did you mean yade-md or yade-nscd?");
}

}  // namespace
}  // namespace turbidite
