// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The adapter kit as a user meets it: installed, with the examples built outside of the tree, run
// by grains.adapter: external; and what happens to adapters that go wrong.
#include "tests/system/history_columns.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

class AdapterKit : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("settle.yaml",
                      "domain: {size: [8, 8]}\n"
                      "grains: {adapter: standalone-nscd, count: 12}\n"
                      "contact: {friction: 0}\n"
                      "fluid: {reynolds: 30, cells_per_diameter: 6}\n"
                      "coupling: {scheme: split}\n"
                      "time: {step: 0.01, end: 2}\n"
                      "output: {interval: 0.5}\n"
                      "limits: {stall_soft: 5, stall_hard: 20}\n");
    }

    Answer run(const std::string& options, const std::string& folder = "run") const {
        return shell(std::string("timeout 120 ") + TURBIDITE_PROGRAM + " run settle.yaml --out " +
                     folder + " --force " + options);
    }

    Answer run_external(const std::string& command, const std::string& more = "") const {
        return run("--set grains.adapter=external --set 'grains.command=" + command + "' " + more);
    }

    /// Heights of the mean position.
    std::vector<double> fall(const std::string& folder) const {
        return columns_of(text(scratch.path() / folder / "history.csv")).at("mean_position_y");
    }

    /// Ran under its own name, balanced, and fell like the reference.
    void expect_settled(const Answer& answer, const std::string& name, double tolerance) const {
        ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "grains rank 0  " + name + " in ");
        EXPECT_EQ(record().at("ranks").back().at("adapter"), name);
        EXPECT_LT(record().at("maxima").at("grain_balance").get<double>(), 1e-10);
        const std::vector<double> reference = fall("reference"), mine = fall("run");
        ASSERT_EQ(mine.size(), reference.size());
        EXPECT_LT(reference.back(), reference.front() - 0.1) << "nothing has settled";
        for (std::size_t i = 0; i < mine.size(); ++i)
            EXPECT_NEAR(mine[i], reference[i], tolerance) << i;
    }

    Answer judge(const std::string& command, const std::string& options = "") const {
        return shell("timeout 300 " TURBIDITE_PROGRAM " adapter-test " + options + " -- " +
                     command);
    }

    /// With spheres: the liquid's kick, and contacts.
    void expect_conforms_in_space(const std::string& command, const std::string& contacts) const {
        const Answer wet = judge(command, "--dimension 3 --only '('");
        EXPECT_EQ(wet.code, 0) << wet.out << wet.err;
        EXPECT_SAYS(wet.out, "ok    settles in a linear drag");
        const Answer collision = judge(command, "--dimension 3 --only 'collides and'");
        EXPECT_SAYS(collision.out, contacts + " collides and keeps momentum");
    }

    /// And refuses what it cannot do in words.
    void expect_conforms(const std::string& command) const {
        const Answer answer = judge(command);
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "-     slides into rolling                 refuses friction: ");
        EXPECT_SAYS(answer.out, "-     respects held and driven grains     refuses grains with a");
        EXPECT_SAYS(answer.out, "\nconforms\n");
    }

    /// As documented: nothing else is missing.
    void expect_touches_nothing(const std::string& command) const {
        const Answer answer = judge(command);
        EXPECT_EQ(answer.code, 1) << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "FAILS lands and comes to rest");
        EXPECT_SAYS(answer.out, "FAILS collides and keeps momentum");
        EXPECT_SAYS(answer.out, "-     collides with friction              refuses friction: ");
        EXPECT_SAYS(answer.out, "\n2 requirements are not met\n");
    }

    /// The run that has just been played, in two parts.
    void expect_goes_on(const std::string& command, const std::string& more = "") const {
        const std::vector<double> whole = fall("run");
        ASSERT_EQ(run_external(command, more + " --set time.end=0.73").code, 0);
        const Answer answer = shell("timeout 60 " TURBIDITE_PROGRAM " resume run --set time.end=2");
        EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
        EXPECT_EQ(fall("run"), whole) << command;
    }
};

TEST_F(AdapterKit, ExamplesAreBuiltOutsideOfTheTreeAndSettleLikeTheContactEngine) {
    const std::string cmake = CMAKE_PROGRAM;
    const Answer build =
        shell(cmake + " --install " TURBIDITE_BUILD_DIR " --component dev --prefix prefix && " +
              "cp -r prefix/share/turbidite/examples mine && " + cmake +
              " -S mine -B mine/build -DCMAKE_PREFIX_PATH=$PWD/prefix && " + cmake +
              " --build mine/build");
    ASSERT_EQ(build.code, 0) << build.out << build.err;
    ASSERT_EQ(run("", "reference").code, 0);
    expect_conforms("mine/build/springs");
    expect_conforms("/usr/bin/python3 mine/springs.py");
    expect_touches_nothing("mine/build/falling");
    expect_conforms_in_space("mine/build/springs", "ok   ");
    expect_conforms_in_space("/usr/bin/python3 mine/springs.py", "ok   ");
    expect_conforms_in_space("mine/build/falling", "FAILS");
    expect_settled(run_external("mine/build/springs"), "springs", 1e-3);
    expect_goes_on("mine/build/springs");
    expect_settled(run_external("/usr/bin/python3 mine/springs.py"), "springs-py", 1e-3);
    expect_goes_on("/usr/bin/python3 mine/springs.py");
    // Grains that touch nothing sink into each other: as long as they are apart they fall alike.
    expect_settled(run_external("mine/build/falling", "--set limits.penetration=10"), "falling-c",
                   0.05);
    expect_goes_on("mine/build/falling", "--set limits.penetration=10");
    for (const char* program :
         {"mine/build/springs", "/usr/bin/python3 mine/springs.py", "mine/build/falling"}) {
        const Answer refused = run_external(program, "--set contact.rolling_friction=0.5");
        EXPECT_EQ(refused.code, 4) << program;
        EXPECT_SAYS(refused.err,
                    "the program cannot play this case: contact.rolling_friction = 0.5");
    }
    // Springs have it by their damping.
    for (const char* program : {"mine/build/springs", "/usr/bin/python3 mine/springs.py"})
        EXPECT_EQ(run_external(program, "--set contact.restitution=0.5").code, 0) << program;
}

// The package of a program that is not built with CMake: every header stands for itself, flags come
// from pkg-config, and a folder that was moved is found.
TEST_F(AdapterKit, ThePackageIsWholeAndWorksWithPkgConfig) {
    const Answer install =
        shell(CMAKE_PROGRAM " --install " TURBIDITE_BUILD_DIR
                            " --component dev --prefix there && mv there prefix");
    ASSERT_EQ(install.code, 0) << install.err;
    const Answer headers = shell(
        "cd prefix/include && find . -name '*.hpp' -o -name '*.h' | xargs -P 2 -I {} sh -c "
        "'echo \"#include <{}>\" | g++ -std=c++17 -I . -I turbidite -fsyntax-only -x c++ "
        "$(pkg-config --cflags mpi-c) - || exit 1; echo {} stands for itself'");
    EXPECT_EQ(headers.code, 0) << headers.err;
    for (const char* name : {"participant/conversation.hpp", "participant/turbidite.h",
                             "protocol/records.hpp", "transport/world_isolation.hpp"})
        EXPECT_SAYS(headers.out, std::string(name) + " stands for itself");

    const std::string flags =
        "$(PKG_CONFIG_PATH=prefix/lib/pkgconfig pkg-config --cflags --libs turbidite)";
    const Answer build = shell(
        "cp -r prefix/share/turbidite/examples/* . && g++ -std=c++17 springs.cpp -o springs " +
        flags + " && cc falling.c -o falling " + flags + " -lm");
    ASSERT_EQ(build.code, 0) << build.out << build.err;
    for (const std::string program : {"springs", "falling"}) {
        const Answer answer = run_external(program, "--set time.end=0.1");
        EXPECT_EQ(answer.code, 0) << program << answer.out << answer.err;
        EXPECT_SAYS(answer.out, "grains rank 0  " + program);
    }
    const Answer python = shell(
        "PYTHONPATH=prefix/share/turbidite/python /usr/bin/python3 -c "
        "'import turbidite_adapter; print(turbidite_adapter._library._name)'");
    EXPECT_SAYS(python.out + python.err, "/prefix/lib/libturbidite.so\n");
}

// The library of the guide, preloaded into a program that believes it owns the world.
TEST_F(AdapterKit, TheInstalledIsolationDividesTheWorld) {
    scratch.write("owner.c",
                  "#include <mpi.h>\n#include <stdio.h>\n"
                  "int main(int argc, char** argv) {\n"
                  "    int size;\n"
                  "    MPI_Init(&argc, &argv);\n"
                  "    MPI_Comm_size(MPI_COMM_WORLD, &size);\n"
                  "    printf(\"a world of %d\\n\", size);\n"
                  "    return MPI_Finalize();\n"
                  "}\n");
    ASSERT_EQ(shell(CMAKE_PROGRAM " --install " TURBIDITE_BUILD_DIR
                                  " --component dev --prefix prefix && mpicc "
                                  "owner.c -o owner")
                  .code,
              0);
    const Answer answer = shell(
        "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1; timeout 60 mpirun "
        "--oversubscribe -n 3 sh -c 'TURBIDITE_ROLE=$((OMPI_COMM_WORLD_RANK / 2)) "
        "LD_PRELOAD=$PWD/prefix/lib/libturbidite_world_isolation.so exec ./owner' | sort");
    EXPECT_EQ(answer.out, "a world of 1\na world of 2\na world of 2\n") << answer.err;
}

// A grains program that calls MPI before the library does, and believes that it owns the world.
TEST_F(AdapterKit, AnIsolatedProgramJoinsTheRun) {
    scratch.write("owner.c",
                  "#include <mpi.h>\n#include <stdio.h>\n"
                  "#define main play\n#include \"falling.c\"\n#undef main\n"
                  "int main(int argc, char** argv) {\n"
                  "    int size;\n"
                  "    MPI_Init(&argc, &argv);\n"
                  "    MPI_Comm_size(MPI_COMM_WORLD, &size);\n"
                  "    fprintf(stderr, \"a world of %d\\n\", size);\n"
                  "    const int code = play(argc, argv);\n"
                  "    MPI_Finalize();\n"
                  "    return code;\n"
                  "}\n");
    const Answer build =
        shell(CMAKE_PROGRAM " --install " TURBIDITE_BUILD_DIR
                            " --component dev --prefix prefix && "
                            "cp prefix/share/turbidite/examples/falling.c . && mpicc owner.c -o "
                            "owner $(PKG_CONFIG_PATH=prefix/lib/pkgconfig pkg-config --cflags "
                            "--libs turbidite) -lm");
    ASSERT_EQ(build.code, 0) << build.out << build.err;
    const std::string here = scratch.path().string();
    scratch.write("isolated", "#!/bin/sh\nTURBIDITE_ROLE=2 LD_PRELOAD=" + here +
                                  "/prefix/lib/libturbidite_world_isolation.so exec " + here +
                                  "/owner \"$@\"\n");
    std::filesystem::permissions(scratch.path() / "isolated", std::filesystem::perms::owner_all);
    const Answer answer = run_external(here + "/isolated", "--set time.end=0.1");
    EXPECT_EQ(answer.code, 0) << answer.out << answer.err;
    EXPECT_SAYS(text(run_folder() / "logs/grains.log"), "a world of 1\n");
}

TEST_F(AdapterKit, CheckSaysWhetherTheProgramIsThere) {
    const std::string check = std::string(TURBIDITE_PROGRAM) +
                              " check settle.yaml --set grains.adapter=external --set "
                              "grains.command=";
    EXPECT_SAYS(shell(check + "sh").out, "grains program: sh (/");
    const Answer missing = shell(check + "no-such-program");
    EXPECT_EQ(missing.code, 2);
    EXPECT_SAYS(missing.err, "There is no executable program no-such-program in PATH");
}

/// A Python adapter whose grains fall freely, with a fault in window 3.
const char* const faulty = R"(import os, sys
if sys.argv[1] == 'import': import no_such_module
import turbidite_adapter as turbidite
from falling import Falling

class Odd(Exception):
    def __str__(self): return 5

class Mine(Falling):
    name = 'mine'
    def advance(self, window, responses):
        motion = super().advance(window, responses)
        fault, sent = sys.argv[1] if window.index == 3 else '', motion.grains
        if fault == 'raise': raise ValueError('no such thing')
        if fault == 'refuse': raise turbidite.PhysicsRefused('the disc is on fire')
        if fault == 'exit': sys.exit(0)
        if fault == '_exit': os._exit(3)
        if fault == 'odd': raise Odd()
        if fault == 'without_stderr':
            sys.stderr.close()
            raise turbidite.PhysicsRefused('the disc is on fire')
        if fault == 'fewer': motion.grains = sent[2:]
        if fault == 'nan': sent['contact_impulse'][4] = float('nan')
        if fault == 'impulse': sent['contact_impulse'][4, 0] = 1
        return motion
    def apply_kick(self, window, kicks):
        motion = super().apply_kick(window, kicks)
        fault, sent = sys.argv[1] if window.index == 3 else '', motion.grains
        if fault == 'state_impulse': sent['contact_impulse'][4, 0] = 1
        if fault == 'state_velocity': sent['velocity'][4, 0] = 1
        return motion

if sys.argv[1] == 'leaves_without_stdout':
    sys.stdout.close()
    sys.exit(3)
if sys.argv[1] == 'nameless': del Mine.name, Falling.name
turbidite.run_grains(Mine(turbidite), sys.argv[-1])
)";

struct Fault {
    const char* name;
    int code;
    std::vector<std::string> says;
};
class AdapterFault : public AdapterKit, public ::testing::WithParamInterface<Fault> {};

TEST_P(AdapterFault, IsToldAsItsOwn) {
    with_python_of_tests();
    scratch.write("mine.py", faulty);
    const Answer answer = run_external(std::string("/usr/bin/python3 mine.py ") + GetParam().name);
    EXPECT_EQ(answer.code, GetParam().code) << answer.out << answer.err;
    EXPECT_SAYS(answer.err, "The run failed: ");
    for (const std::string& part : GetParam().says) EXPECT_SAYS(answer.err, part);
}

const std::string mine = "grains rank 0 (mine, host ";

INSTANTIATE_TEST_SUITE_P(
    Faults, AdapterFault,
    ::testing::Values(
        Fault{"import", 4, {"ended with status 1", "the run had not begun", "No module named"}},
        Fault{"nameless", 4, {"grains rank 0 (", "AttributeError: ", "'name'"}},
        Fault{"raise", 4, {mine, "ValueError: no such thing", "Last lines of logs/grains.log"}},
        Fault{"refuse", 6, {mine, "the disc is on fire"}}, Fault{"odd", 4, {mine, "Odd"}},
        Fault{"without_stderr", 6, {mine, "the disc is on fire"}},
        Fault{"leaves_without_stdout", 4, {"ended with status 1", "the run had not begun"}},
        Fault{"exit", 4, {mine, "SystemExit: 0"}},
        Fault{"_exit", 4, {"ended with status 3", "was due to send \"motion\", window 3"}},
        Fault{"fewer", 6, {mine, "2 of 12 grains are missing", "in \"motion\" of window 3"}},
        Fault{"nan", 6, {mine, "grain 4: contact impulse is not finite: (nan, nan, nan)"}},
        Fault{"impulse", 6, {"grain_balance = ", "fails most for grain 4", "of grains (mine)"}},
        Fault{"state_impulse", 6, {"those of the motion; grain 4 of grains (mine)"}},
        Fault{"state_velocity", 6, {"those of the kicks", "grain 4 of grains (mine)"}}),
    [](const auto& info) {
        const std::string name = info.param.name;
        return name[0] == '_' ? "Quick" + name : name;
    });

}  // namespace
}  // namespace turbidite
