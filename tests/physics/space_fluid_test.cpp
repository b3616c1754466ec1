// SPDX-License-Identifier: LGPL-2.1-or-later
//
// OpenFOAM in space: the windows that it hosts are those of plain arrays, and its mesh shows them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

#include "fluid_adapter/box_app/array_store.hpp"
#include "fluid_adapter/domain/grain_reach.hpp"
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
    setup.cells_per_diameter = per_diameter;
    setup.splitting = splitting;
    setup.splitting_tolerance = 1e-6;
    return settings_in_space(setup, cells, "wall", "free");
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

/// The message with which the case is refused after these words of a file have been replaced.
std::string refusal(const char* file, const std::string& patch, const std::string& condition) {
    const Settings settings = space_settings("marchuk-yanenko");
    const TemporaryFolder folder;
    write_fluid_case(settings, folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    std::stringstream all;
    all << std::ifstream(folder.path() / file).rdbuf();
    std::string text = all.str();
    const std::size_t begin = text.find('{', text.find("\n    " + patch)) + 1;
    text.replace(begin, text.find('}', begin) - begin, condition);
    std::ofstream(folder.path() / file) << text;
    FoamAdapter foam(folder.path());
    try {
        foam.initialise(settings, {{"sphere", {}}});
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_input);
        return failure.what();
    }
    return "accepted";
}

// The steps would play walls and free sides of the grid whatever the files say.
TEST(SpaceFluidConditions, ThatTheGridDoesNotHaveAreRefused) {
    const auto expect_words = [](const std::string& said,
                                 const std::vector<const char*>& expected) {
        for (const char* word : expected) EXPECT_NE(said.find(word), std::string::npos) << said;
    };
    expect_words(refusal("0/U", "top", " type slip; "), {"0/U", "top", "slip", "noSlip"});
    expect_words(refusal("0/U", "back", " type slip; "), {"0/U", "back", "slip", "zeroGradient"});
    expect_words(refusal("0/p", "back", " type fixedValue; value uniform 1.5; "),
                 {"0/p", "back", "another value", "domain.back"});
    expect_words(refusal("0/p", "bottom", " type fixedValue; value uniform 0; "),
                 {"0/p", "bottom", "zeroGradient"});
    EXPECT_EQ(refusal("0/U", "top", " type fixedValue; value uniform (0.1 0 0); "), "accepted");
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
    const Box whole{{}, {cells[0] * edge, cells[1] * edge, cells[2] * edge}};
    EXPECT_NEAR(box.upper[2], with_reach(whole, settings).upper[2], 1e-9);

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

/// These sides normal to an axis; the others are cyclic.
Settings box_with_sides(int axis, const std::string& lower, const std::string& upper) {
    Settings settings = space_settings("marchuk-yanenko");
    for (const BoxSide& side : box_sides) {
        const std::string& own = side.inward > 0.0 ? lower : upper;
        settings.set(side.key, side.axis == axis ? own : std::string("cyclic"));
    }
    return settings;
}

std::string moved(int side, const Vec3& v) {
    std::ostringstream text;
    text << side << " constant " << v[0] << ' ' << v[1] << ' ' << v[2] << " 0 0 0";
    return text.str();
}

struct SpaceRun {
    explicit SpaceRun(const Settings& settings) : foam(prepared(folder.path(), settings)) {
        foam.initialise(settings, {{"sphere", {}}});
    }

    static std::filesystem::path prepared(const std::filesystem::path& path,
                                          const Settings& settings) {
        write_fluid_case(settings, path);
        build_fluid_mesh(path, path / "blockMesh.log");
        return path;
    }

    Kicks advance(double step, const std::vector<GrainState>& grains = {}) {
        const Window window{index, static_cast<double>(index) * step, step, false};
        ++index;
        foam.advance(window);
        foam.correct(window, grains);
        return foam.impose(window);
    }

    TemporaryFolder folder;
    FoamAdapter foam;
    std::int64_t index = 0;
};

/// `expected` of the place {i, j, k} of every cell.
template <class Expected>
void expect_velocity(SpaceRun& run, Expected expected, double tolerance) {
    for (int k = 0; k < cells[2]; ++k)
        for (int j = 0; j < cells[1]; ++j)
            for (int i = 0; i < cells[0]; ++i)
                ASSERT_LT(norm(run.foam.velocity(i, j, k) - expected(std::array{i, j, k})),
                          tolerance)
                    << i << ' ' << j << ' ' << k;
}

/// Between walls that slide in both directions along themselves u = V s is a solution of the
/// discrete equations, whatever axis the walls are normal to.
TEST(SpaceSides, CouetteFlowIsLinearExactly) {
    for (int axis = 0; axis < 3; ++axis) {
        Vec3 below{-0.5, 0.25, 0.75}, above{1.5, -1.0, 0.5};
        below[axis] = above[axis] = 0.0;
        Settings settings = box_with_sides(axis, "wall", "wall");
        settings.set("run.wall_motions", moved(2 * axis, below) + ";" + moved(2 * axis + 1, above));
        settings.set("run.viscosity", 10.0);
        SpaceRun run(settings);
        EXPECT_LT(run.advance(0.1).report.momentum_defect, 1e-9);
        for (int n = 0; n < 60; ++n) run.advance(0.1);
        expect_velocity(
            run,
            [&](const std::array<int, 3>& at) {
                const double s = (at[axis] + 0.5) / cells[axis];
                return (1.0 - s) * below + s * above;
            },
            1e-11);
    }
}

GrainState sphere_inside() {
    GrainState sphere = two_spheres()[0];
    sphere.position = {1.31, 1.73, 1.24};
    sphere.velocity = {};
    sphere.prescribed = true;
    return sphere;
}

/// A stream that enters and leaves through a free side, or through another inflow, is uniform, and
/// a sphere that moves with it does not disturb it (Galilei).
TEST(SpaceSides, AStreamCarriesASphere) {
    for (int axis = 0; axis < 3; ++axis)
        for (const std::string outlet : {"free", "inflow"}) {
            Vec3 stream{};
            stream[axis] = 0.8;
            Settings settings = box_with_sides(axis, "inflow", outlet);
            std::string motions = moved(2 * axis, stream);
            if (outlet == "inflow") motions += ";" + moved(2 * axis + 1, stream);
            settings.set("run.inflow_motions", motions);
            settings.set("run.viscosity", 1.0);
            SpaceRun run(settings);
            for (int n = 0; n < 150; ++n)
                ASSERT_LT(run.advance(0.05).report.divergence, 1e-10) << axis << outlet;
            const auto uniform = [&](const std::array<int, 3>&) { return stream; };
            expect_velocity(run, uniform, 1e-11);
            GrainState sphere = sphere_inside();
            sphere.velocity = stream;
            for (int n = 0; n < 5; ++n) {
                const Kicks kicks = run.advance(0.01, {sphere});
                EXPECT_LT(norm(kicks.kicks.at(0).multiplier_impulse), 1e-10);
                sphere.position = sphere.position + 0.01 * stream;
            }
            expect_velocity(run, uniform, 1e-10);
        }
}

/// Past a sphere at rest, too, every window is free of divergence and its momentum closed, and as
/// much leaves as enters, up to what step 5 changes.
TEST(SpaceSides, WhatEntersLeaves) {
    Settings settings = box_with_sides(0, "inflow", "free");
    settings.set("run.inflow_motions", moved(0, {0.8, 0.0, 0.0}));
    SpaceRun run(settings);
    Kicks kicks;
    for (int n = 0; n < 50; ++n) {
        kicks = run.advance(0.02, {sphere_inside()});
        ASSERT_LT(kicks.report.divergence, 1e-10);
        ASSERT_LT(kicks.report.momentum_defect, 1e-9);
    }
    EXPECT_GT(kicks.kicks[0].multiplier_impulse[0], 1e-4);
    double flux = 0.0;
    for (int k = 0; k < cells[2]; ++k)
        for (int j = 0; j < cells[1]; ++j) flux += run.foam.velocity(cells[0] - 1, j, k)[0];
    EXPECT_NEAR(flux / (cells[1] * cells[2]), 0.8, 0.02);
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
