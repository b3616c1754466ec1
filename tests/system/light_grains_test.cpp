// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Grains as light as the fluid and lighter, under `joint`.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const one_disc = R"(
domain: {size: [6, 6]}
grains: {adapter: standalone-nscd, file: disc.csv}
fluid: {reynolds: 100, cells_per_diameter: 16}
coupling: {scheme: joint}
time: {step: 0.005, end: 0.08}
output: {interval: 0.04}
)";

const char* const a_cloud = R"(
domain: {size: [5, 6]}
grains: {adapter: standalone-nscd, count: 7, region: [5, 2.5], density_ratio: 0.5}
fluid: {reynolds: 150, cells_per_diameter: 8, hydrodynamic_radius: 0.85}
coupling: {scheme: joint}
time: {step: 0.01, end: 80}
output: {interval: 1}
)";

class LightGrains : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("disc.csv", "id,x,y\n1,3,3\n");
        scratch.write("disc.yaml", one_disc);
        scratch.write("cloud.yaml", a_cloud);
    }

    Columns history(const std::string& arguments) const {
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) + " run " + arguments +
                                    into_run_folder() + " --force");
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        return columns_of(text(run_folder() / "history.csv"));
    }
};

// In an ideal fluid at rest a disc starts with dU/dt = (1 - rho_r)/(1 + rho_r) g: the mass of the
// fluid it displaces is added to its own. Viscosity takes up to a tenth of it by 0.08 t_c.
TEST_F(LightGrains, StartWithTheAddedMassOfAnIdealFluid) {
    for (const double ratio : {0.4, 0.5, 0.9, 1.1}) {
        const Columns run =
            history("disc.yaml --set grains.density_ratio=" + std::to_string(ratio));
        const double ideal = (1.0 - ratio) / (1.0 + ratio) * run.at("time").back();
        EXPECT_NEAR(run.at("mean_velocity_y").back() / ideal, 0.95, 0.06) << ratio;
        EXPECT_LT(run.at("grain_balance").back(), 1e-10) << ratio;
    }
}

TEST_F(LightGrains, OfTheFluidsDensityStayWhereTheyAre) {
    const Columns run = history("disc.yaml --set grains.density_ratio=1");
    EXPECT_EQ(run.at("mean_speed").back(), 0.0);
    EXPECT_EQ(run.at("mean_position_y").back(), 3.0);
}

// What sinks at 1.5 rises at 0.5: the cloud leaves the floor and comes to rest under the top.
TEST_F(LightGrains, RiseAndComeToRestUnderTheTop) {
    const Columns run = history("cloud.yaml");
    EXPECT_LT(run.at("mean_position_y").front(), 2.5);
    EXPECT_GT(run.at("mean_position_y").back(), 4.5);
    EXPECT_GT(run.at("contacts").back(), 10.0);
    EXPECT_LT(run.at("mean_speed").back(), 1e-3);
    EXPECT_LT(record().at("maxima").at("penetration").get<double>(), 1e-4);
    EXPECT_LT(record().at("maxima").at("grain_balance").get<double>(), 1e-10);
    EXPECT_LT(record().at("maxima").at("fluid_balance").get<double>(), 1e-6);
}

}  // namespace
}  // namespace turbidite
