// SPDX-License-Identifier: GPL-3.0-or-later
//
// The direct solvers of pressure and viscosity against OpenFOAM's iterative ones: the same windows
// with discs that fall, rotate and collide, in boxes with every type of side.
//
// The iterative solvers stop at 1e-11 of their residual norms, and the multipliers, in both runs,
// at 1e-9 u_c. After 20 windows the difference is below 1e-8 u_c, while a wrong equation of a cell
// next to any side causes 1e-2.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr Sides all_sides[] = {
    {"closed", "wall", "wall", "wall", "wall"},
    {"freeRightAndTop", "wall", "free", "wall", "free"},
    {"freeLeft", "free", "wall", "wall", "wall"},
    {"channel", "cyclic", "cyclic", "wall", "wall"},
    {"chimney", "wall", "wall", "cyclic", "cyclic"},
    {"cyclic", "cyclic", "cyclic", "cyclic", "cyclic"},
};

CoupledSetup box_with(const Sides& sides) {
    CoupledSetup setup = with_sides(sides);
    setup.width = 5.0;  // 80 x 64 cells
    setup.reynolds = 36.0;
    setup.gravity = 11.86;
    setup.tolerance = 1e-9;
    return setup;
}

CoupledSetup iterative(CoupledSetup setup) {
    setup.pressure_solver = "GAMG";
    setup.viscous_solver = "PCG";
    setup.pressure_tolerance = setup.viscous_tolerance = 1e-11;
    return setup;
}

std::vector<GrainState> some_discs(const CoupledSetup& setup) {
    return {disc_at(setup, 1.13, 1.02, 0.3, -0.2), disc_at(setup, 2.47, 2.2, -0.4, 0.1),
            disc_at(setup, 3.61, 1.33), disc_at(setup, 1.41, 3.283, 0.2, -0.5),
            disc_at(setup, 1.472, 2.28, 0.2)};
}

/// max |difference| of a quantity over all cells of two runs.
double largest_difference(CoupledRun& a, CoupledRun& b,
                          const std::function<double(const FoamAdapter&, int, int)>& value) {
    double largest = 0.0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 80; ++i)
            largest = std::max(largest, std::abs(value(a.fluid(), i, j) - value(b.fluid(), i, j)));
    return largest;
}

double speed_x(const FoamAdapter& fluid, int i, int j) {
    return fluid.velocity(i, j)[0];
}
double speed_y(const FoamAdapter& fluid, int i, int j) {
    return fluid.velocity(i, j)[1];
}
double pressure(const FoamAdapter& fluid, int i, int j) {
    return fluid.pressure(i, j);
}

class DirectSolvers : public testing::TestWithParam<Sides> {};

TEST_P(DirectSolvers, AgreeWithTheIterativeOnes) {
    const CoupledSetup setup = box_with(GetParam());
    CoupledRun direct(setup, some_discs(setup));
    CoupledRun reference(iterative(setup), some_discs(setup));
    double fastest = 0.0;
    for (int n = 0; n < 20; ++n) {
        direct.advance();
        reference.advance();
        // Rounding: eps u_c/h is 4e-15 u_c/D, of terms that cancel in a cell.
        EXPECT_LT(direct.answer().report.divergence, 1e-12);
        EXPECT_LT(direct.answer().report.momentum_defect, 1e-9);
    }
    EXPECT_LT(largest_difference(direct, reference, speed_x), 1e-8);
    EXPECT_LT(largest_difference(direct, reference, speed_y), 1e-8);
    // p dt is a velocity times a length: an error of 1e-8 in u over the box is 1e-8 5/dt in p.
    EXPECT_LT(largest_difference(direct, reference, pressure), 1e-8 * 5.0 / setup.step);
    for (std::size_t g = 0; g < direct.grains().size(); ++g) {
        const Vec3& one = direct.grains()[g].velocity;
        const Vec3& other = reference.grains()[g].velocity;
        for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR(one[axis], other[axis], 1e-8);
        fastest = std::max(fastest, std::abs(one[1]));
    }
    EXPECT_GT(fastest, 0.1);  // the discs move
    EXPECT_GE(direct.contacts(),
              10);  // and collide: the second disc reaches the fifth in about four windows
}

INSTANTIATE_TEST_SUITE_P(Sides, DirectSolvers, testing::ValuesIn(all_sides),
                         [](const auto& info) { return std::string(info.param.name); });

void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to) {
    std::ifstream in(file);
    std::string text{std::istreambuf_iterator<char>(in), {}};
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from << " not in\n" << text;
    std::ofstream(file) << text.replace(at, from.size(), to);
}

/// The message with which a case is refused after these words have been replaced.
std::string refusal(const CoupledSetup& setup, const char* file, const std::string& from,
                    const std::string& to) {
    const TemporaryFolder folder;
    write_fluid_case(settings_of(setup), folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    replace_in(folder.path() / file, from, to);
    FoamAdapter fluid(folder.path());
    try {
        fluid.initialise(settings_of(setup), {ShapeRecord{"disc", {}}});
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_input);
        return failure.what();
    }
    return "accepted";
}

TEST(DirectSolversRefusal, ConditionsThatSwitchPerFaceAreNamed) {
    CoupledSetup setup = box_with(all_sides[1]);
    const std::string said = refusal(setup, "0/U", "type zeroGradient;",
                                     "type inletOutlet; inletValue uniform (0 0 0);");
    for (const char* expected : {"fluid.viscous_solver", "inletOutlet", "right", "PCG"})
        EXPECT_NE(said.find(expected), std::string::npos) << said;
    setup.viscous_solver = "PCG";
    EXPECT_EQ(refusal(setup, "0/U", "type zeroGradient;",
                      "type inletOutlet; inletValue uniform (0 0 0);"),
              "accepted");
}

TEST(DirectSolversRefusal, AnUnknownNameIsAnsweredWithTheList) {
    CoupledSetup setup = box_with(all_sides[0]);
    setup.viscous_solver = "magic";
    try {
        write_fluid_case(settings_of(setup), TemporaryFolder().path());
        FAIL() << "wrote a case with an unknown solver";
    } catch (const Failure& failure) {
        const std::string said = failure.what();
        for (const char* expected : {"fluid.viscous_solver", "magic", "FFT", "PCG"})
            EXPECT_NE(said.find(expected), std::string::npos) << said;
    }
}

/// Non-zero values on a side require OpenFOAM's operators, with the same direct solver: 1.5 on the
/// free sides only shifts p and causes no motion.
TEST(DirectSolversByOperators, TakeAFixedValueOtherThanZero) {
    const CoupledSetup setup = box_with(all_sides[2]);
    const TemporaryFolder folder;
    write_fluid_case(settings_of(setup), folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    replace_in(folder.path() / "0/p", "value uniform 0;", "value uniform 1.5;");
    FoamAdapter fluid(folder.path());
    CoupledRun reference(setup, some_discs(setup));
    fluid.initialise(settings_of(setup), {ShapeRecord{"disc", {}}});
    for (int n = 0; n < 5; ++n) {
        reference.advance();
        const Window window{n, n * setup.step, setup.step, false};
        fluid.advance(window);
        fluid.correct(window, reference.between());
        fluid.impose(window);
    }
    double off_u = 0.0, off_p = 0.0;
    for (int j = 0; j < 64; ++j)
        for (int i = 0; i < 80; ++i) {
            for (const auto& speed : {speed_x, speed_y})
                off_u =
                    std::max(off_u, std::abs(speed(fluid, i, j) - speed(reference.fluid(), i, j)));
            off_p = std::max(
                off_p, std::abs(fluid.pressure(i, j) - 1.5 - reference.fluid().pressure(i, j)));
        }
    EXPECT_LT(off_u, 1e-9);
    EXPECT_LT(off_p, 1e-7);
}

}  // namespace
}  // namespace turbidite
