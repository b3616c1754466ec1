// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Spheres in a liquid, from the case file to the files of the run: OpenFOAM and contact dynamics in
// three dimensions.
#include <algorithm>
#include <cmath>

#include "tests/system/fluid_files.hpp"
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

const char* const settling = R"(
dimension: 3
domain: {size: [4, 5, 4], left: cyclic, right: cyclic, front: cyclic, back: cyclic}
grains: {adapter: standalone-nscd, generator: random, count: 16, region: [4, 4, 4], density_ratio: 3}
fluid: {reynolds: 20, cells_per_diameter: 6, splitting: explicit-multiplier}
contact: {friction: 0.4}
scales: {kind: avalanche}
time: {step: 0.02, end: 6}
output: {interval: 0.5}
checkpoint: {interval: 3}
)";

class SpaceFluid : public ShellTest {
 protected:
    void SetUp() override { scratch.write("case.yaml", settling); }

    Answer turbidite(const std::string& words) const {
        return shell(std::string(TURBIDITE_PROGRAM) + " " + words);
    }
    Columns history(const std::string& folder) const {
        return columns_of(text(scratch.path() / folder / "history.csv"));
    }

    std::vector<double> field(const std::string& file, std::size_t count) const {
        return openfoam_field(text(scratch.path() / file), count);
    }
};

TEST_F(SpaceFluid, SpheresSettleOnTheFloor) {
    const Answer answer = turbidite("run case.yaml --out run");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Columns run = history("run");
    EXPECT_EQ(run.at("grains").back(), 16.0);
    EXPECT_LT(run.at("mean_position_y").back(), run.at("mean_position_y").front() - 0.4);
    EXPECT_GT(run.at("contacts").back(), 4.0);
    const auto record = nlohmann::json::parse(text(scratch.path() / "run/run.json"));
    EXPECT_LE(record["maxima"]["grain_balance"].get<double>(), 1e-9);
    EXPECT_LE(record["maxima"]["fluid_balance"].get<double>(), 1e-9);
    EXPECT_LE(record["maxima"]["joint_mismatch"].get<double>(), 1e-4);
    // They fall through the liquid, which they drag along and which goes up around them.
    double fastest = 0.0;
    for (const double v : run.at("mean_velocity_y")) fastest = std::min(fastest, v);
    EXPECT_LT(fastest, -0.05);
    EXPECT_GT(fastest, -1.0);
    EXPECT_TRUE(std::filesystem::exists(scratch.path() / "run/fluid/6/U"));
}

/// Under `split` with each of the hosts: contact dynamics, and springs. While nothing touches, both
/// get the same velocities from the liquid.
class SpringsInALiquid : public SpaceFluid {
 protected:
    void expect_the_same(const std::string& grains, const std::string& sides,
                         const std::vector<std::string>& hosts) {
        scratch.write("grains.csv", "id,x,y,z,vx,vz,wx,wy,wz\n" + grains);
        const std::string words =
            "run case.yaml --set grains.file=grains.csv --set time.end=1 --set output.interval=0.1"
            " --set fluid.program=box --set fluid.splitting=marchuk-yanenko"
            " --set coupling.scheme=split --set contact.friction=0.2" +
            sides;
        ASSERT_EQ(turbidite(words + " --out nscd").code, 0);
        const Columns rigid = history("nscd");
        EXPECT_TRUE(touched("nscd"));
        for (const std::string& host : hosts) {
            const Answer answer =
                turbidite(words + " --out run --force --set grains.adapter=" + host);
            ASSERT_EQ(answer.code, 0) << host << answer.err;
            EXPECT_TRUE(touched("run")) << host;
            expect_near(history("run"), rigid, host);
        }
    }

 private:
    // Springs touch for less than an output.
    bool touched(const std::string& folder) const {
        const auto record = nlohmann::json::parse(text(scratch.path() / folder / "run.json"));
        return record["maxima"]["penetration"].get<double>() > 0.0;
    }

    static void expect_near(const Columns& springs, const Columns& rigid, const std::string& host) {
        for (const char* name : {"mean_velocity_x", "mean_velocity_y", "mean_velocity_z"})
            for (std::size_t row = 0; row < rigid.at(name).size(); ++row)
                EXPECT_NEAR(springs.at(name)[row], rigid.at(name)[row], row < 3 ? 1e-6 : 0.02)
                    << host << ", " << name << " in row " << row;
    }
};

// Two that spin about different axes, so that turns do not commute, and meet; one that falls alone.
TEST_F(SpringsInALiquid, SinkTheSameAndCollide) {
    expect_the_same(
        "1,1.45,2.5,2.0,0.3,0,2,1,0\n2,2.6,2.6,2.1,-0.3,0,0,2,1\n"
        "3,2.0,4.2,3.2,0,0.4,1,0,2\n",
        " --set domain.left=wall --set domain.right=wall --set domain.front=wall"
        " --set domain.back=wall",
        {"standalone-md", "lammps-md", "yade-md"});
}

// The same two half a box farther, and the third through the back.
TEST_F(SpringsInALiquid, CollideAcrossCyclicSides) {
    expect_the_same(
        "1,3.45,2.5,2.0,0.3,0,2,1,0\n2,0.6,2.6,2.1,-0.3,0,0,2,1\n"
        "3,2.0,4.2,3.8,0,0.4,1,0,2\n",
        "", {"standalone-md", "lammps-md", "lammps-md --set grains.ranks=2"});
}

/// Two ranks of layers, with spheres on the border between them.
TEST_F(SpaceFluid, TwoRanksAgreeWithOne) {
    ASSERT_EQ(turbidite("run case.yaml --out one --set time.end=3").code, 0);
    const Answer answer = turbidite("run case.yaml --out two --set time.end=3 --set fluid.ranks=2");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Columns one = history("one"), two = history("two");
    for (const char* name : {"mean_velocity_x", "mean_velocity_y", "mean_velocity_z", "flow_y"})
        for (std::size_t row = 1; row < one.at(name).size(); ++row)
            EXPECT_NEAR(one.at(name)[row], two.at(name)[row], 1e-7) << name << " in row " << row;
}

TEST_F(SpaceFluid, AResumedRunHasEqualBits) {
    ASSERT_EQ(turbidite("run case.yaml --out whole").code, 0);
    ASSERT_EQ(turbidite("run case.yaml --out parts --set time.end=3").code, 0);
    const Answer more = turbidite("resume parts --set time.end=6");
    ASSERT_EQ(more.code, 0) << more.err;
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "whole/history.csv")),
              lines_without_wall_times(text(scratch.path() / "parts/history.csv")));
    for (const char* file : {"grains/grains_00000300.vtp", "fluid/6/U", "fluid/6/p"})
        EXPECT_EQ(text(scratch.path() / "whole" / file), text(scratch.path() / "parts" / file))
            << file;
}

// At the centre of a cell a probe has the values of the written fields there, on any number of
// ranks.
TEST_F(SpaceFluid, AProbeHasTheValuesOfTheFields) {
    constexpr int nx = 24, ny = 30, nz = 24, i = 9, j = 20, k = 5;
    const auto centre = [](int layer) { return std::to_string((layer + 0.5) / 6.0); };
    const std::string run =
        "run case.yaml --set time.end=0.4 --set output.interval=0.2 --set "
        "\"output.probes=[" +
        centre(i) + ", " + centre(j) + ", " + centre(k) + ", 3.1, 2.5, 1.3]\" --set fluid.ranks=";
    ASSERT_EQ(turbidite(run + "1 --out one").code, 0);
    ASSERT_EQ(turbidite(run + "2 --out two").code, 0);
    const Columns one = columns_of(text(scratch.path() / "one/probes.csv"));
    const Columns two = columns_of(text(scratch.path() / "two/probes.csv"));
    ASSERT_EQ(one.size(), 1u + 2 * 4u);
    ASSERT_EQ(one.at("time"), (std::vector<double>{0.2, 0.4}));
    for (const auto& [name, values] : one)
        EXPECT_LT(largest_difference(values, two.at(name)), 1e-7) << name;
    const std::vector<double> p = field("one/fluid/0.4/p", nx * ny * nz);
    const std::vector<double> U = field("one/fluid/0.4/U", 3 * nx * ny * nz);
    ASSERT_FALSE(p.empty() || U.empty());
    const std::size_t cell = i + nx * (j + ny * k);  // blockMesh: x, y, z
    const auto near = [](double value) { return 1e-4 * std::abs(value) + 1e-9; };
    EXPECT_NEAR(one.at("pressure_1").back(), p[cell], near(p[cell]));
    const char* const names[] = {"velocity_x_1", "velocity_y_1", "velocity_z_1"};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double u = U[3 * cell + axis];
        EXPECT_GT(std::abs(u), 1e-5);
        EXPECT_NEAR(one.at(names[axis]).back(), u, near(u)) << names[axis];
    }
}

// Between two layers of cells a slice is the mean of both; on any number of ranks it is the same,
// and after a resumption none is there twice.
TEST_F(SpaceFluid, SlicesAreThoseOfTheFields) {
    constexpr std::size_t nx = 24, ny = 30, nz = 24;
    const std::string run =
        "run case.yaml --set time.end=0.4 --set output.interval=0.2 --set "
        "\"output.slices=z = 2, y = 2.5, x = 0.75\" --set fluid.ranks=";
    ASSERT_EQ(turbidite(run + "1 --out one").code, 0);
    ASSERT_EQ(turbidite(run + "2 --out two").code, 0);
    const std::vector<double> U = field("one/fluid/0.4/U", 3 * nx * ny * nz);
    const std::vector<double> p = field("one/fluid/0.4/p", nx * ny * nz);
    ASSERT_FALSE(p.empty() || U.empty());
    const auto cell = [&](std::size_t i, std::size_t j, std::size_t k) {
        return i + nx * (j + ny * k);
    };
    const auto of = [&](const std::string& folder, const std::string& name, const char* array) {
        return slice_array(text(scratch.path() / folder / "fluid/slices" / name), array);
    };
    const std::vector<float> z = of("one", "z2_00000020.vtr", "U"),
                             y = of("one", "y2.5_00000020.vtr", "p"),
                             x = of("one", "x0.75_00000020.vtr", "U");
    ASSERT_EQ(z.size(), 3 * nx * ny);
    ASSERT_EQ(y.size(), nx * nz);
    ASSERT_EQ(x.size(), 3 * ny * nz);
    double largest = 0.0;
    for (std::size_t j = 0; j < ny; ++j)
        for (std::size_t i = 0; i < nx; ++i)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const double mean =
                    0.5 * (U[3 * cell(i, j, 11) + axis] + U[3 * cell(i, j, 12) + axis]);
                ASSERT_NEAR(z[3 * (i + nx * j) + axis], mean, 1e-6) << i << ' ' << j;
                largest = std::max(largest, std::abs(mean));
            }
    EXPECT_GT(largest, 0.05);
    for (std::size_t k = 0; k < nz; ++k)
        for (std::size_t i = 0; i < nx; ++i)
            ASSERT_NEAR(y[i + nx * k], 0.5 * (p[cell(i, 14, k)] + p[cell(i, 15, k)]), 1e-6);
    for (std::size_t k = 0; k < nz; ++k)  // x = 0.75 is the centre of a cell
        for (std::size_t j = 0; j < ny; ++j)
            ASSERT_NEAR(x[3 * (j + ny * k) + 1], U[3 * cell(4, j, k) + 1], 1e-6);
    for (const char* name : {"z2_00000020.vtr", "y2.5_00000020.vtr", "x0.75_00000020.vtr"})
        for (const char* array : {"p", "U", "covered"}) {
            const std::vector<float> one = of("one", name, array), two = of("two", name, array);
            ASSERT_EQ(one.size(), two.size());
            double highest = 0.0;
            for (std::size_t n = 0; n < one.size(); ++n) {
                ASSERT_NEAR(one[n], two[n], 1e-5) << name << ' ' << array;
                highest = std::max(highest, static_cast<double>(one[n]));
            }
            if (std::string(array) == "covered") {
                EXPECT_EQ(highest, 1.0);
            }
        }
    const auto entries = [&] {
        const std::string series = text(scratch.path() / "one/fluid/slices/slices.pvd");
        std::size_t count = 0;
        for (std::size_t at = series.find("DataSet "); at != std::string::npos;
             at = series.find("DataSet ", at + 1))
            ++count;
        return count;
    };
    EXPECT_EQ(entries(), 2u * 3u);
    // As if the run had gone on after its last checkpoint.
    std::ofstream(scratch.path() / "one/fluid/slices/z2_00000050.vtr") << "later";
    ASSERT_EQ(turbidite("resume one --set time.end=0.6").code, 0);
    EXPECT_EQ(entries(), 3u * 3u);
    EXPECT_FALSE(std::filesystem::exists(scratch.path() / "one/fluid/slices/z2_00000050.vtr"));
}

// A stream between lids that slide across it drags spheres along; two ranks of layers as one.
TEST_F(SpaceFluid, SidesMoveTheFluidOnAnyNumberOfRanks) {
    const std::string run =
        "run case.yaml --set time.end=0.6 --set output.interval=0.2 --set domain.left=inflow --set "
        "domain.right=free --set domain.front=wall --set domain.back=wall --set "
        "domain.motions.in.kind=constant --set \"domain.motions.in.velocity=[0.5, 0, 0]\" --set "
        "domain.motions.lid.kind=constant --set \"domain.motions.lid.velocity=[0.2, 0, 1]\" --set "
        "domain.left_motion=in --set domain.top_motion=lid --set domain.bottom_motion=lid --set "
        "fluid.ranks=";
    const Answer one = turbidite(run + "1 --out one"), two = turbidite(run + "2 --out two");
    ASSERT_EQ(one.code, 0) << one.err;
    ASSERT_EQ(two.code, 0) << two.err;
    const Columns first = history("one"), second = history("two");
    for (const char* name : {"mean_velocity_x", "mean_velocity_z", "flow_x", "flow_z"})
        EXPECT_NEAR(first.at(name).back(), second.at(name).back(), 1e-7) << name;
    EXPECT_GT(first.at("flow_x").back(), 0.3);
    EXPECT_GT(first.at("flow_z").back(), 0.01);
    EXPECT_GT(first.at("mean_velocity_x").back(), 0.05);
}

/// A sphere that falls on the floor slows down in the film, whose work is told, and a run in two
/// parts has the bits of one.
TEST_F(SpaceFluid, FilmsSlowWhatLands) {
    scratch.write("one.csv", "id,x,y,z,vy\n1,2,0.65,2,-0.5\n");
    const std::string one =
        "run case.yaml --set grains.file=one.csv --set time.end=0.8 --set "
        "checkpoint.interval=0.4 --set output.interval=0.02 --out ";
    ASSERT_EQ(turbidite(one + "bare").code, 0);
    const std::string film = " --set contact.film=lubrication";
    const Answer answer = turbidite(one + "filmed" + film);
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Columns bare = history("bare"), filmed = history("filmed");
    EXPECT_TRUE(std::isnan(bare.at("film_work").back())) << "empty without films";
    double work = 0.0;
    for (const double part : filmed.at("film_work")) work += std::isnan(part) ? 0.0 : part;
    EXPECT_LT(work, -1e-3);
    // When it is within 0.002 D of the floor
    const auto arrival = [](const Columns& run) {
        std::size_t row = 0;
        while (row < run.at("time").size() && run.at("mean_position_y")[row] > 0.502) ++row;
        return row < run.at("time").size() ? run.at("time")[row] : 1e9;
    };
    EXPECT_LT(arrival(bare), 0.5);
    EXPECT_NEAR(bare.at("mean_position_y").back(), 0.5, 1e-4) << "it lies where it has landed";
    EXPECT_GT(arrival(filmed), arrival(bare) + 0.1) << "it sinks through its film, and";
    EXPECT_LT(arrival(filmed), 0.8) << "lands";
    ASSERT_EQ(turbidite(one + "parts --set time.end=0.4" + film).code, 0);
    ASSERT_EQ(turbidite("resume parts --set time.end=0.8").code, 0);
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "parts/history.csv")),
              lines_without_wall_times(text(scratch.path() / "filmed/history.csv")));
}

/// Spheres that touch each other or a wall, held by nothing: the liquid fills the wedge behind one
/// that leaves. Without a film in the wedges it stayed, with a short step for ever.
class SpheresThatTouch : public SpaceFluid {
 protected:
    /// Of the sphere that moves [u_c], its fall as it begins; those that are fixed are at rest.
    double speed(const std::string& grains, const std::string& words, const std::string& folder) {
        scratch.write(folder + ".csv", "id,x,y,z,motion\n" + grains);
        const Answer answer = turbidite(
            "run case.yaml --set time.end=0.5 --set fluid.program=box --set grains.file=" + folder +
            ".csv --out " + folder + words);
        EXPECT_EQ(answer.code, 0) << answer.err;
        const Columns run = history(folder);
        return run.at("mean_velocity_norm").back() * run.at("grains").back();
    }
};

TEST_F(SpheresThatTouch, FallOffAFixedOneWithAnyStep) {
    // The first contact, at y = 2.5, is on the border between two ranks.
    const std::string free = "1,1.43,2,1.57,free\n", above = "2,1.43,3,1.57,fixed\n",
                      beside = "2,0.83,2.64,1.09,fixed\n";
    const double alone = speed(free, "", "alone");
    ASSERT_GT(alone, 0.1);
    int k = 0;
    for (const std::string& fixed : {above, beside}) {
        const std::string name = "at" + std::to_string(++k);
        const double coarse = speed(free + fixed, "", name + "coarse");
        const double fine = speed(free + fixed, " --set time.step=0.005", name + "fine");
        EXPECT_NEAR(fine, coarse, 0.03 * coarse);
        EXPECT_GT(fine, 0.5 * alone);
        EXPECT_LT(fine, 0.95 * alone) << "the other one changes nothing";
        EXPECT_NEAR(speed(free + fixed, " --set fluid.ranks=2", name + "ranks"), coarse, 1e-7);
    }
}

TEST_F(SpheresThatTouch, RiseFromTheFloorWithAnyStep) {
    const std::string light = " --set grains.density_ratio=0.5";
    const std::string on_floor = "1,1.43,0.5,1.57,free\n";
    const double alone = speed("1,1.43,1.5,1.57,free\n", light, "alone");
    const double coarse = speed(on_floor, light, "coarse");
    const double fine = speed(on_floor, light + " --set time.step=0.005", "fine");
    EXPECT_NEAR(fine, coarse, 0.05 * coarse);
    EXPECT_GT(fine, 0.3 * alone) << "more than the wall slows it";
}

/// As from the floor (above), from a plate in the box.
TEST_F(SpheresThatTouch, RiseFromAPlateInside) {
    scratch.write("plate.csv",
                  "id,kind,x,y,z,ax,ay,az,bx,by,bz,thickness\n"
                  "1,plate,0,1,0,4,0,0,0,0,4,0.5\n");
    const std::string light = " --set grains.density_ratio=0.5",
                      inside = light + " --set domain.walls_file=plate.csv";
    const double from_floor = speed("1,1.43,0.5,1.57,free\n", light, "floor");
    const std::string on_plate = "1,1.43,1.75,1.57,free\n";
    const double coarse = speed(on_plate, inside, "coarse");
    // The fluid sees the plate a little thicker than it is, so that they overlap more.
    EXPECT_GT(coarse, 0.35 * from_floor);
    EXPECT_LT(coarse, from_floor);
    EXPECT_NEAR(speed(on_plate, inside + " --set time.step=0.005", "fine"), coarse, 0.08 * coarse);
    EXPECT_EQ(speed(on_plate, inside + " --set fluid.ranks=2", "ranks"), coarse);
}

/// Spheres in a drum with liquid, which turns: on one rank and two, in OpenFOAM and in the box
/// program, and in two parts.
class DrumWithLiquid : public SpaceFluid {
 protected:
    void SetUp() override {
        SpaceFluid::SetUp();
        write_drum("0.5", "1");
        // At its bottom and its sides, 0.01 D from the wall
        scratch.write("grains.csv",
                      "id,x,y,z\n1,2,1.56,0.6\n2,2,1.56,1.7\n3,2,1.56,2.8\n"
                      "4,2.85,2.1,1.1\n5,1.15,2.1,2.2\n");
    }
    void write_drum(const std::string& thickness, const std::string& spin) {
        scratch.write("drum.csv",
                      "id,kind,x,y,z,ax,ay,az,r1,thickness,wx,wy,wz\n"
                      "1,cylinder,2,2.5,0,0,0,4,1.7," +
                          thickness + ",0,0," + spin + "\n");
    }
    Answer play(const std::string& folder, const std::string& words) const {
        return turbidite(
            "run case.yaml --set domain.walls_file=drum.csv --set domain.left=wall"
            " --set domain.right=wall --set grains.file=grains.csv"
            " --set time.end=1.6 --set output.interval=0.2 --set checkpoint.interval=0.8"
            " --out " +
            folder + words);
    }
};

TEST_F(DrumWithLiquid, GivesTheSameNumbersEverywhere) {
    const Answer answer = play("foam", "");
    ASSERT_EQ(answer.code, 0) << answer.err;
    const Columns run = history("foam");
    double contacts = 0.0;
    for (const double count : run.at("contacts")) contacts = std::max(contacts, count);
    EXPECT_GT(contacts, 0.0);
    // They go with the drum, to the right at its bottom, and the liquid lifts none off the axis.
    EXPECT_GT(run.at("mean_velocity_x").back(), 0.02);
    const auto record = nlohmann::json::parse(text(scratch.path() / "foam/run.json"));
    EXPECT_LE(record["maxima"]["fluid_balance"].get<double>(), 1e-9);
    EXPECT_LE(record["maxima"]["grain_balance"].get<double>(), 1e-9);

    ASSERT_EQ(play("box", " --set fluid.program=box").code, 0);
    ASSERT_EQ(play("ranks", " --set fluid.program=box --set fluid.ranks=2").code, 0);
    ASSERT_EQ(play("parts", " --set fluid.program=box --set time.end=0.8").code, 0);
    ASSERT_EQ(turbidite("resume parts --set time.end=1.6").code, 0);
    EXPECT_EQ(lines_without_wall_times(text(scratch.path() / "parts/history.csv")),
              lines_without_wall_times(text(scratch.path() / "box/history.csv")));
    const Columns box = history("box"), ranks = history("ranks");
    for (const char* name : {"mean_velocity_x", "mean_velocity_y", "mean_position_y", "flow_x"})
        for (std::size_t row = 1; row < run.at(name).size(); ++row) {
            EXPECT_NEAR(box.at(name)[row], run.at(name)[row], 1e-8) << name << row;
            EXPECT_NEAR(ranks.at(name)[row], box.at(name)[row], 1e-8) << name << row;
        }
    write_drum("0.5", "0");
    ASSERT_EQ(play("rest", " --set fluid.program=box").code, 0);
    EXPECT_LT(history("rest").at("mean_velocity_x").back(), 0.01);
}

TEST_F(DrumWithLiquid, IsRefusedWhereTheLiquidWouldPass) {
    write_drum("0.2", "1");
    const Answer answer = play("thin", "");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "at least 2 cells, here 0.3334 D");
}

TEST_F(SpaceFluid, TheSurfaceThatTheFluidSeesChangesTheFall) {
    const std::string short_run = "run case.yaml --set time.end=2 --out ";
    ASSERT_EQ(turbidite(short_run + "shifted").code, 0);
    ASSERT_EQ(turbidite(short_run + "plain --set fluid.surface_shift=0").code, 0);
    const double shifted = history("shifted").at("mean_velocity_y").back();
    const double plain = history("plain").at("mean_velocity_y").back();
    EXPECT_LT(plain, shifted - 0.02) << "a smaller sphere falls faster";
}

}  // namespace
}  // namespace turbidite
