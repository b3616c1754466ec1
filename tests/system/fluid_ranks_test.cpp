// SPDX-License-Identifier: LGPL-2.1-or-later
//
// One case on one fluid rank and on several: a column of touching discs that slumps, rolls and
// presses on itself across the ranks' boundaries, over 200 windows with up to 39 contacts.
//
// Multipliers stop at 1e-9 u_c. The final positions of grains then differ by up to 1e-9 D, the last
// digit written (measured for both kinds of points, closed, cyclic and free sides, two to four
// ranks, split along x or y), and u by up to 3e-9 u_c. Without the margin by which grains are sent
// to ranks beyond their boxes, the run fails in its first window.

#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

namespace fs = std::filesystem;

const char* const the_case = R"(
domain: {size: [8, 8]}
grains:
  adapter: standalone-nscd
  generator: lattice
  region: [5, 5.5]
  compacity: 0.85
  jitter: 0.001
  density_ratio: 1.5
fluid: {reynolds: 36, cells_per_diameter: 8, multiplier_tolerance: 1e-9}
contact: {friction: 0.3, tolerance: 1e-9}
coupling: {scheme: split}
scales: {kind: avalanche}
time: {step: 0.0125, end: 2.5}
output: {interval: 2.5}
)";

constexpr std::size_t grains = 24;

class FluidRanks : public ShellTest {
 protected:
    /// Runs the case and returns the numbers of a grains file's `Points` at the end.
    std::vector<double> places(const std::string& changes) {
        scratch.write("case.yaml", the_case);
        const Answer answer = shell(std::string(TURBIDITE_PROGRAM) +
                                    " run case.yaml --force --out run --set " + changes);
        EXPECT_EQ(answer.code, 0) << changes << answer.out << answer.err;
        if (answer.code != 0) return {};
        EXPECT_EQ(record().at("windows_done"), 200);
        EXPECT_LT(record().at("maxima").at("grain_balance").get<double>(), 1e-12) << changes;
        EXPECT_LT(record().at("maxima").at("fluid_balance").get<double>(), 1e-10) << changes;
        EXPECT_GT(columns_of(text(run_folder() / "history.csv")).at("contacts").back(), grains);
        return centres("00000200");
    }

    void expect_the_same(const std::vector<double>& one, const std::vector<double>& several,
                         const std::string& which) {
        ASSERT_EQ(one.size(), 3 * grains);
        ASSERT_EQ(several.size(), one.size()) << which;
        EXPECT_LT(largest_difference(one, several), 1e-8) << which;  // D
    }

    /// Two ranks above each other and side by side, with these changes; returns the places of one.
    std::vector<double> expect_two_ranks_the_same(const std::string& changes) {
        const std::vector<double> one = places("fluid.ranks=1" + changes);
        expect_the_same(one, places("fluid.ranks=2" + changes), "rows");
        expect_the_same(one, places("fluid.ranks=2 --set fluid.decomposition=columns" + changes),
                        "columns");
        return one;
    }
};

TEST_F(FluidRanks, RowsAndColumnsAndAnyNumberGiveTheHistoryOfOneRank) {
    const std::vector<double> one = places("fluid.ranks=1");
    for (const char* several :
         {"fluid.ranks=2", "fluid.ranks=4", "fluid.ranks=3 --set fluid.decomposition=columns"})
        expect_the_same(one, places(several), several);
    EXPECT_TRUE(fs::exists(run_folder() / "fluid/processor2/2.5/U"));
    EXPECT_FALSE(fs::exists(run_folder() / "report.html"));
    shell(std::string(TURBIDITE_PROGRAM) + " report " + run_folder().string());
    EXPECT_SAYS(text(run_folder() / "report.html"), "Colour: vertical velocity of the fluid");
}

TEST_F(FluidRanks, WithoutBoundaryPoints) {
    const std::string interior = " --set fluid.points=interior";
    expect_the_same(places("fluid.ranks=1" + interior), places("fluid.ranks=2" + interior),
                    "interior points");
}

TEST_F(FluidRanks, CyclicSidesAndOpenOnes) {
    const std::string sides =
        " --set domain.left=cyclic --set domain.right=cyclic --set domain.top=free";
    expect_two_ranks_the_same(sides);
}

/// Fluid enters through the bottom and the right, with profiles that cross the ranks' borders, and
/// the left wall slides.
TEST_F(FluidRanks, SidesThatMove) {
    const std::string sides =
        " --set domain.top=free --set domain.bottom=inflow --set domain.right=inflow"
        " --set domain.bottom_profile=parabolic --set domain.right_profile=parabolic"
        " --set domain.bottom_motion=up --set domain.motions.up.kind=constant"
        " --set domain.motions.up.velocity=[0,0.2]"
        " --set domain.right_motion=in --set domain.motions.in.kind=harmonic"
        " --set domain.motions.in.amplitude=[-0.2,0.1] --set domain.motions.in.period=6"
        " --set domain.left_motion=up";
    const std::vector<double> one = expect_two_ranks_the_same(sides);
    EXPECT_GT(largest_difference(one, places("fluid.ranks=1 --set domain.top=free")), 1e-3)
        << "the sides do not move the grains";
}

// A rank with grains has more work per row, and fewer rows.
TEST_F(FluidRanks, AreCutByWork) {
    const std::string high = " --set domain.size=[8,16]";
    const std::vector<double> one = places("fluid.ranks=1" + high);
    expect_the_same(one, places("fluid.ranks=2" + high), "cut by work");
    const auto cells_of = [&](const std::string& rank) {
        // The number of values in the first list of a field: its cells.
        const std::string field = text(run_folder() / "fluid" / rank / "2.5/U");
        const std::size_t list = field.find("List<vector>");
        return std::stoi(field.substr(field.find_first_of("0123456789", list)));
    };
    const int lower = cells_of("processor0"), upper = cells_of("processor1");
    EXPECT_EQ(lower + upper, 64 * 128);
    EXPECT_LT(lower, 0.8 * upper);
    EXPECT_GT(lower, 0.3 * upper);
}

/// Rows that grow above the column, so many that the ranks do not have as many each.
TEST_F(FluidRanks, WithStretchedRows) {
    const std::string stretched =
        " --set domain.size=[8,12] --set fluid.stretch_ratio=1.07 --set fluid.stretch_from=6.5"
        " --set domain.top=free";
    const std::vector<double> one = expect_two_ranks_the_same(stretched);
    expect_the_same(one, places("fluid.ranks=3" + stretched), "three ranks");
}

/// OpenFOAM's own solvers, to their tolerance: 1e-12 of a residual norm.
TEST_F(FluidRanks, WithOpenFoamsSolvers) {
    const std::string matrix =
        " --set fluid.pressure_solver=GAMG --set fluid.viscous_solver=PCG"
        " --set fluid.pressure_tolerance=1e-12 --set fluid.viscous_tolerance=1e-12";
    expect_the_same(places("fluid.ranks=1" + matrix), places("fluid.ranks=2" + matrix), "GAMG");
}

/// The paper's transport in one step, where the default has stages.
TEST_F(FluidRanks, WithFirstOrderInTime) {
    const std::string first =
        " --set fluid.time_scheme=first-order --set "
        "'fluid.transport_scheme=Gauss limitedLinearV 1'";
    const std::vector<double> one = expect_two_ranks_the_same(first);
    EXPECT_GT(largest_difference(one, places("fluid.ranks=1")), 1e-6) << "is not the default";
}

TEST_F(FluidRanks, MoreRanksThanTheBoxHasRoomForAreRefused) {
    scratch.write("case.yaml", the_case);
    const Answer answer =
        shell(std::string(TURBIDITE_PROGRAM) + " check case.yaml --set fluid.ranks=17");
    EXPECT_EQ(answer.code, 2);
    for (const char* said : {"fluid.ranks = 17", "4 rows", "Use 16 or fewer"})
        EXPECT_SAYS(answer.err, said);
}

}  // namespace
}  // namespace turbidite
