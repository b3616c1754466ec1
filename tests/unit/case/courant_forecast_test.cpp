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
    // Each with its own radius and density: 2 R (rho_r - 1) = 10 * 6 times g D.
    folder.write("ball.csv", "id,x,y,z,radius,density\n1,6,6,6,5,7\n");
    const std::vector<std::string> inviscid = {"dimension=3", "domain.size=[12, 12, 12]",
                                               "grains.file=ball.csv", "fluid.reynolds=1e4"};
    EXPECT_NEAR(forecast_courant(load("", inviscid)), std::sqrt(8.0 / 3.0 * 60.0) * 0.08, 1e-9);
    folder.write("held.csv", "id,x,y,z,motion\n1,6,6,6,fixed\n");
    EXPECT_EQ(with("grains.file=held.csv"), 0.0);
}

// 25 u_c dt/h = 4 with dt = 0.02 t_c and D/8.
TEST_F(CourantForecast, IsThatOfPrescribedMotions) {
    const std::string motion = "domain.motions.swing.";
    const auto with = [&](std::vector<std::string> changes) {
        changes.insert(changes.end(),
                       {"dimension=3", "domain.size=[12, 12, 12]", "time.step=0.02"});
        return load("", changes);
    };
    folder.write("one.csv", "id,x,y,z,motion\n1,6,6,6,swing\n");
    const std::string grain = "grains.file=one.csv";
    const std::vector<std::string> swing{grain, "grains.count=~", motion + "kind=harmonic",
                                         motion + "amplitude=[3.979, 0, 0]", motion + "period=1"};
    EXPECT_NEAR(forecast_courant(with(swing)), 4.0, 0.02);
    EXPECT_SAYS(courant_warning(with(swing)), "the Courant number will be 4 or more");
    // The surface of a sphere that turns, and a long run.
    const std::vector<std::string> turn{grain, "grains.count=~", motion + "kind=constant",
                                        motion + "spin=50", "time.end=1000"};
    EXPECT_NEAR(forecast_courant(with(turn)), 4.0, 1e-9);
    const std::vector<std::string> inflow{"domain.left=inflow", "domain.right=free",
                                          "domain.left_motion=swing", motion + "kind=constant",
                                          motion + "velocity=[25, 0, 0]"};
    EXPECT_NEAR(forecast_courant(with(inflow)), 4.0, 1e-9);
    const std::vector<std::string> lid{"domain.top_motion=swing", motion + "kind=constant",
                                       motion + "velocity=[25, 0, 0]"};
    EXPECT_NEAR(forecast_courant(with(lid)), 4.0, 1e-9);
    // A drum about its own axis, whose ends are far from the pivot: R = 4 D.
    folder.write(
        "walls.csv",
        "id,kind,x,y,z,ax,ay,az,r1,thickness,wx,wy,wz\n1,cylinder,6,6,2,0,0,8,4,0.5,0,0,6.25\n");
    EXPECT_NEAR(forecast_courant(with({"domain.walls_file=walls.csv", "grains.count=1",
                                       "grains.cylinder=[6, 6, 3, 6, 6, 9, 3]"})),
                4.0, 1e-9);
    EXPECT_EQ(courant_warning(with({})), "");
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
