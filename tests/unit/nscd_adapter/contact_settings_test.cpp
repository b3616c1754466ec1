// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/contact_settings.hpp"

#include <gtest/gtest.h>

#include "granular_adapter/nscd/laws/law_list.hpp"
#include "launcher/case/keys/keys.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

/// D = 2, u_c = 3, m g = 5.
Settings dry() {
    Settings s;
    set_contact_keys(s);
    s.set("run.diameter", 2.0);
    s.set("run.velocity_scale", 3.0);
    s.set("run.grain_weight", 5.0);
    return s;
}

TEST(ContactSettings, SpeedsAreInTheVelocityScale) {
    Settings s = dry();
    s.set("contact.restitution_speed", 0.01);
    const nscd::EngineSettings engine = contact_settings(s);
    EXPECT_DOUBLE_EQ(engine.law_settings.recovery_speed, 1.5);
    EXPECT_DOUBLE_EQ(engine.law_settings.restitution_speed, 0.03);
    EXPECT_EQ(engine.surfaces.at(0).friction, 0.3);
}

// 0.4 m g = 2 N between two discs of diameter 2, range 0.1 D = 0.2.
TEST(ContactSettings, ForcesAreInWeightsAndLengthsInDiameters) {
    Settings s = dry();
    s.set("contact.adhesion", std::string("capillary"));
    s.set("contact.adhesion_force", 0.4);
    s.set("contact.adhesion_range", 0.1);
    s.set("contact.adhesion_length", 0.02);
    const nscd::EngineSettings engine = contact_settings(s);
    EXPECT_EQ(engine.law.adhesion, "capillary");
    EXPECT_DOUBLE_EQ(engine.surfaces.at(0).adhesion, 2.0);
    EXPECT_DOUBLE_EQ(engine.law_settings.adhesion_range, 0.2);
    EXPECT_DOUBLE_EQ(engine.law_settings.adhesion_length, 0.04);
    EXPECT_DOUBLE_EQ(engine.law_settings.reference_diameter, 2.0);
    EXPECT_NO_THROW(nscd::Engine(engine, {{"disc", {}}}, {}));
}

TEST(ContactSettings, ReadsEveryLaw) {
    Settings s = dry();
    s.set("contact.law", std::string("static-dynamic"));
    s.set("contact.impact", std::string("moreau"));
    s.set("contact.adhesion", std::string("cohesion"));
    s.set("contact.adhesion_force", 1.0);
    s.set("contact.adhesion_range", 0.001);
    s.set("contact.adhesion_shear", 0.7);
    s.set("contact.static_friction", 0.6);
    s.set("contact.restitution", 0.5);
    s.set("contact.restitution_tangential", 0.0);
    s.set("contact.rolling_friction", 0.05);
    const nscd::EngineSettings engine = contact_settings(s);
    EXPECT_EQ(engine.law.friction, "static-dynamic");
    EXPECT_EQ(engine.law.impact, "moreau");
    EXPECT_EQ(engine.law_settings.adhesion_shear, 0.7);
    EXPECT_EQ(engine.surfaces.at(0).static_friction, 0.6);
    EXPECT_EQ(engine.surfaces.at(0).restitution, 0.5);
    EXPECT_EQ(engine.surfaces.at(0).rolling_friction, 0.05);
    EXPECT_NO_THROW(nscd::Engine(engine, {{"disc", {}}}, {}));
}

std::vector<std::string> choices(const char* key) {
    std::vector<std::string> names;
    for (const Choice& choice : find_key(key)->choices) names.push_back(choice.name);
    return names;
}

std::vector<std::string> laws(nscd::LawSlot slot) {
    std::vector<std::string> names;
    for (const nscd::LawEntry& entry : nscd::law_list())
        if (entry.slot == slot) names.push_back(entry.name);
    return names;
}

// A law added to the list must be among the choices of its key, and conversely.
TEST(ContactSettings, KeysOfferTheLawsThatThereAre) {
    EXPECT_EQ(choices("contact.law"), laws(nscd::LawSlot::friction));
    EXPECT_EQ(choices("contact.adhesion"), laws(nscd::LawSlot::adhesion));
    EXPECT_EQ(choices("contact.impact"), laws(nscd::LawSlot::impact));
}

}  // namespace
}  // namespace turbidite
