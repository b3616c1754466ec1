// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Cases that no contact engine can run: `check` and `run` refuse them by name, and `run` starts
// nothing.
#include <vector>

#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

constexpr auto dry_case =
    "domain: {size: [12, 24]}\n"
    "grains: {adapter: standalone-nscd, count: 5}\n"
    "fluid: {enabled: false}\n"
    "time: {step: 0.01, end: 1}\n";

class BadInput : public ShellTest {
 protected:
    void SetUp() override { scratch.write("case.yaml", dry_case); }

    /// Both commands refuse the case with these keys set, with these words.
    void expect_refused(const std::vector<std::string>& set,
                        const std::vector<std::string>& words) const {
        std::string arguments = " case.yaml";
        for (const std::string& key : set) arguments += " --set '" + key + "'";
        for (const std::string& command : {"check" + arguments, "run" + arguments + " --out run"}) {
            SCOPED_TRACE(command);
            const Answer answer = shell(std::string(TURBIDITE_PROGRAM) + " " + command);
            EXPECT_EQ(answer.code, 2);
            for (const std::string& said : words) EXPECT_SAYS(answer.err, said);
            EXPECT_FALSE(std::filesystem::exists(run_folder()));
        }
    }
};

TEST_F(BadInput, PolygonsThatAreDegenerateOrConcave) {
    const std::string shape = "grains.shape=polygon", vertices = "grains.vertices=";
    expect_refused({shape, vertices + "[0, 0, 1, 1, 2, 2]"}, {"grains.vertices", "area is zero"});
    expect_refused({shape, vertices + "[0, 0, 2, 0, 1, 0.5, 2, 2, 0, 2]"},
                   {"vertex 3 (1, 0.5) makes it concave"});
}

TEST_F(BadInput, PackingsThatOverlap) {
    scratch.write("discs.csv", "id,x,y\n4,6,6\n9,6.75,6\n");
    expect_refused({"grains.file=discs.csv"},
                   {"discs.csv line 3: grains 4 and 9 overlap by 0.25 D"});
    scratch.write("triangles.csv", "id,x,y,shape,angle\n1,3,3,triangle,0\n2,3,2,triangle,0\n");
    expect_refused({"grains.file=triangles.csv"}, {"grains 1 and 2 overlap by 0.125 D"});
}

TEST_F(BadInput, GrainsWithoutMass) {
    scratch.write("points.csv", "id,x,y,radius\n4,6,6,0.5\n9,3,6,0\n");
    expect_refused({"grains.file=points.csv"}, {"points.csv line 3: grain 9: radius = 0"});
    expect_refused({"grains.density_ratio=0"}, {"grains.density_ratio = 0"});
    expect_refused({"grains.radius=0"}, {"grains.radius = 0"});
}

TEST_F(BadInput, LawsThatCannotBe) {
    expect_refused({"contact.friction=-0.1"}, {"contact.friction = -0.1", "zero or positive"});
    expect_refused(
        {"contact.law=static-dynamic"},
        {"contact.static_friction is missing (needed with contact.law: static-dynamic)"});
    expect_refused({"contact.adhesion=cohesion"},
                   {"contact.adhesion_force is missing", "contact.adhesion_shear is missing"});
}

TEST_F(BadInput, ImpossibleWalls) {
    scratch.write("walls.csv", "id,x1,y1,x2,y2,friction\n1,3,3,3,3,0.3\n2,3,4,5,4,-1\n");
    expect_refused({"domain.walls_file=walls.csv"},
                   {"walls.csv line 2: wall 1 has length 0", "friction = -1"});
}

// All errors are reported at once, not one after the other.
TEST_F(BadInput, IsReportedTogether) {
    expect_refused(
        {"contact.friction=-0.1", "grains.density_ratio=0", "contact.law=static-dynamic"},
        {"contact.friction = -0.1", "grains.density_ratio = 0",
         "contact.static_friction is missing", "3 errors"});
}

}  // namespace
}  // namespace turbidite
