// SPDX-License-Identifier: LGPL-2.1-or-later
//
// OpenFOAM in space: the windows that it hosts are those of plain arrays, and its mesh shows them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "fluid_adapter/box_app/array_store.hpp"
#include "fluid_adapter/fluid_window/fluid_window.hpp"
#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

constexpr int per_diameter = 6;
constexpr std::array<int, 3> cells{18, 24, 15};
constexpr double edge = 1.0 / per_diameter;

/// Between walls along y, open at the back, cyclic along x.
Settings space_settings(const std::string& splitting) {
    CoupledSetup setup;
    setup.left = setup.right = "cyclic";
    setup.width = cells[0] * edge;
    setup.height = cells[1] * edge;
    setup.cells_per_diameter = per_diameter;
    setup.splitting = splitting;
    setup.splitting_tolerance = 1e-6;
    setup.time_scheme = "second-order";
    setup.transport_scheme = "Gauss LUST grad(U)";
    setup.points = "interior";
    Settings settings = settings_of(setup);
    settings.set("run.dimension", std::int64_t{3});
    settings.set("run.size_z", cells[2] * edge);
    settings.set("run.acceleration_z", 0.0);
    settings.set("run.surface_shift", 0.3 * edge);
    settings.set("domain.front", std::string("wall"));
    settings.set("domain.back", std::string("free"));
    return settings;
}

std::vector<GrainState> two_spheres() {
    std::vector<GrainState> grains(2);
    for (int g = 0; g < 2; ++g) {
        grains[g].id = g + 1;
        grains[g].radius = 0.5;
        grains[g].density = 2.0;
    }
    grains[0].position = {0.1, 1.513, 1.207};  // across the cyclic side
    grains[1].position = {1.6, 2.417, 0.911};
    grains[0].velocity = {0.2, -0.4, 0.3};
    grains[1].velocity = {-0.1, 0.3, 0.2};
    grains[1].angular_velocity = {0.7, -0.3, 0.5};
    return grains;
}

template <class Fluid>
void play(Fluid& fluid, std::vector<GrainState>& grains, std::int64_t index, bool output) {
    constexpr double step = 0.01;
    const Window window{index, static_cast<double>(index) * step, step, output};
    const std::vector<Kick> kicks = fluid(window, grains).kicks;
    for (std::size_t g = 0; g < grains.size(); ++g) {
        grains[g].velocity = kicks.at(g).velocity;
        grains[g].angular_velocity = kicks.at(g).angular_velocity;
        grains[g].position = grains[g].position + step * kicks[g].velocity;
    }
}

/// A field of every cell as OpenFOAM wrote it, in its order: x, y, z.
std::vector<double> written_field(const std::filesystem::path& file, std::size_t components) {
    std::ifstream in(file, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    const std::string text = all.str();
    const std::size_t list = text.find("nonuniform"), open = text.find('(', list);
    std::vector<double> values(components * static_cast<std::size_t>(cells[0]) * cells[1] *
                               cells[2]);
    EXPECT_LT(open + values.size() * sizeof(double), text.size());
    std::memcpy(values.data(), text.data() + open + 1, values.size() * sizeof(double));
    return values;
}

class SpaceFluid : public testing::TestWithParam<std::string> {};

TEST_P(SpaceFluid, OpenFoamsWindowsAreThoseOfPlainArrays) {
    const Settings settings = space_settings(GetParam());
    const ShapeTable shapes = {{"sphere", {}}};
    TemporaryFolder folder;
    write_fluid_case(settings, folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    FoamAdapter foam(folder.path());
    const Box box = foam.initialise(settings, shapes);
    EXPECT_NEAR(box.upper[2], cells[2] * edge, 1e-9);

    ArrayBox plain;
    plain.grid = grid_of_cubes(cells, edge, {Side::cyclic, Side::wall, Side::wall});
    plain.grid.sides[2][1] = Side::open;
    plain.viscosity = 0.01;
    plain.rigid_grains = GetParam() != "marchuk-yanenko";
    ArrayStore store(plain);
    FluidWindow window(store, settings, shapes);

    std::vector<GrainState> in_foam = two_spheres(), in_arrays = two_spheres();
    const auto by_foam = [&](const Window& at, const std::vector<GrainState>& grains) {
        foam.advance(at);
        foam.correct(at, grains);
        return foam.impose(at);
    };
    const auto by_arrays = [&](const Window& at, const std::vector<GrainState>& grains) {
        window.advance(at);
        window.correct(grains);
        return window.impose();
    };
    for (std::int64_t index = 0; index < 3; ++index) {
        play(by_foam, in_foam, index, index == 2);
        play(by_arrays, in_arrays, index, false);
    }
    double largest = 0.0;
    for (std::size_t g = 0; g < 2; ++g)
        EXPECT_LT(norm(in_foam[g].velocity - in_arrays[g].velocity), 1e-9);
    const std::vector<double> written = written_field(folder.path() / "0.03" / "U", 3);
    for (int k = 0; k < cells[2]; ++k)
        for (int j = 0; j < cells[1]; ++j)
            for (int i = 0; i < cells[0]; ++i) {
                const int cell = store.field().cell(i, j, k);
                const std::size_t in_mesh =
                    i + static_cast<std::size_t>(cells[0]) * (j + cells[1] * k);
                for (int axis = 0; axis < 3; ++axis) {
                    const double u = store.field().velocity(axis)[cell];
                    ASSERT_NEAR(foam.velocity(i, j, k)[axis], u, 1e-9);
                    ASSERT_NEAR(written[3 * in_mesh + axis], u, 1e-9) << i << ' ' << j << ' ' << k;
                    largest = std::max(largest, std::abs(u));
                }
            }
    EXPECT_GT(largest, 0.1);
}

/// Fluid in a sphere that spins with omega has the vorticity 2 omega, and the sphere covers its
/// volume, across a cyclic side too.
TEST(SpaceFields, ShowASpinningSphere) {
    Settings settings = space_settings("marchuk-yanenko");
    settings.set("output.fields", std::string("vorticity solid"));
    TemporaryFolder folder;
    write_fluid_case(settings, folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    FoamAdapter foam(folder.path());
    foam.initialise(settings, {{"sphere", {}}});
    std::vector<GrainState> sphere = {two_spheres()[0]};
    const Vec3 spin{0.7, -0.3, 0.5};
    sphere[0].velocity = {};
    sphere[0].angular_velocity = spin;
    sphere[0].prescribed = true;
    const auto windows = [&](const Window& at, const std::vector<GrainState>& grains) {
        foam.advance(at);
        foam.correct(at, grains);
        return foam.impose(at);
    };
    play(windows, sphere, 0, true);
    const std::vector<double> vorticity = written_field(folder.path() / "0.01" / "vorticity", 3);
    const std::vector<double> solid = written_field(folder.path() / "0.01" / "solid", 1);
    double covered = 0.0;
    int inside = 0;
    for (std::size_t cell = 0; cell < solid.size(); ++cell) {
        const int n = static_cast<int>(cell), i = n % cells[0], j = n / cells[0] % cells[1];
        covered += solid[cell] * edge * edge * edge;
        Vec3 arm = Vec3{i + 0.5, j + 0.5, n / (cells[0] * cells[1]) + 0.5};
        arm = edge * arm - sphere[0].position;
        if (arm[0] > 1.5) arm[0] -= 3.0;
        if (norm(arm) > 0.5 - edge) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(vorticity[3 * cell + axis], 2.0 * spin[axis], 1e-9);
        EXPECT_EQ(solid[cell], 1.0);
        ++inside;
    }
    EXPECT_GE(inside, 20);
    const double radius = 0.5 + 0.3 * edge;
    EXPECT_NEAR(covered, 4.0 / 3.0 * M_PI * std::pow(radius, 3), 1e-3);
}

/// A saved state holds all that the next window needs.
TEST_P(SpaceFluid, GoesOnFromASavedState) {
    const Settings settings = space_settings(GetParam());
    TemporaryFolder folder;
    write_fluid_case(settings, folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    std::vector<GrainState> whole = two_spheres(), rest;
    SavedState state;
    const auto by = [](FoamAdapter& foam) {
        return [&foam](const Window& at, const std::vector<GrainState>& grains) {
            foam.advance(at);
            foam.correct(at, grains);
            return foam.impose(at);
        };
    };
    {
        FoamAdapter foam(folder.path());
        foam.initialise(settings, {{"sphere", {}}});
        auto windows = by(foam);
        for (std::int64_t index = 0; index < 4; ++index) {
            if (index == 2) state = foam.save(), rest = whole;
            play(windows, whole, index, false);
        }
    }
    FoamAdapter foam(folder.path());
    foam.initialise(settings, {{"sphere", {}}});
    foam.restore(state);
    auto windows = by(foam);
    for (std::int64_t index = 2; index < 4; ++index) play(windows, rest, index, false);
    for (std::size_t g = 0; g < 2; ++g) {
        EXPECT_EQ(rest[g].velocity, whole[g].velocity);
        EXPECT_EQ(rest[g].angular_velocity, whole[g].angular_velocity);
    }
}

INSTANTIATE_TEST_SUITE_P(Splittings, SpaceFluid,
                         testing::Values("marchuk-yanenko", "explicit-multiplier",
                                         "implicit-multiplier"),
                         [](const auto& info) {
                             std::string name = info.param;
                             name[name.find('-')] = '_';
                             return name;
                         });

}  // namespace
}  // namespace turbidite
