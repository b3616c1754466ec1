// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Keys of contact laws: missing or impossible values are refused by name before anything starts.
#include <gtest/gtest.h>

#include "launcher/case/case_file.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class LawKeys : public CaseTest {
 protected:
    LawKeys()
        : CaseTest(
              "domain: {size: [12, 24]}\ngrains: {count: 20}\nfluid: {enabled: false}\n"
              "time: {step: 0.01, end: 1}\n") {}

    ResolvedCase load(const std::vector<std::string>& set) const { return CaseTest::load("", set); }

    std::string refusal(const std::vector<std::string>& set) const {
        return CaseTest::refusal("", set);
    }

    std::string notes(const std::vector<std::string>& set) {
        std::string all;
        for (const std::string& note : load(set).notes) all += note + "\n";
        return all;
    }
};

TEST_F(LawKeys, ALawThatLacksAParameter) {
    EXPECT_SAYS(refusal({"contact.law=static-dynamic"}),
                "contact.static_friction is missing (needed with contact.law: static-dynamic)");
    const std::string wet = refusal({"contact.adhesion=wet"});
    EXPECT_SAYS(wet, "contact.adhesion_force is missing");
    EXPECT_SAYS(wet, "contact.adhesion_range is missing");
    const std::vector<std::string> force = {"contact.adhesion_force=1",
                                            "contact.adhesion_range=0.05"};
    const auto with = [&](const std::string& law) {
        std::vector<std::string> set = force;
        set.push_back("contact.adhesion=" + law);
        return set;
    };
    EXPECT_EQ(refusal(with("wet")), "");
    EXPECT_EQ(refusal(with("wet-irreversible")), "");
    EXPECT_SAYS(refusal(with("capillary")), "contact.adhesion_length is missing");
    EXPECT_SAYS(refusal(with("cohesion")), "contact.adhesion_shear is missing");
}

TEST_F(LawKeys, UnknownLaws) {
    EXPECT_SAYS(refusal({"contact.law=glue"}), "contact.law = glue");
    EXPECT_SAYS(refusal({"contact.adhesion=glue"}), "none, cohesion, wet");
    EXPECT_SAYS(refusal({"contact.impact=poisson"}), "newton, moreau");
}

TEST_F(LawKeys, UnknownSolversAndTheReferenceOfTheTests) {
    const std::string text = refusal({"contact.solver=nlgs-stored"});
    EXPECT_SAYS(text, "contact.solver = nlgs-stored");
    EXPECT_SAYS(text, "nlgs, central-path");
}

TEST_F(LawKeys, ValuesOutOfRange) {
    EXPECT_SAYS(refusal({"contact.restitution=1.1"}), "contact.restitution = 1.1");
    EXPECT_SAYS(refusal({"contact.restitution=-0.1"}), "between 0 (no rebound) and 1 (no loss)");
    EXPECT_SAYS(refusal({"contact.restitution_tangential=2"}),
                "contact.restitution_tangential = 2");
    EXPECT_SAYS(refusal({"contact.rolling_friction=-1"}), "must be zero or positive");
    EXPECT_SAYS(refusal({"contact.adhesion=wet", "contact.adhesion_force=-1",
                         "contact.adhesion_range=0.05"}),
                "contact.adhesion_force = -1");
    EXPECT_SAYS(
        refusal({"contact.adhesion=wet", "contact.adhesion_force=1", "contact.adhesion_range=1.5"}),
        "contact.adhesion_range = 1.5");
    EXPECT_SAYS(refusal({"contact.law=static-dynamic", "contact.static_friction=0.2"}),
                "contact.static_friction = 0.2");
}

// The scheme's theta drops out of the motion of q (theta_scheme.hpp).
TEST_F(LawKeys, AThetaIsToldWhyItWent) {
    const std::string text = refusal({"contact.theta=0.5"});
    EXPECT_SAYS(text, "contact.theta is no longer a key");
    EXPECT_SAYS(text, "It changed nothing");
    EXPECT_EQ(text.find("Did you mean"), std::string::npos) << text;
}

TEST_F(LawKeys, MoreauHasOneRestitution) {
    EXPECT_SAYS(refusal({"contact.impact=moreau", "contact.restitution_tangential=0.1"}),
                "contact.restitution_tangential = 0.1");
    const std::string of_material =
        refusal({"contact.impact=moreau", "contact.materials.steel.restitution_tangential=0.1"});
    EXPECT_SAYS(of_material, "contact.impact = moreau");
    EXPECT_SAYS(of_material, "but contact.materials.steel.restitution_tangential = 0.1");
    EXPECT_SAYS(of_material, "Remove contact.materials.steel.restitution_tangential");
    EXPECT_SAYS(refusal({"contact.impact=moreau",
                         "contact.pairs.default-default.restitution_tangential=0.1"}),
                "but contact.pairs.default-default.restitution_tangential = 0.1");
    EXPECT_EQ(
        refusal({"contact.impact=newton", "contact.materials.steel.restitution_tangential=0.1"}),
        "");
}

TEST_F(LawKeys, RollingResistanceNeedsDiscs) {
    EXPECT_EQ(refusal({"contact.rolling_friction=0.1"}), "");
    EXPECT_SAYS(refusal({"contact.rolling_friction=0.1", "grains.shape=triangle"}),
                "their faces resist rolling");
    EXPECT_SAYS(refusal({"contact.materials.steel.rolling_friction=0.1", "grains.shape=triangle"}),
                "but contact.materials.steel.rolling_friction = 0.1: polygons need none");
    EXPECT_EQ(refusal({"contact.materials.steel.rolling_friction=0.1"}), "");
    folder.write("mixed.csv", "id,x,y,shape\n4,3,3,disc\n7,6,3,triangle\n");
    const std::string mixed =
        refusal({"contact.rolling_friction=0.1", "grains.count=2", "grains.file=mixed.csv"});
    EXPECT_SAYS(mixed, "mixed.csv line 3: grain 7: its shape has corners");
    EXPECT_SAYS(mixed, "but contact.rolling_friction = 0.1");
    EXPECT_EQ(refusal({"grains.count=2", "grains.file=mixed.csv"}), "");
    folder.write("plain.csv", "id,x,y\n4,3,3\n7,6,3\n");
    const std::string once = refusal({"contact.rolling_friction=0.1", "grains.count=2",
                                      "grains.shape=triangle", "grains.file=plain.csv"});
    EXPECT_SAYS(once, "grains.shape = triangle");
    EXPECT_EQ(once.find("its shape has corners"), std::string::npos) << "one fault, told once";
}

TEST_F(LawKeys, WhatHasNoEffectIsNoted) {
    EXPECT_SAYS(notes({"contact.adhesion_force=1"}),
                "contact.adhesion_force has no effect without contact.adhesion");
    EXPECT_SAYS(notes({"contact.static_friction=0.5"}), "without contact.law: static-dynamic");
    EXPECT_EQ(notes({}).find("contact."), std::string::npos);
    EXPECT_SAYS(notes({"contact.restitution=0.5"}), "contact.impact: moreau never does");
    for (const char* of : {"contact.materials.steel.restitution=0.5",
                           "contact.pairs.default-steel.restitution_tangential=0.5"})
        EXPECT_SAYS(notes({"contact.materials.steel.friction=0.3", of}),
                    "contact.impact: moreau never does");
    EXPECT_EQ(notes({"contact.restitution=0.5", "grains.adapter=yade-md"}).find("moreau"),
              std::string::npos);
    EXPECT_SAYS(notes({"contact.solver=central-path"}),
                "contact.iterations = 2000 is used up by the initial sweeps");
    EXPECT_EQ(notes({"contact.solver=central-path", "contact.iterations=20000"}).find("contact."),
              std::string::npos);
    EXPECT_EQ(notes({"contact.restitution=0.5", "contact.impact=moreau"}).find("contact."),
              std::string::npos);
}

// pi/4 rho_s g D^2 with rho_r = 1.5 and D = g = rho_f = 1, dry or wet; sedimentation: g of Eq. 21.
TEST_F(LawKeys, UnitOfForcesIsTheWeightOfAGrainInAir) {
    EXPECT_DOUBLE_EQ(load({}).settings.real("run.grain_weight"), 1.1780972450961724);
    EXPECT_DOUBLE_EQ(
        load({"fluid.enabled=true", "fluid.reynolds=36"}).settings.real("run.grain_weight"),
        1.1780972450961724);
    const Settings slow = load({"scales.kind=sedimentation"}).settings;
    EXPECT_DOUBLE_EQ(slow.real("run.grain_weight"), 1.1780972450961724 * slow.real("run.gravity"));
}

}  // namespace
}  // namespace turbidite
