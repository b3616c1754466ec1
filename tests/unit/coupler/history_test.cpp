// SPDX-License-Identifier: LGPL-2.1-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "coupler/output/history.hpp"
#include "tests/unit/coupler/test_case.hpp"

namespace turbidite {
namespace {

// The columns are a contract with tools outside the project: this list is the contract, not a copy
// of the code.
TEST(History, HeaderIsTheContract) {
    EXPECT_EQ(
        history_header(),
        "step,time,mean_velocity_x,mean_velocity_y,mean_velocity_norm,mean_speed,"
        "mean_position_x,mean_position_y,front_x,kinetic_energy,grains,contacts,"
        "max_penetration,contact_iterations,contact_residual,multiplier_iterations,"
        "multiplier_residual,divergence,pore_volume,wall_step,wall_fluid,wall_grains,"
        "wall_coupling,grain_balance,fluid_balance,joint_rounds,joint_mismatch,"
        "contact_quad,contact_max,unconverged,coordination,loose_grains,"
        "fabric_anisotropy,fabric_angle,sigma_xx,sigma_xy,sigma_yy,mean_normal_force,"
        "sliding_share,flow_x,flow_y,fluid_force_x,fluid_force_y,pressure_iterations,"
        "viscous_iterations,remaining_divergence,viscous_residual,potential_energy,"
        "contact_work,fluid_work,contact_violation,motion_defect,mean_velocity_z,mean_position_z,"
        "sigma_xz,sigma_yz,sigma_zz,flow_z,fluid_force_z,film_work");
}

TEST(History, EveryColumnIsExplained) {
    std::ostringstream page;
    page << std::ifstream(TURBIDITE_SOURCE_DIR "/docs/outputs.md").rdbuf();
    std::istringstream names(history_header());
    for (std::string name; std::getline(names, name, ',');)
        EXPECT_NE(page.str().find("`" + name + "`"), std::string::npos) << name;
}

// Three discs at x = 2, 4.5, 7 with velocities (3, 4), (-3, 4), (0, 4): |<u>| = 4, <|u|> = (5 + 5 +
// 4)/3, front 7.5, energy per mass (25 + 25 + 16)/6.
TEST(History, MeansAreNumberMeans) {
    Motion state;
    state.grains = test_population();
    state.grains[0].velocity = {3, 4, 0};
    state.grains[1].velocity = {-3, 4, 0};
    state.grains[2].velocity = {0, 4, 0};
    const Averages mean =
        averages(state, ImmersedBodies(run_values(test_settings()), {{"disc", {}}}));
    EXPECT_NEAR(mean.velocity[0], 0.0, 1e-15);
    EXPECT_NEAR(mean.velocity[1], 4.0, 1e-15);
    EXPECT_NEAR(mean.speed, 14.0 / 3.0, 1e-14);
    EXPECT_NEAR(mean.front, 7.5, 1e-15);
    EXPECT_NEAR(mean.kinetic_energy / mean.mass, 66.0 / 6.0, 1e-13);
}

// A disc spinning at w has I w^2/2 = M R^2 w^2/4: with R = 0.5, w = 2 that is M/4.
TEST(History, SpinCountsAsKineticEnergy) {
    Motion state;
    state.grains = {test_population()[0]};
    state.grains[0].angular_velocity = {0, 0, 2};
    const Averages mean =
        averages(state, ImmersedBodies(run_values(test_settings()), {{"disc", {}}}));
    EXPECT_NEAR(mean.kinetic_energy / mean.mass, 0.25, 1e-15);
}

std::map<std::string, std::string> last_row(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::string names, line, last;
    std::getline(in, names);
    while (std::getline(in, line)) last = line;
    std::map<std::string, std::string> row;
    std::istringstream name(names), cell(last + ",");
    for (std::string n, c; std::getline(name, n, ',') && std::getline(cell, c, ',');) row[n] = c;
    return row;
}

std::map<std::string, std::string> written(const Row& row, const Settings& settings) {
    const TestFolder folder("history-row");
    History history(folder.path() / "history.csv", run_values(settings), {{"disc", {}}});
    history.append(row);
    return last_row(folder.path() / "history.csv");
}

// Four discs of density 1.5 in a square, the upper two resting on the lower ones, these on the
// floor; D = 2, g = 3. A disc weighs w = 1.5 pi 3.
TEST(History, ContactForcesAreInWeightsOfTheSolid) {
    Settings settings = test_settings();
    settings.set("run.diameter", 2.0), settings.set("run.gravity", 3.0);
    const double area = std::numbers::pi, weight = 1.5 * area * 3.0, step = 0.01;
    Motion state;
    state.contacts.emplace();
    for (int k = 0; k < 4; ++k) {
        GrainState grain;
        grain.id = k;
        grain.radius = 1.0;
        grain.density = 1.5;
        grain.position = {1.0 + 2.0 * (k % 2), 1.0 + 2.0 * (k / 2), 0.0};
        state.grains.push_back(grain);
        ContactRecord contact;
        contact.b = k;
        contact.normal = {0, 1, 0};
        contact.wall = k < 2 ? 2 : -1;
        contact.a = k < 2 ? 0 : k - 2;
        contact.branch = {0, k < 2 ? 1.0 : 2.0, 0};
        contact.impulse = {0, step * weight * (k < 2 ? 2.0 : 1.0), 0};
        state.contacts->push_back(contact);
    }
    std::sort(state.contacts->begin(), state.contacts->end(), contact_before);
    Row row;
    row.state = &state;
    auto cells = written(row, settings);
    const double pores = 4.0 - area;  // between the four centres
    EXPECT_NEAR(std::stod(cells["pore_volume"]), pores / 4.0, 1e-9);
    // Two towers: w (1 + 3) each; divided by the area, and by rho_s g D.
    EXPECT_NEAR(std::stod(cells["sigma_yy"]),
                8.0 * weight / (4.0 * area + pores) / (1.5 * 3.0 * 2.0), 1e-9);
    EXPECT_EQ(std::stod(cells["sigma_xx"]), 0.0);
    EXPECT_NEAR(std::stod(cells["mean_normal_force"]), std::numbers::pi / 4.0, 1e-9);
    EXPECT_NEAR(std::stod(cells["coordination"]), 1.5, 1e-9);
    EXPECT_EQ(cells["loose_grains"], "0");
    EXPECT_NEAR(std::stod(cells["fabric_anisotropy"]), 2.0, 1e-9);
    EXPECT_NEAR(std::stod(cells["fabric_angle"]), std::numbers::pi / 2.0, 1e-9);
    EXPECT_EQ(cells["sliding_share"], "0");
}

// From an adapter without contacts or residuals, and in a first row.
TEST(History, WhatDoesNotApplyIsEmpty) {
    Motion state;
    state.grains = test_population();
    Row row;
    row.state = &state;
    auto cells = written(row, test_settings());
    for (const char* name :
         {"contacts",          "contact_iterations", "contact_residual", "contact_quad",
          "contact_max",       "unconverged",        "coordination",     "loose_grains",
          "fabric_anisotropy", "fabric_angle",       "sigma_xx",         "sigma_xy",
          "sigma_yy",          "mean_normal_force",  "sliding_share",    "contact_work",
          "fluid_work",        "contact_violation",  "motion_defect",    "film_work"})
        EXPECT_EQ(cells.at(name), "") << name;
    EXPECT_EQ(cells["pore_volume"], "0") << "grains, but no pores between them";
    ContactReport report;
    report.max = 0.5;
    row.contact = &report;
    row.since.emplace();
    row.since->take_in({0.5, 0.0, 0.0, 0.0}, false);
    row.since->take_in({0.25, 0.0, 0.0, 0.0}, true);
    cells = written(row, test_settings());
    EXPECT_EQ(cells["contact_residual"], "");
    EXPECT_EQ(cells["contact_quad"], "");
    EXPECT_EQ(cells["contact_max"], "0.5");
    EXPECT_EQ(cells["contact_violation"], "");
    state.report.contact_violation = 0.25;
    EXPECT_EQ(written(row, test_settings())["contact_violation"], "0.25");
    EXPECT_EQ(cells["film_work"], "") << "no films";
    state.report.film_work = 0.0;
    EXPECT_EQ(written(row, test_settings())["film_work"], "0");
    EXPECT_EQ(cells["contacts"], "0");
    EXPECT_EQ(cells["unconverged"], "1");
    EXPECT_EQ(cells["wall_step"], "0.375000");
    state.grains.clear();
    EXPECT_EQ(written(row, test_settings())["pore_volume"], "");
}

TEST(History, AFullDiskIsAnError) {
    EXPECT_THROW(History("/dev/full", run_values(test_settings()), {{"disc", {}}}), Failure);
}

}  // namespace
}  // namespace turbidite
