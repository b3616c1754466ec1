// SPDX-License-Identifier: LGPL-2.1-or-later
//
// Which program plays the fluid, on machines with and without OpenFOAM and with much and little
// memory.
#include <gtest/gtest.h>

#include <cstdlib>

#include "launcher/case/forecast/disk_cost.hpp"
#include "launcher/case/forecast/mesh_cost.hpp"
#include "launcher/case/forecast/run_cost.hpp"
#include "tests/unit/case/case_test.hpp"

namespace turbidite {
namespace {

class FluidProgramChoice : public CaseTest {
 protected:
    FluidProgramChoice()
        : CaseTest(
              "domain: {size: [8, 8, 8]}\n"
              "dimension: 3\n"
              "grains: {adapter: standalone-nscd, generator: random, count: 20}\n"
              "fluid: {reynolds: 36, cells_per_diameter: 12}\n"  // 0.885 M cells
              "time: {step: 0.01, end: 1}\n"),
          path_(std::getenv("PATH")) {}
    ~FluidProgramChoice() override { set_path(path_); }

    static void set_path(const std::string& path) { ::setenv("PATH", path.c_str(), 1); }

    /// An empty program of that name in PATH, or none.
    void let_openfoam_be(bool installed) const {
        const std::string bin = folder.path() / "bin";
        std::filesystem::create_directories(bin);
        if (installed) {
            folder.write("bin/blockMesh", "");
            std::filesystem::permissions(bin + "/blockMesh", std::filesystem::perms::owner_all);
        }
        set_path(bin);
    }

    std::string program(const std::vector<std::string>& set = {}) const {
        return load("", set).settings.text("fluid.program");
    }

    std::string notes(const std::vector<std::string>& set = {}) const {
        std::string all;
        for (const std::string& note : load("", set).notes) all += note + "\n";
        return all;
    }

 private:
    std::string path_;
};

TEST_F(FluidProgramChoice, IsOpenFoamWhereItIsInstalledAndFits) {
    let_openfoam_be(true);
    EXPECT_EQ(program(), "openfoam");
    EXPECT_EQ(program({"fluid.program=openfoam"}), "openfoam");
    EXPECT_EQ(program({"fluid.program=box"}), "box");
    EXPECT_EQ(notes().find("fluid.program"), std::string::npos);
    EXPECT_SAYS(refusal("", {"fluid.program=foam"}), "fluid.program = foam");
}

TEST_F(FluidProgramChoice, IsBoxWithoutOpenFoam) {
    let_openfoam_be(false);
    EXPECT_EQ(program(), "box");
    EXPECT_SAYS(notes(),
                "OpenFOAM is not installed (there is no blockMesh in PATH): "
                "fluid.program: auto is box here");
    EXPECT_EQ(program({"fluid.program=openfoam"}), "openfoam") << "as asked for";
    EXPECT_EQ(program({"fluid.enabled=false"}), "openfoam") << "of no effect";
    // What box cannot play stays OpenFOAM's, and the user is told why.
    folder.write("f.txt", "probes { type probes; }\n");
    EXPECT_EQ(program({"fluid.functions=f.txt"}), "openfoam");
    EXPECT_SAYS(notes({"fluid.functions=f.txt"}),
                "fluid.program: box cannot play a case with fluid.functions = ");
}

TEST_F(FluidProgramChoice, IsBoxWhereOpenFoamsMeshDoesNotFit) {
    let_openfoam_be(true);
    const Settings settings = load().settings;
    const double large = fluid_memory(settings, FluidProgram::openfoam);
    const double small = fluid_memory(settings, FluidProgram::box);
    ASSERT_LT(small, 0.7 * large);
    const auto limit = [](double gigabytes) {
        return "limits.memory=" + std::to_string(gigabytes);
    };
    EXPECT_EQ(program({limit(1.01 * large)}), "openfoam");
    EXPECT_EQ(program({limit(0.99 * large)}), "box");
    EXPECT_SAYS(notes({limit(0.99 * large)}), "fluid.program: auto is box here");
    EXPECT_SAYS(notes({limit(0.99 * large)}), "OpenFOAM would take about 0.8");
    EXPECT_SAYS(refusal("", {limit(0.99 * large), "fluid.program=openfoam"}),
                "fluid.program: box would take about 0.");
    EXPECT_SAYS(refusal("", {limit(0.99 * small)}), "takes about 0.8") << "neither fits";
    EXPECT_SAYS(refusal("", {limit(0.99 * small), "fluid.program=box"}), "takes about 0.");
}

TEST_F(FluidProgramChoice, BoxRefusesWhatOnlyOpenFoamCanDo) {
    const auto box = [&](std::vector<std::string> set) {
        set.push_back("fluid.program=box");
        return refusal("", set);
    };
    EXPECT_EQ(box({}), "");
    folder.write("f.txt", "probes { type probes; }\n");
    EXPECT_SAYS(box({"fluid.functions=f.txt"}), "function objects are OpenFOAM's");
    EXPECT_SAYS(box({"fluid.functions=f.txt"}), "Remove it, or fluid.program: openfoam.");
    const std::vector<std::string> plane = {"dimension=2", "domain.size=[8, 8]"};
    for (const char* shape : {"disc", "triangle"}) {
        std::vector<std::string> set = plane;
        set.push_back(std::string("grains.shape=") + shape);
        EXPECT_SAYS(box(set), "cannot play a case with dimension = 2: it plays boxes in space");
    }
    EXPECT_SAYS(box({"grains.shape=triangle"}), "In space grains are spheres");
    EXPECT_EQ(
        box({"dimension=2", "domain.size=[8, 8]", "grains.shape=disc", "fluid.enabled=false"}), "");
}

TEST_F(FluidProgramChoice, IsOfTheForecast) {
    let_openfoam_be(true);
    const std::vector<std::string> box = {"fluid.program=box"};
    const ResolvedCase by_openfoam = load(), by_box = load("", box);
    const double saved = fluid_memory(by_openfoam.settings) - fluid_memory(by_box.settings);
    EXPECT_GT(saved, 0.2);
    EXPECT_NEAR(predicted_memory(by_openfoam) - predicted_memory(by_box), saved, 1e-12);
    EXPECT_LT(predicted_seconds(by_box), predicted_seconds(by_openfoam) - 4.0) << "no blockMesh";
    const double mesh = 150e-9 * fluid_cells(by_box.settings);
    EXPECT_GT(predicted_disk(by_openfoam) - predicted_disk(by_box), mesh);
}

/// Growth of the peak of resident memory with the cells, in bytes per cell.
TEST_F(FluidProgramChoice, BoxIsForeseenWithTheMemoryThatWasMeasured) {
    const auto per_cell = [this](const char* order, const char* splitting, const char* ranks) {
        const Settings s = load("", {"fluid.program=box", std::string("fluid.time_scheme=") + order,
                                     std::string("fluid.splitting=") + splitting,
                                     std::string("fluid.ranks=") + ranks,
                                     "fluid.transport_scheme=Gauss limitedLinearV 1"})
                               .settings;
        return (1e9 * fluid_memory(s) - 5e7) / fluid_cells(s);
    };
    const char *first = "first-order", *second = "second-order";
    const char *plain = "marchuk-yanenko", *rigid = "explicit-multiplier";
    EXPECT_GE(per_cell(first, plain, "1"), 87.0);
    EXPECT_GE(per_cell(first, plain, "2"), 123.0);
    EXPECT_GE(per_cell(first, plain, "4"), 125.0);
    EXPECT_GE(per_cell(second, plain, "1"), 207.0) << "in several parts";
    EXPECT_GE(per_cell(second, plain, "2"), 238.0);
    EXPECT_GE(per_cell(second, rigid, "1"), 255.0);
    EXPECT_GE(per_cell(second, rigid, "2"), 292.0);
    EXPECT_LT(per_cell(second, rigid, "2"), 1.25 * 292.0);
}

TEST_F(FluidProgramChoice, StaysInTheResolvedCase) {
    let_openfoam_be(false);
    const std::string yaml = load().yaml;
    EXPECT_SAYS(yaml, "program: box");
}

}  // namespace
}  // namespace turbidite
