// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The same case with both hosts of the contact engine: YADE's treatment of bodies (its own axes,
// through which orientations are converted) changes no bit.
#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/system/program.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

constexpr auto triangles = R"(
domain: {size: [9, 14]}
grains: {shape: triangle, generator: random, count: 24, density_ratio: 1.5}
fluid: {enabled: false}
contact: {friction: 0.3, restitution: 0.2}
time: {step: 0.005, end: 6}
output: {interval: 0.5}
)";

class Hosts : public ShellTest {
 protected:
    /// The rows of history.csv up to pore_volume; the columns after it are times.
    std::vector<std::string> physics(const std::string& adapter) {
        const Answer answer =
            shell(program + " run case.yaml --set grains.adapter=" + adapter + " --out " + adapter);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        std::istringstream history(text(scratch.path() / adapter / "history.csv"));
        std::vector<std::string> rows;
        for (std::string row; std::getline(history, row);) {
            std::size_t end = 0;
            for (int column = 0; column < 19; ++column) end = row.find(',', end) + 1;
            rows.push_back(row.substr(0, end));
        }
        return rows;
    }
};

TEST_F(Hosts, TrianglesFallTheSameInYadeAndAlone) {
    scratch.write("case.yaml", triangles);
    const auto in_yade = physics("yade-nscd"), alone = physics("standalone-nscd");
    ASSERT_EQ(in_yade.size(), 14u);  // a header, then t = 0, 0.5, ..., 6
    EXPECT_NE(in_yade[1], in_yade[13]);
    EXPECT_EQ(in_yade, alone);
}

// As in containers and units of systemd.
TEST_F(Hosts, YadeStartsWithoutAHome) {
    scratch.write("case.yaml", triangles);
    const Answer answer = shell("env -u HOME " + program +
                                " run case.yaml --set grains.adapter=yade-nscd --set time.end=0.1");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
}

// One plate at rest, one that rotates about its middle.
TEST_F(Hosts, PlatesInsideTheBoxActTheSame) {
    scratch.write("walls.csv",
                  "id,x1,y1,x2,y2,vx,vy,spin,px,py\n1,1,3,5,2,0,0,0,3,2.5\n"
                  "2,5,5,8,6,0,0,0.5,6.5,5.5\n");
    std::string grains = "id,x,y\n";
    for (int k = 0; k < 15; ++k)
        grains += std::to_string(k) + "," + std::to_string(1.2 + 1.5 * (k % 5)) + "," +
                  std::to_string(7.0 + 1.5 * (k / 5)) + "\n";
    scratch.write("grains.csv", grains);
    scratch.write("case.yaml",
                  "domain: {size: [9, 14], walls_file: walls.csv}\n"
                  "grains: {shape: triangle, file: grains.csv, density_ratio: 1.5}\n"
                  "fluid: {enabled: false}\ncontact: {friction: 0.3}\n"
                  "time: {step: 0.005, end: 4}\noutput: {interval: 1}\n");
    const auto in_yade = physics("yade-nscd"), alone = physics("standalone-nscd");
    ASSERT_EQ(in_yade.size(), 6u);
    EXPECT_EQ(in_yade, alone);
}

/// A column of a history by name, at each of its rows.
std::vector<double> column(const std::string& history, const std::string& name) {
    std::istringstream rows(history);
    std::string row, cell;
    std::getline(rows, row);
    std::istringstream header(row);
    int index = 0;
    while (std::getline(header, cell, ',') && cell != name) ++index;
    EXPECT_EQ(cell, name);
    std::vector<double> values;
    while (std::getline(rows, row)) {
        std::istringstream cells(row);
        for (int k = 0; k <= index; ++k) std::getline(cells, cell, ',');
        values.push_back(std::stod(cell));
    }
    return values;
}

// A disc on a belt slides at mu g until it rolls with a third of the belt's speed (V/3 after
// V/(3 mu g) = 1.5); another lies on a plate that rises. Means are over both.
TEST_F(Hosts, MovingWallsDragAndLift) {
    scratch.write("walls.csv",
                  "id,x1,y1,x2,y2,vx,vy,spin,friction\n1,0.5,3,7,3,0.9,0,0,0.2\n"
                  "2,9,3,11,3,0,0.3,0,0.2\n");
    scratch.write("grains.csv", "id,x,y\n1,3,3.5\n2,10,3.5\n");
    scratch.write("case.yaml",
                  "domain: {size: [12, 14], walls_file: walls.csv}\n"
                  "grains: {file: grains.csv, density_ratio: 1.5}\n"
                  "fluid: {enabled: false}\ncontact: {friction: 0.5, tolerance: 1e-10}\n"
                  "time: {step: 0.01, end: 3}\noutput: {interval: 0.5}\n");
    const auto in_yade = physics("yade-nscd"), alone = physics("standalone-nscd");
    EXPECT_EQ(in_yade, alone);
    const std::string history = text(scratch.path() / "standalone-nscd" / "history.csv");
    const std::vector<double> vx = column(history, "mean_velocity_x"),
                              vy = column(history, "mean_velocity_y");
    ASSERT_EQ(vx.size(), 7u);  // t = 0, 0.5, ..., 3
    for (std::size_t k = 1; k < vx.size(); ++k) {
        EXPECT_NEAR(vx[k], 0.5 * std::min(0.2 * 0.5 * static_cast<double>(k), 0.3), 1e-6) << k;
        EXPECT_NEAR(vy[k], 0.5 * 0.3, 1e-6) << k;
    }
}

// The floor shakes along itself under discs of two materials, one of them without friction.
TEST_F(Hosts, MaterialsOnAShakenFloorActTheSame) {
    scratch.write("grains.csv",
                  "id,x,y,vx,material\n0,2,0.5,0,default\n1,4,0.5,0,ice\n2,6,0.5,0,default\n"
                  "3,6.5,1.367,0,default\n4,7.1,0.5,0,default\n");
    const std::string shaken = R"(
domain:
  size: [8, 8]
  bottom_motion: shake
  motions:
    shake: {kind: harmonic, amplitude: [0.2, 0], period: 2}
grains: {file: grains.csv, density_ratio: 1.5}
fluid: {enabled: false}
contact: {friction: 0.5, materials: {ice: {friction: FRICTION}}}
time: {step: 0.01, end: 3}
output: {interval: 0.5}
)";
    const auto with_friction = [&](const std::string& value) {
        std::string words = shaken;
        scratch.write("case.yaml", words.replace(words.find("FRICTION"), 8, value));
    };
    with_friction("0");
    const auto in_yade = physics("yade-nscd"), alone = physics("standalone-nscd");
    ASSERT_EQ(in_yade.size(), 8u);
    EXPECT_EQ(in_yade, alone);
    EXPECT_NE(alone[1], alone[7]);  // the floor drags some of them along
    with_friction("0.5");
    EXPECT_NE(physics("standalone-nscd --force"), alone);  // the friction of ice matters
}

}  // namespace
}  // namespace turbidite
