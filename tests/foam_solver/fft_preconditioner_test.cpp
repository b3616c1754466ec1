// SPDX-License-Identifier: GPL-3.0-or-later
//
// `preconditioner FFT;` for variable coefficients. With coefficients between m and M times the mean
// of their axis, kappa = M/m, the error in the norm of A is reduced by q = (sqrt(kappa) -
// 1)/(sqrt(kappa) + 1) per iteration, and the residual after n iterations is below 2 sqrt(cond A)
// q^n of the initial one.
#include "tests/foam_solver/stock_application.hpp"

namespace turbidite {
namespace {

/// Upper bound of the iterations needed for `reduction` of the residual.
int bound(double kappa, double condition, double reduction) {
    const double root = std::sqrt(kappa);
    const double q = (root - 1.0) / (root + 1.0);
    return static_cast<int>(
        std::ceil(std::log(reduction / (2.0 * std::sqrt(condition))) / std::log(q)));
}

std::string pressure_solver(const std::string& entries) {
    return "solvers { p { " + entries +
           " tolerance 1e-10; relTol 0; }\n"
           "pFinal { $p; }\nU { solver PBiCGStab; preconditioner DILU; tolerance 1e-12; relTol 0; "
           "} }\n"
           "PISO { nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 5; pRefValue 0.5; }\n";
}

class LidDrivenCavity : public StockApplication {
 protected:
    struct Outcome {
        std::vector<double> U, p;
        int iterations;
    };

    Outcome flow(const std::string& entries, int ranks = 1) const {
        const std::string flat = "type zeroGradient;", wall = "type noSlip;";
        FoamBox box;
        box.cells = {16, 8};  // 48 x 24 squares of 1/32
        box.control = libs;
        box.solution = pressure_solver(entries);
        write_box(scratch, box, 0.01, 0.2);
        write_field(scratch, box, "p", "[0 2 -2 0 0 0 0]", {flat, flat, flat, flat});
        write_vector_field(scratch, box, "U",
                           {wall, wall, wall, "type fixedValue; value uniform (1 0 0);"});
        make_mesh();
        const Answer answer = run(ranks, "icoFoam");
        return {field("0.2/U"), field("0.2/p"), most_iterations(answer.out, "p")};
    }
};

/// A(U) over its value inside is 1 + d/(1 + 4 d) at a wall, and twice that excess in a corner, with
/// d = nu dt/h2 = 0.1; the contribution of convection is zero for a divergence-free flow: kappa is
/// below 1.2. The smallest eigenvalue of the pressure's matrix is its reference's delta over the
/// number of cells, so cond A = 8 x 1152/2. The residual must fall to 1e-10 from at most 1.
TEST_F(LidDrivenCavity, TakesTheIterationsThatTheWallRowsCostAndNoMore) {
    const Outcome direct = flow("solver PCG; preconditioner FFT;");
    const Outcome reference = flow("solver GAMG; smoother DIC;");
    const Outcome plain = flow("solver PCG; preconditioner DIC;");
    EXPECT_LE(direct.iterations, bound(1.2, 8 * 1152 / 2, 1e-10));
    EXPECT_GT(plain.iterations, 5 * direct.iterations);
    // 1e-10 of the norm, below 10, times the inverse of the smallest eigenvalue over dt, 40 steps.
    EXPECT_LT(largest_difference(direct.U, reference.U), 1e-6);
    EXPECT_LT(largest_difference(direct.p, reference.p), 1e-6);
}

TEST_F(LidDrivenCavity, TakesAsManyIterationsOnSeveralRanks) {
    const std::string entries = "solver PCG; preconditioner FFT;";
    const Outcome one = flow(entries);
    write_decomposition(scratch, {2, 1});
    const Outcome two = flow(entries, 2);
    EXPECT_LE(two.iterations, one.iterations + 1);
    EXPECT_LT(largest_difference(one.U, two.U), 1e-8);
}

class PreconditionedDiffusion : public StockApplication {
 protected:
    struct Outcome {
        std::vector<double> T;
        int iterations;
    };

    Outcome at_rest(FoamBox box, const Sides& sides, const std::string& entries) const {
        box.control = libs;
        box.ddt = "steadyState";
        box.solution = solver_of("T", entries + " relTol 0;");
        write_box(scratch, box, 1.0, 1.0);
        write_field(scratch, box, "T", "[0 0 0 1 0 0 0]", sides);
        make_mesh();
        const Answer answer = run("laplacianFoam");
        return {field("1/T"), most_iterations(answer.out, "T")};
    }
    const std::string fft = "solver PCG; preconditioner FFT; tolerance 1e-12;";
    const std::string dic = "solver PCG; preconditioner DIC; tolerance 1e-14;";
    const std::string flat = "type zeroGradient;", one = "type fixedValue; value uniform 1;",
                      two = "type fixedValue; value uniform 2;";
};

/// Cells twice as long in one third and half as long in another: coefficients in the ratio 1 : 4
/// along x, and proportional to the length along y. The smallest eigenvalue is above 1/600 of the
/// largest on 24 x 18 cells, and the grading costs another factor of 4.
TEST_F(PreconditionedDiffusion, AGradedMeshCostsTheRatioOfItsCoefficients) {
    FoamBox box;
    box.x = {0.0, 0.5, 0.75, 1.75};
    const Outcome direct = at_rest(box, {one, flat, flat, two}, fft);
    EXPECT_LE(direct.iterations, bound(16.0, 2400.0, 1e-12));
    EXPECT_LT(largest_difference(direct.T, at_rest(box, {one, flat, flat, two}, dic).T), 1e-8);
}

/// Only a third of one side holds a value, so that constants are free in the nearest separable
/// problem but not in the matrix.
TEST_F(PreconditionedDiffusion, ASideOfTwoConditionsConverges) {
    FoamBox box;
    box.lower_left = one;
    const Sides sides = {flat, "type fixedGradient; gradient uniform 0.7;", flat, flat};
    const Outcome direct = at_rest(box, sides, fft);
    const Outcome reference = at_rest(box, sides, dic);
    EXPECT_LT(largest_difference(direct.T, reference.T), 1e-8);
    EXPECT_LT(direct.iterations, reference.iterations);
}

/// On a separable matrix the inverse is exact: one iteration.
TEST_F(PreconditionedDiffusion, ASeparableMatrixTakesOneIteration) {
    EXPECT_LE(at_rest(FoamBox(), {one, flat, flat, two},
                      "solver PCG; preconditioner FFT; tolerance 1e-10;")
                  .iterations,
              1);
}

}  // namespace
}  // namespace turbidite
