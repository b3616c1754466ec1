// SPDX-License-Identifier: GPL-3.0-or-later
//
// The hand-written array code of `turbidite bench fluid` is a fair reference only if it computes
// the same as our window without grains.
//
// Both solve their linear problems directly and differ only in the order of their sums: 20 windows
// of velocities of order 1 agree to 1e-11, while a different limiter, wall or excess flux causes a
// difference of at least 1e-4.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "bench/array_code/plane_flow.hpp"
#include "bench/fluid/start_flow.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

CoupledSetup closed_box() {
    CoupledSetup setup;
    setup.width = 5.0;  // 80 x 120 cells
    setup.height = 7.5;
    setup.reynolds = 36.0;
    return setup;
}

/// Writes the formula as the initial field of an OpenFOAM case.
void write_start(const std::filesystem::path& folder, const CoupledSetup& setup,
                 const array_code::FlowSetup& box, const array_code::VelocityAt& start) {
    write_fluid_case(settings_of(setup), folder);
    build_fluid_mesh(folder, folder / "blockMesh.log");
    std::ofstream file(folder / "0" / "U");
    file.precision(17);
    file << "FoamFile { version 2.0; format ascii; class volVectorField; object U; }\n"
         << "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector>\n"
         << box.nx * box.ny << "\n(\n";
    for (int j = 0; j < box.ny; ++j)
        for (int i = 0; i < box.nx; ++i) {
            const auto [u, v] = start((i + 0.5) * box.spacing, (j + 0.5) * box.spacing);
            file << "(" << u << " " << v << " 0)\n";
        }
    file << ");\nboundaryField { \"left|right|bottom|top\" { type noSlip; } "
         << "frontAndBack { type empty; } }\n";
}

TEST(ArrayCode, ComputesOurWindowWithoutGrains) {
    const CoupledSetup setup = closed_box();
    const array_code::FlowSetup box{80, 120, 1.0 / 16.0, 1.0 / setup.reynolds, setup.step};
    // The formula vanishes on the walls and is divergence-free. A stream across the walls, which
    // the first projection must remove, is added so that the pressure matters.
    const array_code::VelocityAt start = [&](double x, double y) {
        const auto [u, v] = bench::start_flow(setup.width, setup.height, x, y);
        return std::pair{u + 0.3 * x * y / 10.0, v - 0.2};
    };
    const TemporaryFolder folder;
    write_start(folder.path(), setup, box, start);
    FoamAdapter ours(folder.path());
    ours.initialise(settings_of(setup), {ShapeRecord{"disc", {}}});
    array_code::PlaneFlow theirs(box, start);

    for (int n = 0; n < 20; ++n) {
        const Window window{n, n * setup.step, setup.step, false};
        ours.advance(window);
        ours.correct(window, {});
        ours.impose(window);
        theirs.step();
        double difference = 0.0, largest = 0.0;
        for (int j = 0; j < box.ny; ++j)
            for (int i = 0; i < box.nx; ++i) {
                const Vec3 u = ours.velocity(i, j);
                difference = std::max(
                    {difference, std::abs(u[0] - theirs.u(i, j)), std::abs(u[1] - theirs.v(i, j))});
                largest = std::max({largest, std::abs(u[0]), std::abs(u[1])});
            }
        ASSERT_LT(difference, 1e-11) << "after window " << n;
        ASSERT_GT(largest, 0.3) << "the flow has died; nothing was compared";
    }
}

}  // namespace
}  // namespace turbidite
