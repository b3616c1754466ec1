// SPDX-License-Identifier: LGPL-2.1-or-later
//
// A case that starts from the grains of another run, written here in the coupler's format.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

std::string array(const char* name, const std::string& numbers) {
    return fmt::format(
        "<DataArray type=\"Float64\" Name=\"{}\" format=\"ascii\">\n{}\n</DataArray>\n", name,
        numbers);
}

/// Two discs of the materials default and steel, the first one moved by `shift`.
std::string points(double shift, const std::string& ids = "7\n9") {
    return array("position", fmt::format("{} 2 0\n5 5 0", 2.0 + shift)) + array("id", ids) +
           array("shape", "0\n0") + array("material", "0\n1") + array("prescribed", "0\n1") +
           array("radius", "0.5\n0.4") + array("density", "2\n3") +
           array("orientation", "0.8 0 0 0.6\n1 0 0 0") + array("velocity", "0.5 -1 0\n0 0 0") +
           array("angular_velocity", "0 0 4\n0 0 0");
}

class EarlierRuns : public CaseTest {
 protected:
    EarlierRuns()
        : CaseTest(
              "domain: {size: [10, 20]}\n"
              "grains: {adapter: standalone-nscd}\n"
              "fluid: {enabled: false}\n"
              "contact: {materials: {steel: {friction: 0.1}}}\n"
              "time: {step: 0.01, end: 1}\n") {
        const ResolvedCase earlier = load("", {"grains.count=2"});
        folder.write("old/case.yaml", earlier.yaml);
        folder.write("old/grains/initial.csv", earlier.grains_csv);
        folder.write("old/grains/grains.pvd",
                     "<DataSet timestep=\"0\" part=\"0\" file=\"a.vtp\"/>\n"
                     "<DataSet timestep=\"0.5\" part=\"0\" file=\"b.vtp\"/>\n"
                     "<DataSet timestep=\"0.5\" part=\"1\" file=\"outlines.vtp\"/>\n");
        folder.write("old/grains/a.vtp", points(0.0));
        folder.write("old/grains/b.vtp", points(1.5));
    }

    /// A case without grains of its own, which is valid only with --from.
    void write_case() const { EXPECT_SAYS(refusal(""), "grains.count is missing"); }

    ResolvedCase start(const std::string& time, const std::vector<std::string>& set = {}) const {
        return load_case(folder.path() / "box.yaml", set, (folder.path() / "old").string() + time);
    }

    std::string refusal_of(const std::string& time) const {
        try {
            start(time);
        } catch (const Failure& failure) {
            EXPECT_EQ(failure.code(), ExitCode::bad_input);
            return failure.what();
        }
        return "";
    }
};

// The case itself gives no number of grains, and need not.
TEST_F(EarlierRuns, GrainsAreThoseOfTheEnd) {
    write_case();
    const ResolvedCase later = start("");
    ASSERT_EQ(later.population.size(), 2u);
    const GrainState &first = later.population[0], &second = later.population[1];
    EXPECT_EQ(first.id, 7);
    EXPECT_EQ(first.position, (Vec3{3.5, 2.0, 0.0}));
    EXPECT_EQ(first.velocity, (Vec3{0.5, -1.0, 0.0}));
    EXPECT_EQ(first.angular_velocity[2], 4.0);
    EXPECT_EQ(first.density, 2.0);
    EXPECT_NEAR(first.orientation[3], 0.6, 1e-15);
    EXPECT_EQ(second.radius, 0.4);
    EXPECT_EQ(second.material, 1);
    EXPECT_TRUE(second.prescribed);
    EXPECT_SAYS(later.notes.at(0), "b.vtp at 0.5 t_c");
    EXPECT_EQ(later.settings.text("grains.file"), "grains/initial.csv");
}

TEST_F(EarlierRuns, ATimeBeforeTheEndIsChosenWithAt) {
    write_case();
    EXPECT_EQ(start("@0").population.at(0).position[0], 2.0);
    EXPECT_EQ(start("@0.5").population.at(0).position[0], 3.5);
}

// Densities 2 and 3 and radii 0.5 and 0.4 are theirs, whatever the case says.
TEST_F(EarlierRuns, WhatTheGrainsKeepIsTold) {
    write_case();
    const auto told = [&](const std::vector<std::string>& set) {
        std::string all;
        for (const std::string& note : start("", set).notes) all += note + "\n";
        return all;
    };
    EXPECT_SAYS(told({"grains.density_ratio=8"}),
                "keep the density ratio of the earlier run, 2 to 3; grains.density_ratio = 8");
    EXPECT_SAYS(told({"grains.radius=0.3", "grains.density_ratio=2.5"}),
                "keep the radius of the earlier run, 0.4 to 0.5; grains.radius = 0.3");
    EXPECT_EQ(told({"grains.density_ratio=2.5"}).find("keep"), std::string::npos);
}

// A double has 2^53 + 1 as 2^53.
TEST_F(EarlierRuns, IdsKeepAllTheirDigits) {
    write_case();
    folder.write("old/grains/b.vtp", points(1.5, "9007199254740992\n9007199254740993"));
    const ResolvedCase later = start("");
    ASSERT_EQ(later.population.size(), 2u);
    EXPECT_EQ(later.population[1].id, 9007199254740993);
    EXPECT_SAYS(later.grains_csv, "\n9007199254740993,");
}

TEST_F(EarlierRuns, AnOutputWithoutGrainsIsNoStart) {
    write_case();
    folder.write("old/grains/b.vtp", points(20.0).replace(points(20.0).find("5 5 0"), 5, "30 5 0"));
    EXPECT_EQ(start("@0", {"domain.right=free"}).population.size(), 2u);
    try {
        start("", {"domain.right=free"});
        FAIL() << "a run of no grains";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_input);
        EXPECT_SAYS(std::string(failure.what()), "b.vtp holds no grain inside the box");
    }
}

// The coupler reads what `turbidite run` writes.
TEST_F(EarlierRuns, TheNewRunFolderHoldsThem) {
    write_case();
    const ResolvedCase later = start("");
    folder.write("new/case.yaml", later.yaml);
    folder.write("new/grains/initial.csv", later.grains_csv);
    const ResolvedCase read = load_run_folder(folder.path() / "new");
    ASSERT_EQ(read.population.size(), 2u);
    EXPECT_EQ(read.population[0].velocity, later.population[0].velocity);
    EXPECT_EQ(read.population[0].angular_velocity, later.population[0].angular_velocity);
    EXPECT_EQ(read.population[1].prescribed, true);
    EXPECT_EQ(read.settings.real("grains.overlap"), 0.2);  // limits.penetration
}

// Programs may let positions run on across cyclic sides.
TEST_F(EarlierRuns, PositionsBeyondACyclicSideAreWrapped) {
    write_case();
    const std::vector<std::string> cyclic = {"domain.left=cyclic", "domain.right=cyclic"};
    const ResolvedCase inside = start("", cyclic);
    folder.write("old/grains/b.vtp", points(1.5 + 30.0));
    const ResolvedCase later = start("", cyclic);
    ASSERT_EQ(later.population.size(), inside.population.size());
    for (std::size_t i = 0; i < inside.population.size(); ++i)
        EXPECT_NEAR(later.population[i].position[0], inside.population[i].position[0], 1e-12);
}

// An output shows a grain until no part of it is inside.
TEST_F(EarlierRuns, GrainsBeyondAFreeSideAreLeftOut) {
    write_case();
    const ResolvedCase later = start("", {"domain.size=[4.9, 20]", "domain.right=free"});
    ASSERT_EQ(later.population.size(), 1u);
    EXPECT_EQ(later.population[0].id, 7);
    EXPECT_SAYS(later.notes.at(1), "1 of them, which were beyond a free side, left out");
}

TEST_F(EarlierRuns, WhatIsNotThereIsNamed) {
    write_case();
    EXPECT_SAYS(refusal_of("@0.4"), "has no output at 0.4 t_c");
    EXPECT_SAYS(refusal_of("@0.4"), "There are 2 from 0 to 0.5 t_c; the nearest is @0.5.");
    EXPECT_SAYS(refusal_of("@end"), "\"end\" is not a time");
    EXPECT_SAYS(refusal_of("er"), "is not a run folder: it has no case.yaml");
}

TEST_F(EarlierRuns, ShapesAndMaterialsMustBeKnown) {
    folder.write("box.yaml",
                 "domain: {size: [10, 20]}\ngrains: {adapter: standalone-nscd}\n"
                 "fluid: {enabled: false}\ntime: {step: 0.01, end: 1}\n");
    EXPECT_SAYS(refusal_of(""), "grains of material steel, which the case does not have");
}

}  // namespace
}  // namespace turbidite
