// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Keys that are given but have no effect are reported with the reason; keys with an effect are not.
#include <gtest/gtest.h>

#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class IdleKeys : public CaseTest {
 protected:
    IdleKeys()
        : CaseTest(
              "domain: {size: [12, 24]}\n"
              "grains: {count: 20}\n"
              "fluid: {reynolds: 36}\n"
              "time: {step: 0.01, end: 1}\n") {}

    std::string notes(const std::vector<std::string>& set) const {
        std::string all;
        for (const std::string& note : load("", set).notes) all += note + "\n";
        return all;
    }

    bool quiet(const std::vector<std::string>& set) const {
        return notes(set).find("no effect") == std::string::npos;
    }
};

TEST_F(IdleKeys, AreNamedWithTheReason) {
    const struct {
        std::vector<std::string> set;
        const char* note;
    } cases[] = {
        {{"fluid.enabled=false"}, "fluid.reynolds has no effect without a fluid"},
        {{"fluid.enabled=false", "fluid.ranks=2"},
         "fluid.ranks, fluid.reynolds have no effect without a fluid"},
        {{"grains.generator=lattice"},
         "grains.count has no effect without grains.generator: random"},
        {{"grains.compacity=0.8"},
         "grains.compacity has no effect without grains.generator: lattice"},
        {{"grains.generator=lattice", "random.seed=4"}, "random.seed has no effect"},
        {{"coupling.scheme=split", "coupling.tolerance=0.001"},
         "coupling.tolerance has no effect with coupling.scheme: split"},
        {{"coupling.positions=contact"},
         "coupling.positions has no effect with coupling.scheme: joint"},
        {{"fluid.pressure_tolerance=1e-7"},
         "fluid.pressure_tolerance has no effect with fluid.pressure_solver: FFT"},
        {{"fluid.viscous_tolerance=1e-7"},
         "fluid.viscous_tolerance has no effect with fluid.viscous_solver: FFT"},
        {{"fluid.decomposition=columns"}, "fluid.decomposition has no effect with fluid.ranks: 1"},
        {{"fluid.points=interior", "fluid.point_spacing=2"},
         "fluid.point_spacing has no effect with fluid.points: interior"},
        {{"contact.adhesion_length=0.1"}, "without contact.adhesion: capillary"},
        {{"contact.restitution_speed=0.1"}, "contact.restitution_speed has no effect"},
        {{"contact.md_overlap=0.01"},
         "contact.md_overlap has no effect with grains.adapter: yade-nscd"},
        {{"grains.adapter=yade-md", "contact.tolerance=0.01"},
         "contact.tolerance has no effect with grains.adapter: yade-md"},
        {{"scales.compacity=0.1"}, "scales.compacity has no effect with scales.kind: avalanche"},
        {{"scales.viscosity=0.1"}, "scales.viscosity has no effect without scales.kind: physical"},
        // Also if the value is the default, since it was given on purpose.
        {{"coupling.scheme=split", "coupling.iterations=10"}, "coupling.iterations has no effect"},
    };
    for (const auto& one : cases) EXPECT_SAYS(notes(one.set), one.note);
}

TEST_F(IdleKeys, AreNotNamedWhereTheyHaveOne) {
    const std::string dry = notes({"fluid.enabled=false", "limits.grain_balance_hard=1e-3"});
    EXPECT_EQ(dry.find("limits."), std::string::npos) << dry;
    EXPECT_TRUE(quiet({}));
    EXPECT_TRUE(quiet({"coupling.scheme=joint", "coupling.tolerance=0.001"}));
    EXPECT_TRUE(quiet({"fluid.pressure_solver=GAMG", "fluid.pressure_tolerance=1e-7"}));
    EXPECT_TRUE(quiet({"fluid.viscous_solver=PCG", "fluid.viscous_tolerance=1e-7"}));
    EXPECT_TRUE(quiet({"fluid.ranks=2", "fluid.decomposition=columns"}));
    EXPECT_TRUE(
        quiet({"contact.materials.steel.restitution=0.5", "contact.restitution_speed=0.1"}));
    EXPECT_TRUE(quiet({"scales.kind=sedimentation", "scales.compacity=0.1"}));
}

// The case of a run folder contains every key; none of them was given on purpose.
TEST_F(IdleKeys, AResolvedCaseIsQuiet) {
    const ResolvedCase first = load("", {"grains.adapter=standalone-nscd"});
    folder.write("case.yaml", first.yaml);
    for (const std::string& note : load_case(folder.path() / "case.yaml").notes)
        EXPECT_EQ(note.find("fluid.pressure_tolerance"), std::string::npos) << note;
}

}  // namespace
}  // namespace turbidite
