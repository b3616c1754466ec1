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
    for (double Body::*field : {&Body::radius, &Body::mass, &Body::inertia}) {
        const std::string name = field == &Body::radius ? "radius"
                                 : field == &Body::mass ? "mass"
                                                        : "inertia";
        for (const double value : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
            Body body = scenes::disc(7, 0, 0);
            body.fixed = value == 0.0;
            body.*field = value;
            const std::string text = refusal(body);
            EXPECT_NE(text.find("body 7: " + name + " = "), std::string::npos) << text;
            EXPECT_NE(text.find("must be positive"), std::string::npos) << text;
        }
    }
}

}  // namespace
}  // namespace turbidite::nscd
