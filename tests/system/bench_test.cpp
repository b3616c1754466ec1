// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `turbidite bench --quick`: every contender runs and every figure is produced; their values are
// not tested.
#include <cmath>

#include "tests/system/program.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class Bench : public ShellTest {
 protected:
    Answer bench(const std::string& arguments) const {
        return shell(program + " bench " + arguments);
    }
};

TEST_F(Bench, QuickGivesEveryFigure) {
    const Answer answer = bench("fluid --quick --json figures.json");
    const auto figures = nlohmann::json::parse(text(scratch.path() / "figures.json"));
    for (const char* name : {"icofoam_over_ours_2d",
                             "ours_over_array_code",
                             "cell_cost_growth",
                             "speedup_2_ranks",
                             "joint_window_d16",
                             "second_over_first_order",
                             "joint_speedup_2_ranks",
                             "explicit_over_plain",
                             "implicit_over_plain",
                             "implicit_over_plain_loose",
                             "avalanche_window_d16",
                             "bytes_per_cell",
                             "icofoam_over_ours_3d",
                             "cells_space_over_plane",
                             "cell_cost_growth_space",
                             "bytes_per_cell_space",
                             "bytes_per_cell_space_box",
                             "explicit_over_plain_space",
                             "fluid_speedup_2_ranks_space",
                             "coupling_share_space"}) {
        ASSERT_TRUE(figures.contains(name)) << answer.err;
        const auto& figure = figures.at(name);
        ASSERT_TRUE(figure.at("value").is_number()) << figure << answer.err;
        EXPECT_TRUE(std::isfinite(figure.at("value").get<double>())) << figure;
        EXPECT_GT(figure.at("value").get<double>(), 0.0) << figure;
        EXPECT_FALSE(figure.at("unit").get<std::string>().empty());
        EXPECT_SAYS(figure.at("command").get<std::string>(), std::string("--figure ") + name);
        EXPECT_SAYS(answer.out, name);
    }
    EXPECT_EQ(answer.code, 0) << answer.err;
}

TEST_F(Bench, QuickGivesEveryFigureOfTheContactSolver) {
    const Answer answer = bench("contact --quick --json figures.json");
    EXPECT_EQ(answer.code, 0) << answer.err;
    const auto figures = nlohmann::json::parse(text(scratch.path() / "figures.json"));
    for (const char* name : {"contact_rate_1397", "contact_rate_50000", "contact_rate_spheres",
                             "contact_cost_growth", "grains_speedup_2_ranks"}) {
        ASSERT_TRUE(figures.contains(name)) << answer.err;
        ASSERT_TRUE(figures.at(name).at("value").is_number()) << figures.at(name) << answer.err;
        EXPECT_GT(figures.at(name).at("value").get<double>(), 0.0);
    }
}

TEST_F(Bench, QuickGivesEveryFigureOfTheCoupling) {
    const Answer answer = bench("coupling --quick --json figures.json");
    EXPECT_EQ(answer.code, 0) << answer.err;
    const auto figures = nlohmann::json::parse(text(scratch.path() / "figures.json"));
    for (const char* name : {"added_microseconds_1400", "coupling_share_d16", "over_plain_mpi_1e6",
                             "waiting_cpu_percent", "hub_growth_32_ranks"}) {
        ASSERT_TRUE(figures.contains(name)) << answer.err;
        ASSERT_TRUE(figures.at(name).at("value").is_number()) << figures.at(name) << answer.err;
        EXPECT_GT(figures.at(name).at("value").get<double>(), 0.0);
    }
}

TEST_F(Bench, ListNamesAllAndMeasuresNothing) {
    const Answer answer = bench("--list");
    EXPECT_EQ(answer.code, 0) << answer.err;
    for (const char* name :
         {"fluid:", "icofoam_over_ours_2d", "ours_over_array_code", "cell_cost_growth",
          "speedup_2_ranks", "bytes_per_cell", "contact:", "contact_rate_1397",
          "contact_cost_growth", "coupling:", "over_plain_mpi_1e6"})
        EXPECT_SAYS(answer.out, name);
}

TEST_F(Bench, UnknownNamesAreRefused) {
    const Answer benchmark = bench("solid");
    EXPECT_EQ(benchmark.code, 2);
    EXPECT_SAYS(benchmark.err, "there are fluid, contact");
    const Answer figure = bench("fluid --figure speed");
    EXPECT_EQ(figure.code, 2);
    EXPECT_SAYS(figure.err, "speedup_2_ranks");
}

TEST_F(Bench, AContenderThatFailsIsNamedWithTheEndOfItsOutput) {
    scratch.write("bin/icoFoam", "#!/bin/sh\necho 'icoFoam is not well'\nexit 3\n");
    const Answer answer =
        shell("chmod +x bin/icoFoam; PATH=$PWD/bin:$PATH " + program +
              " bench fluid --quick --figure icofoam_over_ours_2d --json figures.json");
    EXPECT_EQ(answer.code, 1);
    EXPECT_SAYS(answer.out, "not available");
    const auto figures = nlohmann::json::parse(text(scratch.path() / "figures.json"));
    const auto& figure = figures.at("icofoam_over_ours_2d");
    EXPECT_TRUE(figure.at("value").is_null());
    EXPECT_SAYS(figure.at("reason").get<std::string>(), "icoFoam is not well");
    EXPECT_SAYS(answer.err, "icoFoam failed with status 3");
    EXPECT_SAYS(answer.err, "icoFoam is not well");
}

}  // namespace
}  // namespace turbidite
