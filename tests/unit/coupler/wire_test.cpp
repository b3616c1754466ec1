// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <limits>

#include "coupler/protocol/message.hpp"

namespace turbidite {
namespace {

// Numbers that a text format or a float would not preserve.
constexpr double awkward = 0.1 + 1e-17;
constexpr double tiny = std::numeric_limits<double>::denorm_min();

GrainState grain() {
    GrainState g;
    g.id = 9'007'199'254'740'993;  // 2^53 + 1: not a double
    g.shape = 3;
    g.radius = awkward;
    g.density = 1.5;
    g.position = {1.0 / 3.0, -tiny, 2.0};
    g.orientation = {0.5, 0.5, 0.5, 0.5};
    g.velocity = {1, 2, 3};
    g.angular_velocity = {4, 5, 6};
    g.contact_impulse = {7, 8, 9};
    g.contact_angular_impulse = {10, 11, 12};
    g.announced_impulse = {13, 14, 15};
    g.announced_angular_impulse = {16, 17, 18};
    return g;
}

TEST(Wire, MotionComesBackBitForBit) {
    Motion motion;
    motion.grains = {grain(), grain()};
    motion.report = {41, 12, awkward, false, tiny, 2, 0.25, 1e-5, awkward, tiny};
    const auto back = decode<Motion>(encode(motion));
    ASSERT_EQ(back.grains.size(), 2u);
    const GrainState& a = motion.grains[1];
    const GrainState& b = back.grains[1];
    EXPECT_EQ(a.id, b.id);
    EXPECT_EQ(a.shape, b.shape);
    EXPECT_EQ(a.radius, b.radius);
    EXPECT_EQ(a.density, b.density);
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.orientation, b.orientation);
    EXPECT_EQ(a.velocity, b.velocity);
    EXPECT_EQ(a.angular_velocity, b.angular_velocity);
    EXPECT_EQ(a.contact_impulse, b.contact_impulse);
    EXPECT_EQ(a.contact_angular_impulse, b.contact_angular_impulse);
    EXPECT_EQ(a.announced_impulse, b.announced_impulse);
    EXPECT_EQ(a.announced_angular_impulse, b.announced_angular_impulse);
    EXPECT_EQ(back.report.contacts, 41);
    EXPECT_EQ(back.report.iterations, 12);
    EXPECT_EQ(back.report.residual, awkward);
    EXPECT_FALSE(back.report.converged);
    EXPECT_EQ(back.report.max_penetration, tiny);
    EXPECT_EQ(back.report.removed, 2);
    EXPECT_EQ(back.report.wall_seconds, 0.25);
    EXPECT_EQ(back.report.quad, 1e-5);
    EXPECT_EQ(back.report.max, awkward);
    EXPECT_EQ(back.report.contact_violation, tiny);
    EXPECT_FALSE(back.contacts) << "not told is not the same as none";
}

TEST(Wire, ContactsComeBackBitForBit) {
    Motion motion;
    motion.contacts.emplace();
    EXPECT_TRUE(decode<Motion>(encode(motion)).contacts.has_value());
    ContactRecord c;
    c.a = 9'007'199'254'740'993;
    c.b = 12;
    c.wall = 3;
    c.feature = 1;
    c.status = ContactStatus::rolling;
    c.gap = -tiny;
    c.length = awkward;
    c.point = {awkward, 2, 3};
    c.normal = {4, 5, 6};
    c.branch = {7, 8, 9};
    c.impulse = {10, 11, awkward};
    c.rolling_impulse = {12, 13, 14};
    motion.contacts = {ContactRecord{}, c};
    const auto back = decode<Motion>(encode(motion));
    ASSERT_EQ(back.contacts->size(), 2u);
    const ContactRecord& d = back.contacts->at(1);
    EXPECT_EQ(d.a, c.a);
    EXPECT_EQ(d.b, c.b);
    EXPECT_EQ(d.wall, c.wall);
    EXPECT_EQ(d.feature, c.feature);
    EXPECT_EQ(d.status, c.status);
    EXPECT_EQ(d.gap, c.gap);
    EXPECT_EQ(d.length, c.length);
    EXPECT_EQ(d.point, c.point);
    EXPECT_EQ(d.normal, c.normal);
    EXPECT_EQ(d.branch, c.branch);
    EXPECT_EQ(d.impulse, c.impulse);
    EXPECT_EQ(d.rolling_impulse, c.rolling_impulse);
    EXPECT_EQ(back.contacts->at(0).wall, -1);
}

TEST(Wire, WhatAnAdapterDoesNotHaveStaysEmpty) {
    Motion motion;
    motion.report.max = 0.5;
    const auto back = decode<Motion>(encode(motion));
    EXPECT_FALSE(back.report.residual);
    EXPECT_FALSE(back.report.quad);
    EXPECT_FALSE(back.report.contact_violation);
    EXPECT_EQ(back.report.max, 0.5);
}

// A program that knows no films sends what it always sent.
TEST(Wire, TheWorkOfFilmsIsAtTheEndOrNotThere) {
    Motion motion;
    motion.grains = {grain()};
    motion.contacts.emplace();
    const Bytes without = encode(motion);
    EXPECT_FALSE(decode<Motion>(without).report.film_work);
    motion.report.film_work = -tiny;
    const Bytes with = encode(motion);
    EXPECT_EQ(with.size(), without.size() + 2 * sizeof(double));
    EXPECT_TRUE(std::equal(without.begin(), without.end(), with.begin()));
    EXPECT_EQ(decode<Motion>(with).report.film_work, -tiny);
}

TEST(Wire, KicksComeBack) {
    Kicks kicks;
    kicks.kicks.push_back({7, {1, 2, 3}, {4, 5, 6}, {7, 8, 9}, {1, 1, 2}, {3, 5, 8}, {13, 21, 34}});
    kicks.report = {9,
                    awkward,
                    false,
                    1e-5,
                    2.0,
                    1e-9,
                    0.4,
                    SplittingReport{3, 2, 1e-3, awkward, false},
                    {0.1, -0.2, 0.0},
                    0.03,
                    {1.5, -2.5}};
    const auto back = decode<Kicks>(encode(kicks));
    ASSERT_EQ(back.kicks.size(), 1u);
    EXPECT_EQ(back.kicks[0].id, 7);
    EXPECT_EQ(back.kicks[0].velocity, (Vec3{1, 2, 3}));
    EXPECT_EQ(back.kicks[0].multiplier_angular_impulse, (Vec3{1, 1, 2}));
    EXPECT_EQ(back.kicks[0].torque, (Vec3{13, 21, 34}));
    ASSERT_TRUE(back.report.splitting);
    EXPECT_EQ(back.report.splitting->pressure_iterations, 3);
    EXPECT_EQ(back.report.splitting->viscous_residual, awkward);
    EXPECT_FALSE(back.report.splitting->converged);
    EXPECT_EQ(back.report.multiplier_residual, awkward);
    EXPECT_FALSE(back.report.multipliers_converged);
    EXPECT_EQ(back.report.momentum_defect, 1e-9);
    EXPECT_EQ(back.report.mean_velocity, (Vec3{0.1, -0.2, 0.0}));
    EXPECT_EQ(back.report.wall_seconds, 0.03);
    EXPECT_EQ(back.report.probes, (std::vector<double>{1.5, -2.5}));
}

TEST(Wire, HelloComesBack) {
    Hello hello;
    hello.role = Role::fluid;
    hello.adapter = "foam";
    hello.host = "node07";
    hello.pid = 12345;
    hello.capabilities.effective_inertia = true;
    hello.capabilities.shapes = {"disc", "sphere"};
    const auto back = decode<Hello>(encode(hello));
    EXPECT_EQ(back.role, Role::fluid);
    EXPECT_EQ(back.adapter, "foam");
    EXPECT_EQ(back.host, "node07");
    EXPECT_EQ(back.pid, 12345);
    EXPECT_TRUE(back.capabilities.effective_inertia);
    EXPECT_EQ(back.capabilities.shapes, hello.capabilities.shapes);
}

TEST(Wire, FreeResponsesWindowsBoxesShapesComeBack) {
    FreeResponse response;
    response.id = 4;
    response.inertia[upper_entry(5, 5)] = awkward;
    response.mismatch = tiny;
    const FreeResponse back = decode<std::vector<FreeResponse>>(encode(std::vector{response}))[0];
    EXPECT_EQ(back.inertia[upper_entry(5, 5)], awkward);
    EXPECT_EQ(back.mismatch, tiny);
    const Window window{12, 0.5, 0.01, true};
    EXPECT_EQ(decode<Window>(encode(window)).index, 12);
    EXPECT_TRUE(decode<Window>(encode(window)).write_output);
    EXPECT_EQ(decode<Box>(encode(Box{{1, 2, 3}, {4, 5, 6}})).upper, (Vec3{4, 5, 6}));
    const ShapeTable shapes = {{"polygon", {0, 1, awkward}}};
    EXPECT_EQ(decode<ShapeTable>(encode(shapes))[0].vertices, shapes[0].vertices);
}

TEST(Wire, FrameKeepsTheEnvelope) {
    Message message{{Kind::kicks, 41, 2, 77}, encode(std::string("payload"))};
    const Message back = unframe(frame(message));
    EXPECT_EQ(back.envelope.kind, Kind::kicks);
    EXPECT_EQ(back.envelope.window, 41);
    EXPECT_EQ(back.envelope.iteration, 2);
    EXPECT_EQ(back.envelope.sequence, 77);
    EXPECT_EQ(decode<std::string>(back.payload), "payload");
}

TEST(Wire, TruncatedOrForeignBytesAreRefused) {
    Bytes motion = encode(Motion{{grain()}, {}});
    motion.pop_back();
    EXPECT_THROW(decode<Motion>(motion), MalformedPayload);
    motion.push_back(0), motion.push_back(0);
    EXPECT_THROW(decode<Motion>(motion), MalformedPayload);
    EXPECT_THROW(unframe(Bytes(100, 'x')), MalformedPayload);
    Bytes bytes = frame({{}, Bytes(10, 'y')});
    bytes.resize(bytes.size() - 3);
    EXPECT_THROW(unframe(bytes), MalformedPayload);
}

// Of a program that writes four bytes into places of eight that are not zero.
TEST(Wire, ANumberThatDoesNotFitIsRefused) {
    const auto read = [](std::int64_t sent, auto number) {
        Bytes bytes;
        Writer code(bytes);
        code(sent);
        Reader from(bytes);
        from(number);
        return number;
    };
    EXPECT_EQ(read(-7, std::int32_t{}), -7);
    EXPECT_THROW(read(std::int64_t{1} << 32 | 7, std::int32_t{}), MalformedPayload);
    EXPECT_TRUE(read(1, bool{}));
    EXPECT_THROW(read(256, bool{}), MalformedPayload);

    Bytes motion = encode(Motion{{grain()}, {}});
    const auto shape = static_cast<std::int64_t>(grain().shape) | std::int64_t{1} << 40;
    bool found = false;
    for (std::size_t at = 0; at + sizeof shape <= motion.size() && !found; at += sizeof shape) {
        Bytes changed = motion;
        std::memcpy(changed.data() + at, &shape, sizeof shape);
        try {
            decode<Motion>(changed);
        } catch (const MalformedPayload& fault) {
            found = std::string(fault.what()).find("out of range") != std::string::npos;
        }
    }
    EXPECT_TRUE(found);
}

TEST(Wire, AHugeLengthIsRefusedBeforeMemoryIsTaken) {
    Bytes bytes;
    Writer code(bytes);
    code(std::int64_t{1} << 60);
    EXPECT_THROW(decode<Motion>(bytes), MalformedPayload);
}

}  // namespace
}  // namespace turbidite
