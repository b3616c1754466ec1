// SPDX-License-Identifier: GPL-3.0-or-later
//
// The fluid's folder is an OpenFOAM case: OpenFOAM's own programs read it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "fluid_adapter/foam_case/fluid_case.hpp"
#include "tests/physics/coupled_run.hpp"

namespace turbidite {
namespace {

std::string text_of(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// Exit status of a program run on the case, with its output in `log`.
int run_on(const std::filesystem::path& folder, const std::string& program,
           const std::filesystem::path& log) {
    const std::string command =
        program + " -case '" + folder.string() + "' > '" + log.string() + "' 2>&1";
    return std::system(command.c_str());
}

TEST(CaseFiles, FoamToVtkReadsTheCase) {
    CoupledSetup setup;
    setup.top = "free";
    setup.gravity = 10.0;
    CoupledRun run(setup, {disc_at(setup, 2.0, 2.0)});
    run.advance();
    run.advance(true);
    const std::filesystem::path log = run.folder() / "foamToVTK.log";
    ASSERT_EQ(run_on(run.folder(), "foamToVTK", log), 0) << text_of(log);
    const std::string said = text_of(log);
    for (const char* expected : {"Time: 0\n", "Time: 0.02\n", "U", "p", "lambda"})
        EXPECT_NE(said.find(expected), std::string::npos) << expected << " not in\n" << said;
}

TEST(CaseFiles, CheckMeshIsContentWithCyclicAndFreeSides) {
    CoupledSetup setup;
    setup.left = setup.right = "cyclic";
    setup.top = "free";
    const TemporaryFolder folder;
    write_fluid_case(settings_of(setup), folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    const std::filesystem::path log = folder.path() / "checkMesh.log";
    ASSERT_EQ(run_on(folder.path(), "checkMesh", log), 0);
    EXPECT_NE(text_of(log).find("Mesh OK."), std::string::npos) << text_of(log);
    // 4 D x 4 D at D/16.
    EXPECT_NE(text_of(log).find("cells:            4096"), std::string::npos) << text_of(log);
}

TEST(CaseFiles, ABrokenMeshFileIsReportedWithTheMessageOfBlockMesh) {
    const TemporaryFolder folder;
    write_fluid_case(settings_of({}), folder.path());
    std::ofstream(folder.path() / "system" / "blockMeshDict") << "nonsense";
    try {
        build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::participant_failed);
        EXPECT_NE(std::string(failure.what()).find("FOAM FATAL"), std::string::npos)
            << failure.what();
    }
}

TEST(CaseFiles, AMissingCaseIsAFailureAndNoAbort) {
    FoamAdapter adapter("/no/such/case");
    EXPECT_THROW(adapter.initialise(settings_of({}), {ShapeRecord{"disc", {}}}), Failure);
}

TEST(CaseFiles, AnUnknownSchemeIsAFailureWithTheMessageOfOpenFoam) {
    Settings settings = settings_of({});
    settings.set("fluid.transport_scheme", std::string("Gauss nosuchscheme"));
    const TemporaryFolder folder;
    write_fluid_case(settings, folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    FoamAdapter adapter(folder.path());
    adapter.initialise(settings, {ShapeRecord{"disc", {}}});
    try {
        adapter.advance({0, 0.0, 0.01, false});
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_NE(std::string(failure.what()).find("nosuchscheme"), std::string::npos)
            << failure.what();
    }
}

TEST(CaseFiles, AMeshOfAnotherSizeIsRefused) {
    const TemporaryFolder folder;
    write_fluid_case(settings_of({}), folder.path());
    build_fluid_mesh(folder.path(), folder.path() / "blockMesh.log");
    CoupledSetup other;
    other.cells_per_diameter = 8;
    FoamAdapter adapter(folder.path());
    EXPECT_THROW(adapter.initialise(settings_of(other), {ShapeRecord{"disc", {}}}), Failure);
}

TEST(CaseFiles, OneCyclicSideAloneIsRefused) {
    Settings settings = settings_of({});
    settings.set("domain.left", std::string("cyclic"));
    const TemporaryFolder folder;
    try {
        write_fluid_case(settings, folder.path());
        FAIL();
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(failure.what()).find("domain.left"), std::string::npos);
    }
}

}  // namespace
}  // namespace turbidite
