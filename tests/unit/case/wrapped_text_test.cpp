// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/keys/wrapped_text.hpp"

#include <gtest/gtest.h>

namespace turbidite {
namespace {

TEST(WrappedText, BreaksLinesBetweenWords) {
    EXPECT_EQ(wrapped("one two three four", 2, 9), "  one two\n  three\n  four\n");
    EXPECT_EQ(wrapped("incompressible", 2, 9), "  incompressible\n");  // a word is never cut
    EXPECT_EQ(wrapped("  ", 2, 9), "");
}

TEST(FittedText, ContinuesALongLineBelowItsBeginning) {
    EXPECT_EQ(fitted("  fluid: many cells\n\nvalid\n", 16), "  fluid: many\n  cells\n\nvalid\n");
}

TEST(FittedText, ContinuesADescriptionInItsColumn) {
    EXPECT_EQ(fitted("  run     validate a case, then start the job\n", 32),
              "  run     validate a case, then\n          start the job\n");
}

TEST(FittedText, OfANarrowTerminalHasOneColumn) {
    EXPECT_EQ(fitted("  a-long-option   what it is for\n", 24),
              "  a-long-option what it\n  is for\n");
}

}  // namespace
}  // namespace turbidite
