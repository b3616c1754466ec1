// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a window with output tells of the fluid, against numbers derived by hand. Run units: D = u_c
// = rho_f = 1.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <numbers>
#include <sstream>

#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr int cells = 32;  // along each side of a box of 4 D
constexpr double h = 0.125;

CoupledSetup box_with_output() {
    CoupledSetup setup;
    setup.cells_per_diameter = 8;
    setup.tolerance = 1e-9;
    return setup;
}

/// Of the mean velocity of two cells at the face between them; nothing passes the walls.
double flux(CoupledRun& run, int i, int j, int axis) {
    const int along = axis == 0 ? i : j;
    if (along < 0 || along == cells - 1) return 0.0;
    const int next_i = axis == 0 ? i + 1 : i, next_j = axis == 0 ? j : j + 1;
    return 0.5 * (run.fluid().velocity(i, j)[axis] + run.fluid().velocity(next_i, next_j)[axis]);
}

double largest_divergence(CoupledRun& run) {
    double largest = 0.0;
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const double sum = flux(run, i, j, 0) - flux(run, i - 1, j, 0) + flux(run, i, j, 1) -
                               flux(run, i, j - 1, 1);
            largest = std::max(largest, std::abs(sum) / h);
        }
    return largest;
}

TEST(OutputValues, FinalDivergenceIsThatOfTheVelocityAtTheEnd) {
    CoupledSetup setup = box_with_output();
    setup.gravity = 11.86;
    CoupledRun run(setup, {disc_at(setup, 2.03, 2.5)});
    for (int n = 0; n < 10; ++n) run.advance();
    EXPECT_EQ(run.answer().report.final_divergence, 0.0) << "told in windows with output only";
    run.advance(true);
    const double expected = largest_divergence(run);
    EXPECT_GT(expected, 0.1);
    EXPECT_NEAR(run.answer().report.final_divergence, expected, 1e-9 * expected);
}

/// A uniform force a in a closed box is balanced by p = rho_f a x.
TEST(OutputValues, ProbesTellThePressureThatBalancesAForce) {
    CoupledSetup setup = box_with_output();
    setup.acceleration_x = 0.8;
    setup.probes = "1 1 3.1 2.2";
    CoupledRun run(setup, {});
    run.advance(true);
    const std::vector<double>& probes = run.answer().report.probes;
    ASSERT_EQ(probes.size(), 6u);  // p, u, v
    EXPECT_NEAR(probes[3] - probes[0], 0.8 * 2.1, 1e-9);
    for (const int k : {1, 2, 4, 5}) EXPECT_NEAR(probes[static_cast<std::size_t>(k)], 0.0, 1e-12);
}

/// The internal values of a binary field.
std::vector<double> field(const std::filesystem::path& folder, const std::string& name) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (!std::filesystem::exists(entry.path() / name)) continue;
        std::ostringstream read;
        read << std::ifstream(entry.path() / name, std::ios::binary).rdbuf();
        const std::string text = read.str();
        const std::size_t at = text.find('(', text.find("internalField   nonuniform"));
        std::vector<double> values(static_cast<std::size_t>(cells) * cells);
        if (at == std::string::npos || text.size() < at + 1 + 8 * values.size()) return {};
        std::memcpy(values.data(), text.data() + at + 1, 8 * values.size());
        return values;
    }
    return {};
}

/// Fluid in a disc that spins with omega has the vorticity 2 omega, and the disc covers pi/4.
TEST(OutputValues, FieldsShowASpinningDisc) {
    CoupledSetup setup = box_with_output();
    setup.fields = "vorticity solid";
    GrainState disc = disc_at(setup, 2.03, 1.98);
    disc.angular_velocity = {0.0, 0.0, -0.7};
    disc.prescribed = true;
    CoupledRun run(setup, {disc});
    run.advance();
    run.advance(true);
    const std::vector<double> vorticity = field(run.folder(), "vorticity");
    const std::vector<double> solid = field(run.folder(), "solid");
    ASSERT_EQ(vorticity.size(), 1024u);
    ASSERT_EQ(solid.size(), 1024u);
    double covered = 0.0;
    int inside = 0;
    for (int j = 0; j < cells; ++j)
        for (int i = 0; i < cells; ++i) {
            const std::size_t cell = static_cast<std::size_t>(cells * j + i);
            covered += h * h * solid[cell];
            if (std::hypot((i + 0.5) * h - 2.03, (j + 0.5) * h - 1.98) > 0.5 - 3.0 * h) continue;
            EXPECT_NEAR(vorticity[cell], -1.4, 1e-6);
            EXPECT_EQ(solid[cell], 1.0);
            ++inside;
        }
    EXPECT_GE(inside, 3);
    EXPECT_NEAR(covered, 0.25 * std::numbers::pi, 0.01);
}

/// M dU/dt = -(M - m_f) g + F_h, and the smaller body falls faster.
TEST(HydrodynamicRadius, ATriangleFallsAsTheSmallerBodyThatTheFluidSees) {
    double speed[2] = {};
    for (const int shrunk : {0, 1}) {
        CoupledSetup setup;
        setup.shape = {"triangle", {}};
        setup.gravity = 11.86;
        setup.reynolds = 36.0;
        setup.hydrodynamic_radius = shrunk == 1 ? 0.7 : 1.0;
        CoupledRun run(setup, {disc_at(setup, 2.03, 2.8)});
        const ImmersedBody body = run.body();
        const double weight = body.submerged_mass * setup.gravity;
        for (int n = 0; n < 80; ++n) {
            run.advance();
            const double dU = run.grains()[0].velocity[1] - run.before()[0].velocity[1];
            const double hydrodynamic =
                (run.answer().kicks[0].multiplier_impulse[1] + body.displaced_mass * dU) /
                setup.step;
            ASSERT_NEAR(body.mass * dU / setup.step, hydrodynamic - weight, 1e-9 * weight);
        }
        EXPECT_EQ(run.contacts(), 0);
        speed[shrunk] = -run.grains()[0].velocity[1];
    }
    EXPECT_GT(speed[0], 0.3);
    EXPECT_GT(speed[1], 1.15 * speed[0]);
}

}  // namespace
}  // namespace turbidite
