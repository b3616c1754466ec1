// SPDX-License-Identifier: LGPL-2.1-or-later
#include "launcher/job/launch_line.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "launcher/case/keys/keys.hpp"

namespace turbidite {
namespace {

LaunchSite site(bool as_root) {
    return {.programs = {.folder = "/b/bin", .library = "/b/lib", .source = "/s"},
            .as_root = as_root,
            .openfoam = "/usr/share/openfoam",
            .python = {}};
}

Settings settings(const std::string& adapter, bool wet) {
    Settings result;
    result.set("grains.command", std::string("my-code --fast 'a b'"));
    result.set("grains.adapter", adapter);
    result.set("grains.ranks", std::int64_t{1});
    result.set("fluid.enabled", wet);
    result.set("fluid.ranks", std::int64_t{1});
    return result;
}

const std::string front =
    "mpirun --allow-run-as-root --oversubscribe --bind-to none "
    "--mca btl_vader_single_copy_mechanism none ";
// Each part of an MPMD line has its own -x: mpirun does not apply them beyond the colon.
const std::string exported =
    "-x WM_PROJECT_DIR=/usr/share/openfoam -x OMP_NUM_THREADS=1 -x "
    "PYTHONPATH=/b/lib/yade:/b/lib/python ";

TEST(LaunchLine, WetWithYade) {
    EXPECT_EQ(shell_line(launch_arguments(settings("yade-nscd", true), {"/r"}, site(true))),
              front + exported + "-n 1 /b/bin/turbidite-member /r coupler 0 1 " +
                  "/b/bin/turbidite-coupler /r : " + exported +
                  "-n 1 /b/bin/turbidite-member /r fluid 1 1 " +
                  "/b/bin/turbidite-fluid -case /r/fluid : " + exported +
                  "-n 1 /b/bin/turbidite-member /r grains 2 1 " +
                  "/usr/bin/yade -n -x /b/lib/yade/turbidite_yade_nscd.py /r");
}

TEST(LaunchLine, AnExternalProgramGetsItsArgumentsAndTheRunFolder) {
    const std::string line =
        shell_line(launch_arguments(settings("external", true), {"/r"}, site(true)));
    EXPECT_NE(line.find("/b/bin/turbidite-member /r grains 2 1 my-code --fast 'a b' /r"),
              std::string::npos)
        << line;
}

TEST(LaunchLine, TheUsersPythonPathIsKept) {
    LaunchSite with_path = site(true);
    with_path.python = "/u/py";
    const std::string line =
        shell_line(launch_arguments(settings("yade-nscd", true), {"/r"}, with_path));
    EXPECT_NE(line.find(":/b/lib/python:/u/py "), std::string::npos) << line;
}

TEST(LaunchLine, DryWithoutYade) {
    EXPECT_EQ(shell_line(launch_arguments(settings("standalone-nscd", false), {"/r"}, site(true))),
              front + exported + "-n 1 /b/bin/turbidite-member /r coupler 0 1 " +
                  "/b/bin/turbidite-coupler /r : " + exported +
                  "-n 1 /b/bin/turbidite-member /r grains 1 1 /b/bin/turbidite-grains /r");
}

TEST(LaunchLine, RootIsMentionedOnlyForRoot) {
    const auto line = launch_arguments(settings("yade-nscd", true), {"/r"}, site(false));
    EXPECT_EQ(line.at(1), "--oversubscribe");
}

TEST(LaunchLine, SeveralFluidRanksAreParallel) {
    Settings several = settings("standalone-nscd", true);
    several.set("fluid.ranks", std::int64_t{3});
    const std::string line = shell_line(launch_arguments(several, {"/r"}, site(true)));
    EXPECT_NE(line.find("/b/bin/turbidite-member /r grains 4 1 "), std::string::npos) << line;
    EXPECT_NE(line.find("-n 3 /b/bin/turbidite-member /r fluid 1 3 /b/bin/turbidite-fluid -case "
                        "/r/fluid -parallel :"),
              std::string::npos)
        << line;
}

TEST(LaunchLine, TheFluidProgramIsThatOfTheCase) {
    Settings box = settings("standalone-nscd", true);
    box.set("fluid.program", std::string("box"));
    const std::string line = shell_line(launch_arguments(box, {"/r"}, site(true)));
    EXPECT_NE(line.find(" /b/bin/turbidite-fluid-box -case /r/fluid :"), std::string::npos) << line;
    const auto needed = needed_programs(box, site(true).programs);
    EXPECT_NE(std::find(needed.begin(), needed.end(), "/b/bin/turbidite-fluid-box"), needed.end());
}

TEST(LaunchLine, QuotesForTheShell) {
    EXPECT_EQ(shell_line({"a", "b c", "it's", "", "$x"}), "a 'b c' 'it'\\''s' '' '$x'");
}

TEST(LaunchLine, EveryAvailableAdapterHasAProgram) {
    for (const Choice& choice : find_key("grains.adapter")->choices) {
        if (choice.available) {
            EXPECT_NO_THROW(needed_programs(settings(choice.name, true), site(true).programs))
                << choice.name;
        }
    }
}

}  // namespace
}  // namespace turbidite
