// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/case/grains/soft_contact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace turbidite {
namespace {

/// A collision x'' + 2 zeta x' + x = 0, integrated with small steps until the force vanishes.
struct Bounce {
    explicit Bounce(double zeta) {
        double x = 0.0, v = 1.0;
        const double step = 1e-5;
        while (x + 2.0 * zeta * v >= 0.0) {
            const double middle = v - 0.5 * step * (x + 2.0 * zeta * v);
            v -= step * (x + 0.5 * step * v + 2.0 * zeta * middle);
            x += step * middle;
            deepest = std::max(deepest, x);
        }
        restitution = -v;
    }
    double restitution = 0.0, deepest = 0.0;
};

TEST(SoftContact, KnowsTheBounceOfSpringAndDashpot) {
    for (const double zeta : {0.0, 0.05, 0.3, 0.7, 0.75, 0.99, 1.0}) {
        const Bounce bounce(zeta);
        EXPECT_NEAR(restitution_of(zeta), bounce.restitution, 1e-4) << zeta;
        EXPECT_NEAR(deepest_of(zeta), bounce.deepest, 1e-4) << zeta;
    }
}

TEST(SoftContact, FindsTheDampingOfARestitution) {
    for (const double e : {1.0, 0.9, 0.5, 0.2, 0.14})
        EXPECT_NEAR(restitution_of(damping_of(e)), e, 1e-12);
    for (const double e : {0.0, 0.1, 0.135}) EXPECT_EQ(damping_of(e), 1.0);
}

Settings settings() {
    Settings result;
    result.set("contact.restitution", 1.0);
    result.set("contact.md_overlap", 1e-3);
    result.set("contact.md_substeps", 20.0);
    result.set("fluid.enabled", true);
    result.set("run.diameter", 0.5);
    result.set("run.gravity", 2.0);
    result.set("run.velocity_scale", 3.0);
    result.set("run.step", 0.01);
    return result;
}

// w^2 = 2 S g/D: for S = 2e5 and g/D = 4 w = 1264.9, so a contact lasts 2.484e-3, and a window of
// 0.01 takes 20 * 4.026 = 80.5 sub-steps.
TEST(SoftContact, AStiffnessThatIsGivenIsTaken) {
    Settings given = settings();
    given.set("contact.md_stiffness", 2e5);
    const SoftContact contact = soft_contact(given, 50.0);
    EXPECT_EQ(contact.stiffness, 2e5);
    EXPECT_NEAR(contact.frequency, std::sqrt(1.6e6), 1e-9);
    EXPECT_NEAR(contact.contact_time, std::numbers::pi / std::sqrt(1.6e6), 1e-15);
    EXPECT_EQ(contact.substeps, 81);
    EXPECT_EQ(contact.damping, 0.0);
}

// At 2 u_c = 6 the overlap of an undamped collision is 6/w: 1e-3 D = 5e-4 at w = 12000.
TEST(SoftContact, IsMadeForTheSpeedOfTheCase) {
    EXPECT_NEAR(soft_contact(settings(), 1.0).frequency, 12000.0, 1e-6);
    Settings fast = settings();
    fast.set("contact.md_speed", 4.0);
    EXPECT_NEAR(soft_contact(fast, 1.0).frequency, 24000.0, 1e-6);
    // Dry: 2 sqrt(2 g h) with h = 16 D = 8.
    Settings dry = settings();
    dry.set("fluid.enabled", false);
    EXPECT_NEAR(soft_contact(dry, 16.0).frequency, 2.0 * std::sqrt(32.0) / 5e-4, 1e-6);
    // With critical damping the overlap is 1/e of that.
    Settings damped = settings();
    damped.set("contact.restitution", 0.0);
    EXPECT_NEAR(soft_contact(damped, 1.0).frequency, 12000.0 / std::numbers::e, 1e-6);
}

TEST(SoftContact, CarriesHighPackings) {
    Settings slow = settings();
    slow.set("contact.md_speed", 1e-6);
    EXPECT_NEAR(soft_contact(slow, 40.0).stiffness, 40.0 / 1e-3, 1e-8);
}

}  // namespace
}  // namespace turbidite
