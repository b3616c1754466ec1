// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include "coupler/protocol/hello.hpp"

namespace turbidite {
namespace {

Hello fitting() {
    Hello hello;
    hello.role = Role::grains;
    hello.adapter = "yade-nscd";
    hello.case_hash = "abc";
    hello.capabilities.shapes = {"disc"};
    return hello;
}

Expectation expected() {
    Expectation e;
    e.role = Role::grains;
    e.adapter = "yade-nscd";
    e.case_hash = "abc";
    e.scheme = "split";
    e.shapes = {"disc"};
    return e;
}

TEST(Handshake, AFittingParticipantHasNoMismatch) {
    EXPECT_TRUE(mismatches(fitting(), expected()).empty());
}

TEST(Handshake, AnotherMinorVersionIsAccepted) {
    Hello hello = fitting();
    hello.protocol_minor += 3;
    EXPECT_TRUE(mismatches(hello, expected()).empty());
}

TEST(Handshake, EveryMismatchGetsItsSentence) {
    Hello hello = fitting();
    hello.protocol_major = 2;
    hello.adapter = "lammps-md";
    hello.dimension = 3;
    hello.ranks = 4;
    hello.case_hash = "xyz";
    hello.capabilities.shapes = {"sphere"};
    Expectation joint = expected();
    joint.scheme = "joint";
    joint.effective_inertia = true;
    const auto sentences = mismatches(hello, joint);
    ASSERT_EQ(sentences.size(), 7u);
    EXPECT_EQ(sentences[0], "grains rank 0: protocol version is 2.10, the case needs 1.x");
    EXPECT_EQ(sentences[1], "grains rank 0: adapter is lammps-md, the case needs yade-nscd");
    EXPECT_EQ(sentences[6], "grains rank 0: list of shapes is sphere, the case needs disc");
}

TEST(Handshake, JointNeedsAnAdapterThatKnowsEffectiveInertia) {
    Expectation joint = expected();
    joint.scheme = "joint";
    joint.effective_inertia = true;
    const auto sentences = mismatches(fitting(), joint);
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_EQ(sentences[0],
              "grains rank 0: support for effective inertia is absent, the case needs it for "
              "coupling.scheme: joint (or use split)");
    Hello knowing = fitting();
    knowing.capabilities.effective_inertia = true;
    EXPECT_TRUE(mismatches(knowing, joint).empty());
}

TEST(Handshake, AProgramOfBothDimensionsPlaysInEither) {
    Hello hello = fitting();
    hello.dimension = both_dimensions;
    Expectation space = expected();
    space.dimension = 3;
    EXPECT_TRUE(mismatches(hello, expected()).empty());
    EXPECT_TRUE(mismatches(hello, space).empty());
    hello.dimension = 2;
    const auto sentences = mismatches(hello, space);
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_EQ(sentences[0], "grains rank 0: dimension is 2, the case needs 3");
}

// A report of the fluid without its mean velocity would be malformed.
TEST(Handshake, AVersionWithAnotherReportIsRefused) {
    Hello old = fitting();
    old.protocol_minor = 7;
    const auto sentences = mismatches(old, expected());
    ASSERT_EQ(sentences.size(), 1u);
    EXPECT_EQ(sentences[0],
              "grains rank 0: protocol version is 1.7, the case needs 1.8 or later (rebuild the "
              "adapter)");
}

TEST(Handshake, AnAdapterStartedByHandMayTakeAnyCase) {
    Hello hello = fitting();
    hello.case_hash.clear();
    EXPECT_TRUE(mismatches(hello, expected()).empty());
}

}  // namespace
}  // namespace turbidite
