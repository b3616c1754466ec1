// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/key_reference.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "coupler/keys/nearest_name.hpp"
#include "launcher/case/keys.hpp"

namespace turbidite {
namespace {

TEST(KeyReference, IsWhatTheDocumentHolds) {
    std::ifstream file(TURBIDITE_SOURCE_DIR "/docs/case-reference.md");
    const std::string document{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(document, key_reference()) << "run `turbidite keys > docs/case-reference.md`";
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

}  // namespace
}  // namespace turbidite
