// SPDX-License-Identifier: LGPL-2.1-or-later
#include "granular_adapter/nscd/problem/bodies.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "scenes.hpp"

namespace turbidite::nscd {
namespace {

/// The message with which adding the body is refused.
std::string refusal(const Body& body) {
    Bodies bodies;
    try {
        bodies.add(body);
    } catch (const std::invalid_argument& error) {
        EXPECT_EQ(bodies.size(), 0u);
        return error.what();
    }
    return "";
}

// Also for fixed bodies: a host may release them.
TEST(Bodies, RefuseWhatHasNoMassByNameAndValue) {
    EXPECT_EQ(refusal(scenes::disc(7, 0, 0)), "");
    for (const std::string name : {"radius", "mass", "inertia"}) {
        for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
            Body body = scenes::disc(7, 0, 0);
            body.fixed = value == 0.0;
            if (name == "radius") body.radius = value;
            if (name == "mass") body.mass = value;
            if (name == "inertia") body.inertia = value;
            const std::string text = refusal(body);
            EXPECT_NE(text.find("body 7: " + name + " = "), std::string::npos) << text;
            EXPECT_NE(text.find("must be positive"), std::string::npos) << text;
        }
    }
}

// 0, 3 and 5 about the axes of a body that is turned by 90 degrees about z: indefinite, then 1, 3
// and 5, which exchanges x and y.
TEST(Bodies, HaveMomentsAboutTheirOwnAxes) {
    Body body = scenes::disc(7, 0, 0);
    body.inertia = {};
    body.inertia.yy = 3.0, body.inertia.zz = 5.0;
    EXPECT_NE(refusal(body).find("inertia"), std::string::npos);
    body.inertia.xx = 1.0;
    body.orientation = about_z(std::acos(0.0));
    Bodies bodies;
    bodies.add(body);
    EXPECT_NEAR(bodies.inverse_inertia(0).xx, 1.0 / 3.0, 1e-15);
    EXPECT_NEAR(bodies.inverse_inertia(0).yy, 1.0, 1e-15);
    EXPECT_NEAR(bodies.inverse_inertia(0).zz, 0.2, 1e-15);
    bodies.rotation_blocked[0] = 1;
    EXPECT_EQ(bodies.inverse_inertia(0).zz, 0.0);
}

}  // namespace
}  // namespace turbidite::nscd
