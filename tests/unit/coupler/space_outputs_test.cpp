// SPDX-License-Identifier: LGPL-2.1-or-later
//
// What a run in space writes, and the values and motions that its programs read.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "coupler/hub/kick_rule.hpp"
#include "coupler/output/history.hpp"
#include "coupler/output/measures/pore_voxels.hpp"
#include "coupler/protocol/scene/plates.hpp"
#include "coupler/protocol/scene/prescribed_motion.hpp"
#include "tests/run_settings.hpp"

namespace turbidite {
namespace {

constexpr double pi = std::numbers::pi;

/// A dry run in a box of 10 D x 10 D x 4 D, cyclic along z.
Settings space_settings() {
    Settings s = run_settings();
    s.set("dimension", std::int64_t{3});
    s.set("fluid.enabled", false);
    s.set("run.dimension", std::int64_t{3});
    s.set("run.size_z", 4.0);
    s.set("run.acceleration_z", 0.0);
    for (const char* side : {"front", "back"})
        s.set(std::string("domain.") + side, std::string("cyclic"));
    return s;
}

TEST(RunInSpace, HasThreeNumbersAndSixSides) {
    const Settings s = space_settings();
    const RunValues run = run_values(s);
    EXPECT_EQ(run.dimension, 3);
    EXPECT_EQ(run.size, (Vec3{10.0, 10.0, 4.0}));
    EXPECT_EQ(run.period, (Vec3{0.0, 0.0, 4.0}));
    EXPECT_EQ(side_types(s)[5], "cyclic");
    EXPECT_EQ(first_plate(3), 6);
    EXPECT_EQ(first_plate(2), 4);
    EXPECT_EQ(box_sides[5].distance({1.0, 1.0, 3.0}, run.size), 1.0);
    EXPECT_EQ(side_types(run_settings())[4], "");
    Settings strange = s;
    strange.set("run.dimension", std::int64_t{4});
    EXPECT_THROW(run_values(strange), std::runtime_error);
}

TEST(RunInSpace, MotionsHaveThreeNumbersAndAnAxis) {
    Settings s = space_settings();
    s.set("run.wall_motions", std::string("2 constant 1 2 3 0 0 0.5;4 harmonic 0 0 1 0 2 0 4 0;"
                                          "5 table 0 0 0 0 0 0 0 2 1 2 3 0 0 0"));
    const auto moved = motions_of(s, "run.wall_motions");
    ASSERT_EQ(moved.size(), 3u);
    EXPECT_EQ(moved[0].motion->rate(0.0, 1.0).velocity, (Vec3{1, 2, 3}));
    EXPECT_EQ(moved[0].motion->rate(0.0, 1.0).spin, (Vec3{0, 0, 0.5}));
    EXPECT_NEAR(moved[1].motion->at(1.0).displacement[2], 1.0, 1e-15);
    EXPECT_NEAR(moved[1].motion->at(1.0).angle[1], 2.0, 1e-15);
    EXPECT_EQ(moved[2].motion->at(1.0).displacement, (Vec3{0.5, 1.0, 1.5}));
    s.set("run.wall_motions", std::string("5 table 0 0 0 0"));
    EXPECT_THROW(motions_of(s, "run.wall_motions"), std::invalid_argument);
}

ContactRecord push(GrainId a, GrainId b, const Vec3& normal, double impulse) {
    ContactRecord contact;
    contact.a = a;
    contact.b = b;
    contact.normal = contact.branch = normal;
    contact.impulse = impulse * normal;
    return contact;
}

/// Along x, y and z.
std::vector<ContactRecord> three_links() {
    return {push(0, 1, {1, 0, 0}, 2.0), push(0, 2, {0, 1, 0}, 2.0), push(0, 3, {0, 0, 1}, 6.0)};
}

TEST(ContactNetworkInSpace, FabricOfEqualDirectionsIsZero) {
    const ContactNetwork network = contact_network(three_links(), 4, 0.5, 3);
    EXPECT_NEAR(network.fabric->anisotropy, 0.0, 1e-14);
    EXPECT_NEAR(network.virial.xx, 4.0, 1e-14);
    EXPECT_NEAR(network.virial.zz, 12.0, 1e-14);
}

// dev F of parallel normals has the values 2/3, -1/3, -1/3: |dev F| = sqrt(2/3).
TEST(ContactNetworkInSpace, FabricOfParallelNormalsIsLargest) {
    const Vec3 n = Vec3{1, 2, 2} / 3.0;
    const ContactNetwork network =
        contact_network({push(0, 1, n, 1.0), push(1, 2, n, 1.0)}, 3, 1.0, 3);
    EXPECT_NEAR(network.fabric->anisotropy, 7.5, 1e-13);
    EXPECT_NEAR(network.virial.yz, 2.0 * 4.0 / 9.0, 1e-14);
    EXPECT_NEAR(network.virial.xz, 2.0 * 2.0 / 9.0, 1e-14);
}

std::vector<SolidBall> fcc(int cells, double diameter) {
    const double a = std::numbers::sqrt2 * diameter;
    std::vector<SolidBall> balls;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j)
            for (int k = 0; k < cells; ++k)
                for (const Vec3& site :
                     {Vec3{0, 0, 0}, Vec3{0.5, 0.5, 0}, Vec3{0.5, 0, 0.5}, Vec3{0, 0.5, 0.5}})
                    balls.push_back(
                        {a * (Vec3{double(i), double(j), double(k)} + site), 0.5 * diameter});
    return balls;
}

TEST(PoreVoxels, OfAPeriodicLatticeAreWhatIsNotSolid) {
    for (const double diameter : {1.0, 2e-3}) {
        const double side = 3.0 * std::numbers::sqrt2 * diameter, volume = side * side * side;
        const double solid = 108.0 * pi / 6.0 * diameter * diameter * diameter;
        const double found = pore_volume(fcc(3, diameter), diameter, {side, side, side});
        EXPECT_NEAR(found / (volume - solid), 1.0, 0.03);
    }
}

TEST(PoreVoxels, OpenSpaceIsNoPore) {
    EXPECT_EQ(pore_volume(std::vector<SolidBall>{}, 1.0, {}), 0.0);
    EXPECT_EQ(pore_volume(std::vector<SolidBall>{{{0.3, 0.2, 0.7}, 0.5}}, 1.0, {}), 0.0);
    // Two spheres with a gap that a ball of radius D passes.
    EXPECT_EQ(pore_volume(std::vector<SolidBall>{{{0, 0, 0}, 0.5}, {{3.2, 0, 0}, 0.5}}, 1.0, {}),
              0.0);
}

// A ball of radius D that touches both leaves the ring between y_s = sqrt(1/4 - (1/2 - x)^2) and
// y_b = sqrt 2 - sqrt(1 - x^2) up to x = 1/3 on both sides: 0.1225 D^3.
TEST(PoreVoxels, TwoTouchingSpheresHaveARing) {
    const double found =
        pore_volume(std::vector<SolidBall>{{{0, 0, 0}, 0.5}, {{1, 0, 0}, 0.5}}, 1.0, {});
    EXPECT_NEAR(found, 0.1225, 0.03);
}

TEST(PoreVoxels, AcrossACyclicSideGrainsMeet) {
    const std::vector<SolidBall> pair{{{2, 2, 0.4}, 0.5}, {{2, 2, 3.4}, 0.5}};
    EXPECT_EQ(pore_volume(pair, 1.0, {}), 0.0);
    EXPECT_NEAR(pore_volume(pair, 1.0, {0, 0, 4}), 0.1225, 0.03);
}

TEST(PoreVoxels, HowTheBoxIsCutChangesNothing) {
    std::vector<SolidBall> balls = fcc(4, 1.0);
    for (SolidBall& ball : balls) ball.centre[1] += 0.3 * std::sin(7.0 * ball.centre[0]);
    balls.push_back({{3, 3, -0.4}, 0.8});  // across a cyclic side, and larger
    const double side = 4.0 * std::numbers::sqrt2;
    for (const Vec3& period : {Vec3{}, Vec3{0, 0, side}, Vec3{side, 0, side + 20.0},
                               Vec3{side + 20.0, 0, side}, Vec3{0, side + 20.0, 0}}) {
        const double whole = pore_volume(balls, 1.0, period, 1000000);
        EXPECT_GT(whole, 10.0);
        for (const std::int64_t longest : {150, 61, 44, 23})
            EXPECT_EQ(pore_volume(balls, 1.0, period, longest), whole) << longest;
    }
}

TEST(PoreVoxels, AMirrorImageHasTheSame) {
    const std::vector<SolidBall> balls{
        {{0, 0, 0}, 0.5}, {{0.93, 0.31, 0.1}, 0.47}, {{0.41, 0.87, 0.37}, 0.53}};
    const double pores = pore_volume(balls, 1.0, {});
    EXPECT_GT(pores, 0.1);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::vector<SolidBall> image = balls;
        for (SolidBall& ball : image) ball.centre[axis] *= -1.0;
        EXPECT_EQ(pore_volume(image, 1.0, {}), pores) << axis;
    }
}

TEST(PoreVoxels, OfGrainsThatAreFarApartAreThoseOfEach) {
    // 5e14 voxels in one piece
    std::vector<SolidBall> balls;
    for (const double far : {0.0, 1e4})
        for (const double x : {0.0, 1.0}) balls.push_back({{x + far, far, far}, 0.5});
    const std::vector<SolidBall> pair{balls[0], balls[1]};
    EXPECT_EQ(pore_volume(balls, 1.0, {}), 2.0 * pore_volume(pair, 1.0, {}));
}

/// Column name -> text of the only row.
std::map<std::string, std::string> cells(const RowValues& values) {
    std::istringstream names(history_header()), row(history_line(values));
    std::map<std::string, std::string> result;
    for (std::string name, cell; std::getline(names, name, ',');) {
        cell.clear();
        std::getline(row, cell, ',');
        result[name] = cell;
    }
    return result;
}

/// Two spheres of density 1, one of which moves and turns.
Motion two_spheres() {
    Motion state;
    for (GrainId id = 0; id < 2; ++id) {
        GrainState grain;
        grain.id = id;
        grain.radius = 0.5;
        grain.density = 1.0;
        grain.position = {1.0, 1.0, 1.0 + static_cast<double>(id)};
        state.grains.push_back(grain);
    }
    state.grains[1].velocity = {0, 0, 3};
    state.grains[1].angular_velocity = {0, 2, 0};
    return state;
}

TEST(HistoryInSpace, HasColumnsOfTheThirdAxis) {
    const Settings s = space_settings();
    const RunValues run = run_values(s);
    const Motion state = two_spheres();
    const ImmersedBodies bodies(run, {{"sphere", {}}});
    Row row;
    row.state = &state;
    const RowValues values{row, averages(state, bodies), 0.5,
                           contact_network(three_links(), 2, 1.0, 3), run};
    const auto cell = cells(values);
    EXPECT_EQ(cell.at("mean_velocity_z"), "1.5");
    EXPECT_EQ(cell.at("mean_position_z"), "1.5");
    EXPECT_EQ(cell.at("pore_volume"), "0.5");
    EXPECT_EQ(cell.at("fabric_angle"), "");
    EXPECT_NE(cell.at("fabric_anisotropy"), "");
    EXPECT_EQ(cell.at("flow_z"), "");
    // sum of f l over (V_grains + V_pores) rho g D, V = pi/6 each
    const double volume = pi / 3.0 + 0.5;
    EXPECT_NEAR(std::stod(cell.at("sigma_zz")), 6.0 / volume, 1e-9);
    EXPECT_EQ(cell.at("sigma_xz"), "0");
    // m U^2/2 + (2/5 m R^2) w^2/2 of one of two
    EXPECT_NEAR(std::stod(cell.at("kinetic_energy")), (4.5 + 0.2) / 2.0, 1e-9);
}

TEST(HistoryInSpace, ThePlaneLeavesThemEmpty) {
    const RunValues run = run_values(run_settings());
    Motion state = two_spheres();
    const ImmersedBodies bodies(run, {{"disc", {}}});
    Row row;
    row.state = &state;
    const auto cell = cells({row, averages(state, bodies), 0.5, {}, run});
    for (const char* name : {"mean_velocity_z", "mean_position_z", "sigma_xz", "sigma_yz",
                             "sigma_zz", "flow_z", "fluid_force_z"})
        EXPECT_EQ(cell.at(name), "") << name;
    EXPECT_NE(cell.at("mean_velocity_x"), "");
}

// M dU = M g dt + J and I dw = K hold for a sphere that turns about any axis.
TEST(KickRuleInSpace, ASphereTurnsAboutAnyAxis) {
    const Settings s = space_settings();
    const RunValues run = run_values(s);
    Motion before = two_spheres();
    before.grains.pop_back();
    before.grains[0].orientation = {0.5, 0.5, 0.5, 0.5};
    before.grains[0].angular_velocity = {1, 2, 3};
    const double mass = pi / 6.0, inertia = 0.4 * mass * 0.25, step = 0.01;
    const Vec3 impulse{0.1, 0.2, 0.3}, turn{0.01, -0.02, 0.03};
    Motion after = before;
    after.grains[0].velocity = impulse / mass + Vec3{0.0, -step, 0.0};
    after.grains[0].angular_velocity = before.grains[0].angular_velocity + turn / inertia;
    after.grains[0].contact_impulse = impulse;
    after.grains[0].contact_angular_impulse = turn;
    KickRule rule(run, {{"sphere", {}}}, before.grains);
    EXPECT_LE(rule.balance(before, after, step).defect, 1e-14);
    after.grains[0].contact_angular_impulse[0] += 0.001;
    EXPECT_GT(rule.balance(before, after, step).defect, 1e-3);
}

}  // namespace
}  // namespace turbidite
