// SPDX-License-Identifier: GPL-3.0-or-later
//
// The programs of the shipped cases (OpenFOAM, YADE with the contact engine, `joint`) on a bed
// whose weight is carried by contacts: a column of 102 discs slumps in a box only slightly wider
// than itself and comes to rest. Pores are open (hydrodynamic radius 0.85 R), so that water can
// leave them and the bed comes to rest; with closed pores it creeps (docs/splittings.md).
#include <cmath>

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const the_case = R"(
domain: {size: [11.5, 11.5]}
grains:
  adapter: yade-nscd
  generator: lattice
  region: [10, 10.5]
  compacity: 0.85
  jitter: 0.001
  density_ratio: 1.5
fluid: {reynolds: 36, cells_per_diameter: 8, hydrodynamic_radius: 0.85}
contact: {friction: 0.3}
coupling: {scheme: joint}
scales: {kind: avalanche}
time: {step: 0.0125, end: 40}
output: {interval: 0.25}
)";

constexpr double grains = 102;
/// Rows of the history per t_c.
constexpr std::size_t rows_per_time = 4;

class BedUnderJoint : public ShellTest {
 protected:
    Columns play(const std::string& changes = {}) {
        scratch.write("case.yaml", the_case);
        const Answer answer =
            shell(std::string(TURBIDITE_PROGRAM) + " run case.yaml --force --out run" + changes);
        EXPECT_EQ(answer.code, 0) << changes << answer.out << answer.err;
        return columns_of(text(run_folder() / "history.csv"));
    }

    /// Checks the momentum of grains and fluid, the overlap, and that everything was solved.
    void expect_sound() const {
        const nlohmann::json maxima = record().at("maxima");
        EXPECT_LT(maxima.at("penetration").get<double>(), 1e-4);  // D
        EXPECT_LT(maxima.at("grain_balance").get<double>(), 1e-12);
        EXPECT_LT(maxima.at("fluid_balance").get<double>(), 1e-10);
        EXPECT_EQ(maxima.at("unconverged_joint_windows"), 0);
    }
};

double smallest_after(const std::vector<double>& column, std::size_t row) {
    return *std::min_element(column.begin() + static_cast<std::ptrdiff_t>(row), column.end());
}

TEST_F(BedUnderJoint, SlumpsThroughItsContactsAndComesToRest) {
    const Columns history = play();
    ASSERT_EQ(history.at("time").size(), 1 + 40 * rows_per_time);
    expect_sound();
    EXPECT_EQ(smallest_after(history.at("grains"), 0), grains);
    EXPECT_GT(smallest_after(history.at("contacts"), rows_per_time), 1.3 * grains);
    // Moving at first: water leaves the pores and the column sinks by half a diameter.
    EXPECT_GT(largest(history.at("mean_velocity_y")), 0.05);
    EXPECT_LT(history.at("mean_position_y").back(), history.at("mean_position_y").front() - 0.5);
    // Then at rest, on contacts that carry it.
    EXPECT_LT(history.at("mean_speed").back(), 1e-3);
    EXPECT_LT(history.at("kinetic_energy").back(), 1e-6);
    EXPECT_GT(history.at("contacts").back(), 1.6 * grains);
    EXPECT_LE(record().at("maxima").at("unconverged_windows").get<int>(), 5);
}

/// Hundreds of contacts couple all grains: differences in rounding between numbers of ranks are
/// amplified up to contact.tolerance (measured on two ranks: 3e-11 at 0.5 t_c, 3e-8 at 0.75, 1e-4
/// at 1.25).
TEST_F(BedUnderJoint, OnTwoFluidRanksItIsTheSameBed) {
    const std::string start = " --set time.end=1.25 --set fluid.multiplier_tolerance=1e-9";
    const Columns one = play(start + " --set fluid.ranks=1");
    const Columns two = play(start + " --set fluid.ranks=2");
    EXPECT_TRUE(std::filesystem::exists(run_folder() / "fluid/processor1"));
    expect_sound();
    ASSERT_EQ(two.at("time").size(), one.at("time").size());
    EXPECT_GT(one.at("contacts").back(), 1.3 * grains);
    // The ranks' common boundary is at half the height, and is crossed by discs that touch discs on
    // either side.
    const std::vector<double> xyz = centres("00000100");
    ASSERT_EQ(xyz.size(), 3 * static_cast<std::size_t>(grains));
    std::size_t across = 0;
    for (std::size_t y = 1; y < xyz.size(); y += 3) across += std::abs(xyz[y] - 5.75) < 0.5 ? 1 : 0;
    EXPECT_GE(across, 8u);
    for (const char* column : {"mean_velocity_x", "mean_velocity_y", "mean_speed",
                               "mean_position_x", "mean_position_y"}) {
        const std::size_t early = 2;  // 0.5 t_c
        EXPECT_GT(one.at("contacts")[early], 0.5 * grains);
        EXPECT_NEAR(one.at(column)[early], two.at(column)[early], 1e-7) << column;
        EXPECT_LT(largest_difference(one.at(column), two.at(column)), 1e-3) << column;
    }
}

}  // namespace
}  // namespace turbidite
