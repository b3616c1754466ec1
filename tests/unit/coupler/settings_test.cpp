// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/protocol/case_hash.hpp"
#include "coupler/protocol/wire.hpp"

namespace turbidite {
namespace {

TEST(Settings, ValuesComeBackWithTheirTypes) {
    Settings settings;
    settings.set("contact.friction", 0.1 + 1e-17);
    settings.set("grains.count", std::int64_t{60});
    settings.set("fluid.enabled", true);
    settings.set("grains.adapter", std::string("yade-nscd"));
    EXPECT_EQ(settings.real("contact.friction"), 0.1 + 1e-17);
    EXPECT_EQ(settings.integer("grains.count"), 60);
    EXPECT_EQ(settings.real("grains.count"), 60.0);
    EXPECT_TRUE(settings.flag("fluid.enabled"));
    EXPECT_EQ(settings.text("grains.adapter"), "yade-nscd");
    EXPECT_EQ(decode<Settings>(encode(settings)).entries(), settings.entries());
}

TEST(Settings, AWrongLookUpNamesTheKey) {
    Settings settings;
    settings.set("time.step", std::string("fast"));
    try {
        settings.real("time.step");
        FAIL();
    } catch (const std::invalid_argument& error) {
        EXPECT_STREQ(error.what(), "time.step = \"fast\" is not a number");
    }
    EXPECT_THROW(settings.text("time.stop"), std::out_of_range);
    EXPECT_THROW(settings.flag("time.step"), std::invalid_argument);
}

// Published FNV-1a test vectors: the empty text gives the offset basis, "a" gives af63dc4c8601ec8c.
TEST(CaseHash, IsFnv1a) {
    EXPECT_EQ(case_hash(""), "cbf29ce484222325");
    EXPECT_EQ(case_hash("a"), "af63dc4c8601ec8c");
}

}  // namespace
}  // namespace turbidite
