// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The Courant number that check foresees.
#include "launcher/case/forecast/courant_forecast.hpp"

#include <cmath>

#include "coupler/output/measures/courant_limit.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class CourantForecast : public CaseTest {
 protected:
    // u_c = sqrt(g D) = 1. A disc of density ratio 1.5 falls with sqrt(pi/4) u_c at C_D = 1.
    CourantForecast()
        : CaseTest(
              "domain: {size: [12, 12]}\n"
              "grains: {adapter: standalone-nscd, count: 15, density_ratio: 1.5}\n"
              "fluid: {reynolds: 36, cells_per_diameter: 8}\n"
              "time: {step: 0.01, end: 10}\n") {}
};

TEST_F(CourantForecast, IsThatOfAFallingDisc) {
    const double one = forecast_courant(load(""));
    EXPECT_NEAR(one, std::sqrt(0.25 * 3.14159265358979 * 1.0) * 0.01 * 8.0, 1e-12);
    EXPECT_NEAR(forecast_courant(load("", {"time.step=0.02"})), 2.0 * one, 1e-12);
    EXPECT_NEAR(forecast_courant(load("", {"fluid.cells_per_diameter=16"})), 2.0 * one, 1e-12);
    EXPECT_LT(forecast_courant(load("", {"fluid.reynolds=0.9"})), 0.1 * one);  // viscosity rules
    EXPECT_EQ(forecast_courant(load("", {"fluid.enabled=false"})), 0.0);
}

// sqrt(8/3 0.5 g D) at C_D = 1/2, and 0.5 g D^2/(18 nu) of Stokes; or its own velocity.
TEST_F(CourantForecast, IsThatOfAFallingSphere) {
    const std::vector<std::string> space = {"dimension=3", "domain.size=[12, 12, 12]"};
    const auto with = [&](const std::string& change) {
        std::vector<std::string> changes = space;
        changes.push_back(change);
        return forecast_courant(load("", changes));
    };
    EXPECT_NEAR(with("fluid.reynolds=100"), std::sqrt(4.0 / 3.0) * 0.01 * 8.0, 1e-12);
    EXPECT_NEAR(with("fluid.reynolds=0.9"), 0.5 * 0.9 / 18.0 * 0.01 * 8.0, 1e-12);
    folder.write("fast.csv", "id,x,y,z,vz\n1,6,6,6,5\n");
    EXPECT_NEAR(with("grains.file=fast.csv"), 5.0 * 0.01 * 8.0, 1e-12);
}

TEST_F(CourantForecast, WarnsWithTheStepThatWouldDo) {
    EXPECT_EQ(courant_warning(load("")), "");
    const std::string warning = courant_warning(load("", {"time.step=0.5"}));
    EXPECT_EQ(warning.find("the Courant number will be 3.5 or more. "), 0u) << warning;
    const auto at = warning.find("Use time.step = ");
    ASSERT_NE(at, std::string::npos) << warning;
    const std::string advised = warning.substr(at + 16, warning.find(" or less") - at - 16);
    EXPECT_EQ(courant_warning(load("", {"time.step=" + advised})), "") << advised;
    EXPECT_GT(std::stod(advised), 0.05);
}

TEST(CourantLimit, AdvisesOneDigitBelow) {
    EXPECT_NEAR(step_for_courant(0.5, 5.0 * largest_courant), 0.1, 1e-12);
    EXPECT_NEAR(step_for_courant(0.0125, 2.0 * largest_courant), 0.006, 1e-12);
}

}  // namespace
}  // namespace turbidite
