// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The output of a dry run for a packing at rest: the coupler and the NSCD adapter in two threads. A
// perfect triangular lattice of smooth discs stands between walls that exactly confine it.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <thread>

#include "coupler/hub/hub.hpp"
#include "coupler/participant/session.hpp"
#include "coupler/transport/loopback_channel.hpp"
#include "granular_adapter/nscd_adapter/nscd_adapter.hpp"
#include "tests/unit/coupler/test_case.hpp"
#include "tests/unit/nscd_adapter/contact_case.hpp"

namespace turbidite {
namespace {

constexpr double weight = 1.5 * std::numbers::pi / 4.0;  // g = 1, D = 1
const double row_height = std::sqrt(3.0) / 2.0;

Settings lattice_settings() {
    Settings s = test_settings("split", false);
    s.set("grains.adapter", std::string("standalone-nscd"));
    s.set("coupling.positions", std::string("contact"));
    set_contact_keys(s);
    s.set("contact.friction", 0.0);
    s.set("contact.tolerance", 1e-9);
    s.set("run.windows", std::int64_t{4});
    s.set("run.size_x", 4.0);
    return s;
}

/// Alternate rows of four and of three, five in all: 18 discs.
std::vector<GrainState> lattice() {
    std::vector<GrainState> grains;
    for (int row = 0; row < 5; ++row)
        for (int k = 0; k < 4 - row % 2; ++k) {
            GrainState grain;
            grain.id = 10 * row + k;
            grain.radius = 0.5;
            grain.density = 1.5;
            grain.position = {0.5 + 0.5 * (row % 2) + k, 0.5 + row_height * row, 0.0};
            grains.push_back(grain);
        }
    return grains;
}

RunStatus run(const TestFolder& folder, const Settings& settings) {
    auto [grains, ends] = LoopbackChannel::connect(1);
    NscdAdapter nscd;
    std::thread thread([&nscd, &channel = *ends[0]] {
        const auto session = make_session(nscd, channel, {0, 1, "a.log", "0123456789abcdef"});
        for (bool going = session->start(); going; going = session->step()) {
        }
    });
    RunStatus status;
    {
        Hub hub({settings, {{"disc", {}}}, lattice()}, folder.files(), *grains, nullptr,
                find_scheme("dry"));
        status = hub.run();
    }
    thread.join();
    EXPECT_EQ(status.code, ExitCode::done) << status.reason;
    return status;
}

std::string text_of(const std::filesystem::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// The cells of a row of the history, by column name; the header is row 0.
std::map<std::string, std::string> row(const TestFolder& folder, int index) {
    std::ifstream in(folder.files().history);
    std::string names, line;
    std::getline(in, names);
    for (int k = 0; k < index; ++k) std::getline(in, line);
    std::map<std::string, std::string> cells;
    std::istringstream name(names), cell(line + ",");
    for (std::string n, c; std::getline(name, n, ',') && std::getline(cell, c, ',');) cells[n] = c;
    return cells;
}

std::vector<double> numbers(const std::string& text, const std::string& cell_array) {
    const auto cells = text.find("<CellData");
    const auto begin = text.find(">\n", text.find("Name=\"" + cell_array + "\"", cells)) + 2;
    std::istringstream in(text.substr(begin, text.find('<', begin) - begin));
    std::vector<double> result;
    for (double value; in >> value;) result.push_back(value);
    return result;
}

TEST(PackingOutputs, StressAndPoresOfALatticeAtRest) {
    const TestFolder folder("lattice-stress");
    run(folder, lattice_settings());
    auto cells = row(folder, 3);
    ASSERT_EQ(cells["step"], "4");
    // 20 triangles between the rows, and 4 of the same area (sides 1, 1 and sqrt(3), circumradius
    // D) at the walls beside the rows of three.
    const double pores = 24 * (row_height / 2.0 - std::numbers::pi / 8.0);
    EXPECT_NEAR(std::stod(cells["pore_volume"]), pores, 1e-6);
    // Smooth walls carry no weight: the moment is the sum of every weight times its height.
    double moment = 0.0;
    for (const GrainState& grain : lattice()) moment += weight * grain.position[1];
    const double area = 18 * std::numbers::pi / 4.0 + pores;
    EXPECT_NEAR(std::stod(cells["sigma_yy"]), moment / area / 1.5, 1e-6);
    EXPECT_GT(std::stod(cells["sigma_xx"]), 0.0);
    // The height at which the walls push depends on which of many solutions is found; the shear
    // balances it.
    const std::string text = text_of(folder.path() / "grains/contacts_00000004.vtp");
    const auto walls = numbers(text, "id_a"), forces = numbers(text, "normal_force");
    const auto points = numbers(text, "point");
    double tilt = 0.0;
    for (std::size_t k = 0; k < walls.size(); ++k)
        if (walls[k] == -1 || walls[k] == -2)
            tilt += (walls[k] == -1 ? -1.0 : 1.0) * forces[k] * points[3 * k + 1];
    EXPECT_NEAR(std::stod(cells["sigma_xy"]), tilt / area / 1.5, 1e-6);
    EXPECT_EQ(cells["loose_grains"], "0");
    EXPECT_GT(std::stod(cells["coordination"]), 2.0);
    EXPECT_LE(std::stod(cells["coordination"]), 6.0);
    EXPECT_EQ(cells["unconverged"], "0");
    EXPECT_LT(std::stod(cells["contact_quad"]), 1e-6);
    EXPECT_GE(std::stod(cells["contact_max"]), std::stod(cells["contact_quad"]));
    EXPECT_LT(std::stod(cells["contact_violation"]), 1e-6);
    EXPECT_EQ(row(folder, 1)["coordination"], "") << "no contacts are known at t = 0";
}

TEST(PackingOutputs, TheFloorCarriesTheWeight) {
    const TestFolder folder("lattice-floor");
    run(folder, lattice_settings());
    const std::string text = text_of(folder.path() / "grains/contacts_00000004.vtp");
    const auto walls = numbers(text, "id_a"), forces = numbers(text, "normal_force");
    ASSERT_EQ(walls.size(), forces.size());
    double floor = 0.0, left = 0.0, right = 0.0;
    for (std::size_t k = 0; k < walls.size(); ++k) {
        floor += walls[k] == -3 ? forces[k] : 0.0;
        left += walls[k] == -1 ? forces[k] : 0.0;
        right += walls[k] == -2 ? forces[k] : 0.0;
    }
    EXPECT_NEAR(floor, 18 * weight, 1e-6);
    EXPECT_GT(left, 0.0);
    EXPECT_NEAR(left, right, 1e-6);
    EXPECT_EQ(std::stol(row(folder, 3)["contacts"]), static_cast<long>(walls.size()));
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "grains/contacts_00000003.vtp"))
        << "no output was expected";
}

// One sweep is never enough for this lattice: every window is counted, shown and reported.
TEST(PackingOutputs, UnconvergedWindowsAreNotHidden) {
    const TestFolder folder("lattice-unconverged");
    Settings settings = lattice_settings();
    settings.set("contact.iterations", std::int64_t{1});
    settings.set("limits.penetration", 0.5);
    const RunStatus status = run(folder, settings);
    EXPECT_EQ(status.statistics.maxima.unconverged_windows, 4);
    EXPECT_EQ(row(folder, 2)["unconverged"], "2");
    EXPECT_EQ(row(folder, 3)["unconverged"], "2");
    const auto record = nlohmann::json::parse(text_of(folder.files().record));
    EXPECT_EQ(record["contact"]["unconverged_windows"], 4);
    EXPECT_GT(record["contact"]["residual_p95"], 1e-9);
    EXPECT_GT(record["maxima"]["contact_violation"], 1e-9);
    EXPECT_GE(record["contact"]["residual_max"], record["contact"]["residual_p95"]);
    const std::string log = text_of(folder.files().log);
    EXPECT_NE(log.find("in 4 of 4 windows the contact solver used up its 1 sweeps"),
              std::string::npos)
        << log;
}

TEST(ContactResiduals, QuantilesAreValuesThatOccurred) {
    ContactResiduals residuals;
    ContactReport report;
    residuals.take_in(report);
    EXPECT_TRUE(residuals.empty()) << "an adapter without a residual";
    for (int k = 100; k > 0; --k) {
        report.residual = k;
        residuals.take_in(report);
    }
    EXPECT_EQ(residuals.quantile(0.95), 95.0);
    EXPECT_EQ(residuals.quantile(1.0), 100.0);
    EXPECT_EQ(residuals.quantile(0.001), 1.0);
    EXPECT_EQ(residuals.largest(), 100.0);
    report.residual = std::nan("");
    residuals.take_in(report);
    EXPECT_TRUE(std::isinf(residuals.largest())) << "worse than any number";
    EXPECT_EQ(residuals.quantile(0.95), 96.0);
}

}  // namespace
}  // namespace turbidite
