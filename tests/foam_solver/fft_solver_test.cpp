// SPDX-License-Identifier: GPL-3.0-or-later
//
// `solver FFT;` in laplacianFoam and potentialFoam against their PCG.
//
// PCG stops at 1e-14 of its norm, which is below 200 c for values of order one, and the inverse of
// the smallest eigenvalue is below 300/c on 24 x 18 cells: the error of PCG is below 1e-9. A wrong
// equation of a cell next to a side causes an error of 1e-2.
#include "tests/foam_solver/stock_application.hpp"

namespace turbidite {
namespace {

constexpr double agreement = 1e-9;
const std::string pcg = "solver PCG; preconditioner DIC; tolerance 1e-14; relTol 0;";
const std::string fft = "solver FFT; tolerance 1e-9; relTol 0;";

const std::string slope = "type fixedGradient; gradient uniform 0.7;";
const std::string flat = "type zeroGradient;";
std::string held(const std::string& value) {
    return "type fixedValue; value uniform " + value + ";";
}

struct Conditions {
    const char* name;
    Sides sides;
    bool cyclic_x, cyclic_y;
    bool steady;  // whether it has a solution without a time derivative
};

void PrintTo(const Conditions& conditions, std::ostream* out) {
    *out << conditions.name;
}

const Conditions all_conditions[] = {
    {"closed", {flat, flat, flat, flat}, false, false, false},
    {"held", {held("1"), held("-0.5"), held("0"), held("2")}, false, false, true},
    {"mixed", {held("1"), slope, flat, held("2")}, false, false, true},
    {"mixedTheOtherWay", {flat, held("1"), held("0"), slope}, false, false, true},
    {"channel", {"", "", held("1"), held("0")}, true, false, true},
    {"halfOpenChannel", {"", "", slope, held("0")}, true, false, true},
    {"chimney", {slope, held("1"), "", ""}, false, true, true},
    {"cyclic", {"", "", "", ""}, true, true, false},
};

FoamBox box_with(const Conditions& conditions) {
    FoamBox box;
    if (conditions.cyclic_x) box.patches[0] = box.patches[1] = "cyclic";
    if (conditions.cyclic_y) box.patches[2] = box.patches[3] = "cyclic";
    return box;
}

/// Values without any order or symmetry.
std::vector<double> some_values(int count) {
    std::vector<double> values(count);
    for (int c = 0; c < count; ++c) values[c] = std::sin(3.7 * c * c + 1.0);
    return values;
}

class FftSolver : public StockApplication, public testing::WithParamInterface<Conditions> {
 protected:
    struct Outcome {
        std::vector<double> T;
        std::string log;
    };

    /// Three steps of laplacianFoam.
    Outcome diffused(FoamBox box, const Sides& sides, const std::string& solver,
                     int ranks = 1) const {
        box.control = libs;
        box.solution = solver_of("T", solver);
        write_box(scratch, box, 0.01, 0.03);
        write_field(scratch, box, "T", "[0 0 0 1 0 0 0]", sides, some_values(box.cell_count()));
        make_mesh();
        const Answer answer = run(ranks, "laplacianFoam");
        return {field("0.03/T"), answer.out};
    }
};

TEST_P(FftSolver, EqualsPcgInTime) {
    const FoamBox box = box_with(GetParam());
    const Outcome direct = diffused(box, GetParam().sides, fft);
    EXPECT_SAYS(direct.log, "FFT:  Solving for T");
    EXPECT_EQ(iterations(direct.log, "T"), std::vector<int>(3, 1));
    // Rounding of 5 terms, not the 1e-9 of the tolerance.
    EXPECT_LT(worst_residual(direct.log, "T"), 1e-13);
    EXPECT_LT(largest_difference(direct.T, diffused(box, GetParam().sides, pcg).T), agreement);
}

TEST_P(FftSolver, EqualsPcgAtRest) {
    if (!GetParam().steady) return;
    FoamBox box = box_with(GetParam());
    box.ddt = "steadyState";
    const Outcome direct = diffused(box, GetParam().sides, fft);
    EXPECT_LT(largest_difference(direct.T, diffused(box, GetParam().sides, pcg).T), agreement);
    // The second and third step start from the solution.
    EXPECT_EQ(iterations(direct.log, "T"), (std::vector<int>{1, 0, 0}));
}

/// Ranks with complete rows, with none, and with partial rows. blockMesh numbers block by block, so
/// that on no rank are the cells in the order of the box.
TEST_P(FftSolver, EqualsPcgOnSeveralRanks) {
    FoamBox box = box_with(GetParam());
    const std::vector<double> reference = diffused(box, GetParam().sides, pcg).T;
    for (const std::array<int, 2>& ranks : {std::array<int, 2>{1, 2}, {2, 1}, {2, 2}}) {
        write_decomposition(scratch, ranks);
        const Outcome direct = diffused(box, GetParam().sides, fft, ranks[0] * ranks[1]);
        EXPECT_EQ(iterations(direct.log, "T"), std::vector<int>(3, 1));
        EXPECT_LT(worst_residual(direct.log, "T"), 1e-13);
        EXPECT_LT(largest_difference(direct.T, reference), agreement);
    }
}

INSTANTIATE_TEST_SUITE_P(Conditions, FftSolver, testing::ValuesIn(all_conditions),
                         [](const auto& info) { return std::string(info.param.name); });

/// Flow through a box: the potential is determined only by its reference.
class Reference : public StockApplication {
 protected:
    std::vector<double> potential(const std::string& solver, int ranks = 1) const {
        FoamBox box;
        box.control = libs;
        box.solution =
            solver_of("Phi", solver) + "potentialFlow { PhiRefCell 77; PhiRefValue 3.25; }\n";
        write_box(scratch, box, 1.0, 1.0);
        write_field(scratch, box, "p", "[0 2 -2 0 0 0 0]", {flat, flat, flat, flat});
        write_vector_field(
            scratch, box, "U",
            {held("(1 0 0)"), held("(1 0 0)"), held("(0 0.5 0)"), held("(0 0.5 0)")});
        make_mesh();
        std::filesystem::remove(scratch.path() / "0/Phi");
        run(ranks, "potentialFoam -writePhi -initialiseUBCs");
        return field("0/Phi");
    }
};

TEST_F(Reference, TheAnswerHasItsValueAtTheReference) {
    const std::vector<double> direct = potential(fft), reference = potential(pcg);
    EXPECT_NEAR(direct[77], 3.25, 1e-12);
    EXPECT_LT(largest_difference(direct, reference), 1e-8);  // the smallest eigenvalue is delta/N
    const auto [least, most] = std::minmax_element(direct.begin(), direct.end());
    EXPECT_GT(*most - *least, 0.5);
}

/// OpenFOAM puts the reference in one of rank 0's cells, which is another cell here.
TEST_F(Reference, TheAnswerIsTheSameUpToItsLevelOnSeveralRanks) {
    const std::vector<double> one = potential(fft);
    for (const std::array<int, 2>& ranks : {std::array<int, 2>{2, 1}, {2, 2}}) {
        write_decomposition(scratch, ranks);
        std::vector<double> several = potential(fft, ranks[0] * ranks[1]);
        const double level = several[0] - one[0];
        for (double& value : several) value -= level;
        EXPECT_LT(largest_difference(one, several), 1e-9);
    }
}

TEST_F(FftSolver, CoefficientsThatDifferByTheMeshsDigitsAreCorrected) {
    FoamBox box;
    box.x[1] += 1e-6;  // an eighth of it per cell, 2e-6 of its size
    const Sides sides = all_conditions[1].sides;
    const Outcome direct = diffused(box, sides, "solver FFT; tolerance 1e-12; relTol 0;");
    EXPECT_EQ(iterations(direct.log, "T"), std::vector<int>(3, 2));
    EXPECT_LT(largest_difference(direct.T, diffused(box, sides, pcg).T), agreement);
}

/// Rows of different heights: blocks with finer and with coarser rows.
TEST_P(FftSolver, EqualsPcgOnRowsOfDifferentHeights) {
    if (GetParam().cyclic_y) return;
    FoamBox box = box_with(GetParam());
    box.y = {0.0, 0.25, 0.75, 0.9};
    for (const char* ddt : {"Euler", "steadyState"}) {
        if (!GetParam().steady && std::string(ddt) == "steadyState") continue;
        box.ddt = ddt;
        const std::vector<double> reference = diffused(box, GetParam().sides, pcg).T;
        const Outcome direct = diffused(box, GetParam().sides, fft);
        EXPECT_EQ(iterations(direct.log, "T")[0], 1);
        EXPECT_LT(worst_residual(direct.log, "T"), 1e-9);
        EXPECT_LT(largest_difference(direct.T, reference), agreement);
        for (const std::array<int, 2>& ranks : {std::array<int, 2>{1, 2}, {2, 1}}) {
            write_decomposition(scratch, ranks);
            const Outcome several = diffused(box, GetParam().sides, fft, 2);
            EXPECT_LT(largest_difference(several.T, reference), agreement);
        }
    }
}

TEST_F(FftSolver, TheSmallestBoxIsSolved) {
    FoamBox box;
    box.cells = {1, 1};
    const Sides& sides = all_conditions[2].sides;
    EXPECT_LT(largest_difference(diffused(box, sides, fft).T, diffused(box, sides, pcg).T),
              agreement);
}

/// Cases in which the solver must stop with a reason instead of returning a solution.
class Refusal : public StockApplication {
 protected:
    std::string said(FoamBox box, const Sides& sides, const std::string& solver,
                     const std::string& before = "true",
                     const std::string& command = "laplacianFoam") const {
        box.control = libs;
        box.solution = solver_of("T", solver);
        write_box(scratch, box, 0.01, 0.01);
        write_field(scratch, box, "T", "[0 0 0 1 0 0 0]", sides);
        make_mesh();
        EXPECT_EQ(foam(before).code, 0);
        const Answer answer = foam(command);
        EXPECT_NE(answer.code, 0) << answer.out;
        return answer.err + answer.out;
    }
    const Sides sides = {held("1"), flat, flat, held("2")};
    const std::string preconditioned = "solver PCG; preconditioner FFT; tolerance 1e-9; relTol 0;";
};

TEST_F(Refusal, AGradedMeshIsNamedWithItsFirstCoefficient) {
    FoamBox box;
    box.x = {0.0, 0.4, 0.8, 1.5};
    const std::string text = said(box, sides, fft);
    for (const char* part : {"solver FFT", "of T", "coefficients along", "not all equal", "cell ",
                             "column ", "preconditioner FFT", "GAMG"})
        EXPECT_SAYS(text, part);
}

TEST_F(Refusal, RowsOfDifferentHeightsBetweenCyclicSidesAreRefused) {
    FoamBox box;
    box.y = {0.0, 0.25, 0.75, 0.9};
    box.patches[2] = box.patches[3] = "cyclic";
    EXPECT_SAYS(said(box, sides, fft), "are not all equal");
}

TEST_F(Refusal, AMeshGradedBothWaysIsRefused) {
    FoamBox box;
    box.x = {0.0, 0.4, 0.8, 1.5};
    box.y = {0.0, 0.25, 0.75, 0.9};
    EXPECT_SAYS(said(box, sides, fft), "do not fit rows of cells");
}

TEST_F(Refusal, ASideOfTwoConditionsIsNamedWithItsCell) {
    FoamBox box;
    box.lower_left = flat;
    const std::string text = said(box, sides, fft);
    for (const char* part : {"diagonal at cell ", "side with a single condition"})
        EXPECT_SAYS(text, part);
}

TEST_F(Refusal, AMeshWithAHoleIsRefusedByBoth) {
    FoamBox box;
    box.hole = true;
    for (const std::string& solver : {fft, preconditioned})
        EXPECT_SAYS(said(box, sides, solver), "hole");
}

TEST_F(Refusal, SeveralLayersOfCellsAreRefusedByBoth) {
    FoamBox box;
    box.layers = 2;
    for (const std::string& solver : {fft, preconditioned})
        EXPECT_SAYS(said(box, sides, solver), "one layer of cells");
}

/// The verdict and its text are the same on all ranks, so that none waits for another.
TEST_F(Refusal, AGradedMeshIsRefusedBySeveralRanksTogether) {
    write_decomposition(scratch, {2, 1});
    FoamBox box;
    box.x = {0.0, 0.4, 0.8, 1.5};
    const std::string text = said(box, sides, fft, "decomposePar", on_ranks(2, "laplacianFoam"));
    for (const char* part : {"not all equal", "cell ", "of processor", "preconditioner FFT"})
        EXPECT_SAYS(text, part);
}

TEST_F(Refusal, AMeshWithAHoleIsRefusedBySeveralRanksTogether) {
    write_decomposition(scratch, {2, 2});
    FoamBox box;
    box.hole = true;
    EXPECT_SAYS(said(box, sides, preconditioned, "decomposePar", on_ranks(4, "laplacianFoam")),
                "hole");
}

}  // namespace
}  // namespace turbidite
