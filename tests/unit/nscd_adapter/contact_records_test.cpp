// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd_adapter/contact_records.hpp"

#include <gtest/gtest.h>

#include "tests/unit/nscd/scenes.hpp"

namespace turbidite {
namespace {

using namespace nscd::scenes;
using nscd::Engine;

constexpr double dt = 0.01;

/// A tower of two discs, the upper one shifted by 0.1 radii, on a floor with key 1.
Engine tower(double friction) {
    Engine engine(exact(friction), discs, {floor(friction)});
    engine.bodies().add(disc(9, 0.05, 1.49));
    engine.bodies().add(disc(4, 0.0, 0.5));
    engine.step(dt);
    return engine;
}

// Two discs of weight pi/4 each: the floor carries both.
TEST(ContactRecords, IdentifyBodiesAndForce) {
    const Engine engine = tower(2.0);
    const auto contacts = contact_records(engine);
    ASSERT_EQ(contacts.size(), 2u);
    const ContactRecord& pair = contacts[0];
    EXPECT_EQ(pair.a, 4);
    EXPECT_EQ(pair.b, 9);
    EXPECT_EQ(pair.wall, -1);
    EXPECT_NEAR(pair.branch[0], 0.05, 1e-15);
    EXPECT_NEAR(pair.branch[1], 0.99, 1e-15);
    EXPECT_NEAR(pair.normal[0], 0.05 / std::hypot(0.05, 0.99), 1e-15);
    EXPECT_NEAR(pair.gap, std::hypot(0.05, 0.99) - 1.0, 1e-15);
    EXPECT_NEAR(pair.point[0], 0.025, 1e-15);
    EXPECT_NEAR(pair.point[1], 0.995, 1e-15);
    EXPECT_GT(pair.impulse[1], 0.0) << "on b, the upper one";
    const ContactRecord& base = contacts[1];
    EXPECT_EQ(base.wall, 1);
    EXPECT_EQ(base.b, 4);
    EXPECT_EQ(base.normal, (Vec3{0, 1, 0}));
    EXPECT_EQ(base.branch, (Vec3{0, 0.5, 0}));
    EXPECT_EQ(base.point, (Vec3{0, 0, 0}));
}

// Of a film, whose grain is a gap away from the wall.
TEST(ContactRecords, BeginAtTheWall) {
    nscd::EngineSettings settings = exact(0.0);
    settings.law.film = "lubrication";
    settings.law_settings.viscosity = 0.003;
    settings.law_settings.film_cutoff = 0.3;
    settings.law_settings.film_roughness = 0.001;
    Engine engine(settings, discs, {floor(0.0)});
    engine.bodies().add(disc(4, 2.0, 0.62));
    engine.step(dt);
    const auto contacts = contact_records(engine);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NE(contacts[0].impulse[1], 0.0);
    EXPECT_NEAR(contacts[0].gap, 0.12, 1e-12);
    EXPECT_NEAR(contacts[0].branch[1], 0.62, 1e-12);
}

// The sum over a body's contacts is the impulse that the engine reports for it.
TEST(ContactRecords, AddUpToTheBodysImpulse) {
    const Engine engine = tower(0.3);
    Vec3 upper{}, lower{};
    for (const ContactRecord& c : contact_records(engine))
        for (int axis = 0; axis < 2; ++axis) {
            (c.b == 9 ? upper : lower)[axis] += c.impulse[axis];
            if (c.wall < 0) (c.a == 9 ? upper : lower)[axis] -= c.impulse[axis];
        }
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(upper[axis], engine.bodies().contact_impulse[0][axis], 1e-16);
        EXPECT_NEAR(lower[axis], engine.bodies().contact_impulse[1][axis], 1e-16);
    }
}

// A disc that slides at speed 1 over the floor, and one at rest.
TEST(ContactRecords, DistinguishSlidingFromSticking) {
    Engine engine(exact(0.3), discs, {floor(0.3)});
    nscd::Body moving = disc(1, 0.0, 0.5);
    moving.twist.velocity = {1.0, 0.0, 0.0};
    engine.bodies().add(moving);
    engine.bodies().add(disc(2, 3.0, 0.5));
    engine.step(dt);
    const auto contacts = contact_records(engine);
    ASSERT_EQ(contacts.size(), 2u);
    EXPECT_EQ(contacts[0].status, ContactStatus::sliding);
    EXPECT_NEAR(contacts[0].impulse[0], -0.3 * contacts[0].impulse[1], 1e-12);
    EXPECT_EQ(contacts[1].status, 0);
}

// An attraction of one weight w presses a block of weight w with 2 w: a force of 0.4 w does not
// make it slide at mu = 0.3. Pulled upwards with 2.5 w, the contact is under traction and does not
// slide either.
TEST(ContactRecords, StatusAccountsForAttraction) {
    nscd::EngineSettings settings = exact(0.3);
    const double weight = disc(1, 0.0, 0.5).mass;
    settings.law.adhesion = "wet";
    settings.law_settings.adhesion_range = 0.01;
    settings.surfaces.resize(1);
    settings.surfaces[0].adhesion = weight;
    for (const Vec3& push : {Vec3{0.4 * weight, 0.0, 0.0}, Vec3{0.0, 2.5 * weight, 0.0}}) {
        Engine engine(settings, discs, {floor(0.3)});
        engine.bodies().add(disc(1, 0.0, 0.5));
        engine.bodies().rotation_blocked[0] = 1;
        engine.bodies().force[0] = push;
        engine.step(dt);
        const auto contacts = contact_records(engine);
        ASSERT_EQ(contacts.size(), 1u);
        EXPECT_EQ(contacts[0].status, 0);
        EXPECT_NEAR(contacts[0].impulse[1], push[1] > 0.0 ? -weight * dt : weight * dt, 1e-14);
    }
}

// A slope of 0.2: the disc does not slide (mu = 0.5), and rolls against a resistance of 0.1.
TEST(ContactRecords, ReportRolling) {
    nscd::EngineSettings settings = exact(0.5);
    settings.surfaces = {nscd::Surface{}};
    settings.surfaces[0].friction = 0.5;
    settings.surfaces[0].rolling_friction = 0.1;
    settings.gravity = tilted(std::atan(0.2));
    Engine engine(settings, discs, {floor(0.5)});
    engine.bodies().add(disc(1, 0.0, 0.5));
    engine.step(dt);
    const auto contacts = contact_records(engine);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].status, ContactStatus::rolling);
    EXPECT_NEAR(contacts[0].rolling_impulse[2], 0.1 * 0.5 * contacts[0].impulse[1], 1e-12)
        << "against the spin, which is negative downhill to the right";
}

// Two discs at a small gap, held together by a liquid with an attraction of 2.
TEST(ContactRecords, APullHasANegativeNormalForce) {
    nscd::EngineSettings settings = exact(0.0);
    settings.gravity = {};
    settings.surfaces = {nscd::Surface{}};
    settings.surfaces[0].adhesion = 2.0;
    settings.law.adhesion = "wet";
    settings.law_settings.adhesion_range = 0.05;
    Engine engine(settings, discs, {});
    engine.bodies().add(disc(1, 0.0, 0.0));
    engine.bodies().add(disc(2, 1.02, 0.0));
    engine.step(dt);
    const auto contacts = contact_records(engine);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].impulse[0], -2.0 * dt, 1e-15);
    EXPECT_NEAR(contacts[0].gap, 0.02, 1e-15);
    EXPECT_EQ(contacts[0].status, 0);
}

// Free fall within the alert distance: detected, but no contact.
TEST(ContactRecords, OmitContactsWithoutImpulse) {
    Engine engine(exact(0.3), discs, {floor(0.3)});
    engine.bodies().add(disc(1, 0.0, 0.505));
    engine.step(dt);
    EXPECT_EQ(engine.points().size(), 1u);
    EXPECT_TRUE(contact_records(engine).empty());
}

// Period 4: the discs at 0.4 and 3.5 press each other across the border, at a distance of 0.9.
TEST(ContactRecords, BranchesAreNearestImages) {
    nscd::EngineSettings settings = exact(0.3);
    settings.box.length = {4.0, 0.0, 0.0};
    Engine engine(settings, discs, {});
    engine.bodies().add(disc(1, 0.4, 5.0));
    engine.bodies().add(disc(2, 3.5, 5.0));
    engine.step(dt);
    const auto contacts = contact_records(engine);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_NEAR(contacts[0].branch[0], -0.9, 1e-15);
    EXPECT_NEAR(contacts[0].gap, -0.1, 1e-15);
}

TEST(ContactRecords, OfGrainsThatLeftAreDropped) {
    auto contacts = contact_records(tower(0.3));
    drop_contacts_of({}, contacts);
    EXPECT_EQ(contacts.size(), 2u);
    drop_contacts_of({0, 9}, contacts);  // 0 is the `a` of contacts with a wall
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].wall, 1);
}

}  // namespace
}  // namespace turbidite
