// SPDX-License-Identifier: GPL-3.0-or-later
//
// grains.script: additions of a user to YADE's scene of a coupled run, with both hosts, and what is
// refused.
#include <iterator>
#include <sstream>

#include "tests/system/program.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

constexpr auto wet_case = R"(
domain: {size: [6, 6], left: wall, right: wall, bottom: wall, top: wall}
grains: {adapter: yade-nscd, file: grains.csv, script: mine.py, density_ratio: 1.5}
fluid: {reynolds: 36, cells_per_diameter: 8}
coupling: {scheme: split}
time: {step: 0.0125, end: 0.25}
output: {interval: 0.125}
)";

/// Records the position of grain 0 (the last body but one) five times, and saves the scene in
/// window 15.
constexpr auto recorder = R"(
heights = []
def note():
    heights.append(O.bodies[len(O.bodies) - 2].state.pos[1])
    with open('FOLDER/heights.txt', 'w') as out:
        out.write('\n'.join('%.17g' % height for height in heights))
def save():
    O.save('FOLDER/saved.yade.gz')
O.engines = O.engines + [PyRunner(command='note()', virtPeriod=0.05 * TIME), PyRunner(command='save()', virtPeriod=0.18 * TIME)]
O.save('FOLDER/first.yade.gz')
)";

class UsersScript : public ShellTest {
 protected:
    void SetUp() override {
        scratch.write("grains.csv", "id,x,y\n0,2,4\n1,4.5,0.52\n");
        scratch.write("case.yaml", wet_case);
    }

    void script(std::string text) const {
        for (const auto& [word, value] :
             {std::pair<std::string, std::string>{"FOLDER", scratch.path().string()},
              {"TIME", "1.0"}})
            for (auto at = text.find(word); at != std::string::npos; at = text.find(word))
                text.replace(at, word.size(), value);
        scratch.write("mine.py", text);
    }

    Answer run(const std::string& options = "") const {
        return shell(program + " run case.yaml" + into_run_folder() + options);
    }

    /// The run ends with this code because of what the script did; the message names the file and
    /// the action. Without the fluid, which takes most of the time.
    void expect_refused(const std::string& text, const std::string& deed,
                        const std::string& options = "") const {
        script(text);
        const Answer answer =
            run(" --force --set fluid.enabled=false --set contact.md_stiffness=1e4" + options);
        EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
        EXPECT_SAYS(answer.err, "grains/mine.py");
        EXPECT_SAYS(answer.err, deed);
        EXPECT_EQ(record().at("exit_code"), 4);
    }

    std::vector<double> heights() const {
        std::istringstream lines(text(scratch.path() / "heights.txt"));
        std::vector<double> values;
        for (double value; lines >> value;) values.push_back(value);
        return values;
    }
};

const std::string md = " --set grains.adapter=yade-md";

TEST_F(UsersScript, RecordsAndSavesBesideTheContactEngine) {
    script(recorder);
    const Answer answer = run();
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    const std::vector<double> seen = heights();
    ASSERT_GE(seen.size(), 4u);
    EXPECT_LT(seen.back(), seen.front()) << "the grain falls";
    EXPECT_TRUE(std::filesystem::exists(run_folder() / "grains/mine.py"))
        << "the run folder holds a copy";

    // Both scenes can be loaded in YADE; that of the run continues without the fluid.
    scratch.write("load.py", R"(
import turbidite_contact
for name in ('first', 'saved'):
    O.load(')" + scratch.path().string() +
                                 R"(/%s.yade.gz' % name)
    O.engines = [engine for engine in O.engines if engine.label.startswith('turbidite')]
    turbidite_contact.attach(gravity=(0, -1, 0))
    before = O.bodies[len(O.bodies) - 2].state.pos[1]
    O.run(20, True)
    print(name, len(O.bodies), 'falls' if O.bodies[len(O.bodies) - 2].state.pos[1] < before else 'stands')
)");
    const Answer loaded = shell(program + " yade load.py");
    EXPECT_EQ(loaded.code, 0) << loaded.out << loaded.err;
    EXPECT_SAYS(loaded.out, "first 6 falls");
    EXPECT_SAYS(loaded.out, "saved 6 falls");
}

constexpr auto saves_the_scene =
    "O.engines = O.engines + [PyRunner(command=\"O.save('FOLDER/saved.yade.gz')\", iterPeriod=10)]";

// Bonds are kept under the ids of the bodies, whatever the order of the grains in their file:
// without its own the lower disc would fall, since no bonds form after the first step of a run.
TEST_F(UsersScript, BondsOfASavedSceneHoldItsBodies) {
    scratch.write("case.yaml", R"(
domain: {size: [6, 6], left: wall, right: wall, bottom: wall, top: wall}
grains: {adapter: yade-nscd, file: grains.csv, script: mine.py, density_ratio: 1.5}
fluid: {enabled: false}
contact: {adhesion: cohesion, adhesion_force: 20, adhesion_range: 0.01, adhesion_shear: 20}
time: {step: 0.0125, end: 0.25}
)");
    scratch.write("load.py", R"(
import turbidite_contact
O.load(')" + scratch.path().string() +
                                 R"(/saved.yade.gz')
O.engines = [engine for engine in O.engines if engine.label.startswith('turbidite')]
turbidite_contact.attach(gravity=(0, -1, 0), adhesion='cohesion', adhesion_force=20, adhesion_range=0.01,
                         adhesion_shear=20, diameter=1)
lower = min(O.bodies, key=lambda body: body.state.pos[1] if type(body.shape).__name__ == 'Sphere' else 9).id
before = O.bodies[lower].state.pos[1]
O.run(100, True)
print(len(O.bodies), 'hangs' if before - O.bodies[lower].state.pos[1] < 1e-6 else 'falls')
)");
    script(saves_the_scene);
    for (const char* rows : {"3,3,5.4,fixed\n7,3,4.4,free\n", "7,3,4.4,free\n3,3,5.4,fixed\n"}) {
        scratch.write("grains.csv", std::string("id,x,y,motion\n") + rows);
        const Answer answer = run(" --force");
        ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
        const Answer loaded = shell(program + " yade load.py");
        EXPECT_EQ(loaded.code, 0) << loaded.out << loaded.err;
        EXPECT_SAYS(loaded.out, "6 hangs");
    }
}

// What holds grains in a run and cannot be told to YADE is missed, not forgotten.
TEST_F(UsersScript, ASavedSceneWithoutWhatHeldItsGrainsIsRefused) {
    script(saves_the_scene);
    scratch.write("load.py", "import turbidite_contact\nO.load('" + scratch.path().string() +
                                 R"(/saved.yade.gz')
O.engines = [engine for engine in O.engines if engine.label.startswith('turbidite')]
turbidite_contact.attach(gravity=(0, -1, 0), adhesion='cohesion', adhesion_force=20, adhesion_range=0.01,
                         adhesion_shear=20, diameter=1)
O.step()
)");
    scratch.write("thick.csv", "id,x1,y1,x2,y2,thickness\n90,1,1,3,1,0.5\n");
    scratch.write("smooth.csv", "id,x1,y1,x2,y2,friction\n90,1,1,3,1,0\n");
    const std::string dry = " --force --set fluid.enabled=false --set contact.friction=0.3";
    for (const auto& [set, told] :
         {std::pair{" --set domain.walls_file=thick.csv", "1 walls inside the box of a thickness"},
          {" --set domain.walls_file=smooth.csv", "1 walls inside the box of a thickness"},
          {" --set grains.shape=triangle --set contact.adhesion=cohesion --set "
           "contact.adhesion_force=20 --set contact.adhesion_range=0.01 --set "
           "contact.adhesion_shear=20",
           "cohesion between polygons"}}) {
        const Answer answer = run(dry + set);
        ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
        const Answer loaded = shell(program + " yade load.py");
        EXPECT_NE(loaded.code, 0) << loaded.out << loaded.err;
        EXPECT_SAYS(loaded.out + loaded.err, told);
    }
}

TEST_F(UsersScript, RecordsAndSavesBesideMolecularDynamics) {
    script(recorder);
    const Answer answer = run(md);
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;
    const std::vector<double> seen = heights();
    ASSERT_GE(seen.size(), 4u);
    EXPECT_LT(seen.back(), seen.front());
    scratch.write("load.py", "O.load('" + scratch.path().string() + R"(/saved.yade.gz')
O.engines = [engine for engine in O.engines if type(engine).__name__ != 'PyRunner']
before = O.bodies[len(O.bodies) - 2].state.pos[1]
O.run(200, True)
print(len(O.bodies), 'falls' if O.bodies[len(O.bodies) - 2].state.pos[1] < before else 'stands')
)");
    const Answer loaded = shell(program + " yade load.py");
    EXPECT_EQ(loaded.code, 0) << loaded.out << loaded.err;
    EXPECT_SAYS(loaded.out, "6 falls");
}

// The run must not depend on the presence of a recorder.
TEST_F(UsersScript, ChangesNoDigitOfTheRun) {
    script(recorder);
    const auto physics = [&](const std::string& options) {
        EXPECT_EQ(run(" --force" + options).code, 0);
        std::istringstream history(text(run_folder() / "history.csv"));
        std::string kept;
        for (std::string row; std::getline(history, row);) {
            std::size_t end = 0;
            for (int column = 0; column < 19; ++column) end = row.find(',', end) + 1;
            kept += row.substr(0, end) + "\n";
        }
        return kept;
    };
    const std::string with = physics("");
    EXPECT_EQ(with, physics(" --set grains.script=~"));
    EXPECT_EQ(std::count(with.begin(), with.end(), '\n'), 4);
}

TEST_F(UsersScript, WhatBelongsToTheCaseIsRefusedByName) {
    expect_refused("O.dt = 0.5 * O.dt\n", "changed O.dt from 0.0125 to 0.00625");
    expect_refused("O.engines = []\n", "removed the engine PyRunner turbidite");
    expect_refused("O.bodies.erase(4)\n", "erased body 4");
    expect_refused("from yade import utils\nO.bodies.append(utils.sphere((1, 1, 0), 0.1))\n",
                   "added 1 body,");
    expect_refused("O.bodies[4].state.vel = (1, 0, 0)\n", "moved body 4");
    for (const std::string& host : {std::string(), md})
        expect_refused("for material in O.materials: material.frictionAngle = 0.1\n",
                       "changed the friction or the springs of a material", host);
    expect_refused("for material in O.materials: material.kn *= 0.01\n",
                   "changed the friction or the springs of a material", md);
    expect_refused("O.engines[0].dead = True\n", "switched off the engine PyRunner turbidite");
    expect_refused("O.engines[-1].damping = 0.4\n", "changed gravity or damping", md);
    expect_refused("1 / 0\n", "ZeroDivisionError");
    expect_refused("O.engines = O.engines[:-1]\n", "removed the engine NewtonIntegrator", md);
    expect_refused("O.engines = O.engines[::-1]\n", "reordered the engines of the case", md);
}

// Also checked later, before the next window.
TEST_F(UsersScript, WhatAnEngineOfTheScriptDoesIsLookedAtInEveryWindow) {
    const std::string every =
        "O.engines = O.engines + [PyRunner(command='meddle()', iterPeriod=1)]\n";
    expect_refused("def meddle():\n    if O.iter > 3: O.dt = 1.0\n" + every, "changed O.dt");
    expect_refused("def meddle():\n    if O.iter > 3: O.bodies[4].state.pos = (3, 3, 0)\n" + every,
                   "moved grain 0");
    EXPECT_GE(record().at("windows_done"), 3);
    expect_refused("def meddle():\n    if O.iter > 12: O.dt = 1.0\n" + every, "changed O.dt", md);
    expect_refused("def meddle():\n    O.bodies[0].state.vel = (2, 0, 0)\n" + every, "moved wall 0",
                   md);
    expect_refused("def meddle():\n    if O.iter == 5: O.run(10, True)\n" + every,
                   "made 10 steps within one", md);
    expect_refused("def meddle():\n    if O.iter == 5: O.pause()\n" + every,
                   "stopped YADE before the run was over");
}

// Its exit would wait for the other programs, for as long as a run may stall.
TEST_F(UsersScript, AnEngineThatEndsYadeEndsTheRun) {
    script(
        "import sys\ndef leave():\n    if O.iter > 3: sys.exit(1)\n"
        "O.engines = O.engines + [PyRunner(command='leave()', iterPeriod=1)]\n");
    for (const std::string& options : {std::string(), md}) {
        const Answer answer = shell("timeout 60 " + program + " run case.yaml" + into_run_folder() +
                                    " --force --set fluid.enabled=false" + options);
        EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
        EXPECT_SAYS(answer.err, "grains.script must not end YADE (sys.exit, exit, quit)");
    }
}

TEST_F(UsersScript, AnErrorInOneOfItsEnginesEndsTheRun) {
    script(
        "def fail():\n    if O.iter > 3: raise ValueError('no such column')\n"
        "O.engines = O.engines + [PyRunner(command='fail()', iterPeriod=1)]\n");
    for (const std::string& options : {std::string(), md}) {
        const Answer answer = run(" --force" + options);
        EXPECT_EQ(answer.code, 4) << answer.out << answer.err;
        EXPECT_SAYS(
            answer.err,
            "grains rank 0 (" + std::string(options.empty() ? "yade-nscd" : "yade-md") + ", host ");
        EXPECT_SAYS(answer.err, "no such column");
    }
}

// Engines of the script before and behind those of the case; grains leave before and after the
// checkpoint.
constexpr auto witness = R"(
def note():
    with open('FOLDER/places.txt', 'a') as out:
        out.write(' '.join('%.9g' % body.state.pos[0] for body in O.bodies if body.id > 2) + '\n')
    with open('FOLDER/steps.txt', 'w') as out:
        out.write('%d %.9g' % (O.iter, O.time))
O.engines = [PyRunner(command='pass', iterPeriod=1)] + O.engines + [PyRunner(command='note()', iterPeriod=1)]
)";

class ResumedScript : public UsersScript, public ::testing::WithParamInterface<std::string> {
 protected:
    /// x of the grains that the script saw in its last step.
    std::vector<double> last_places() const {
        const std::string all = text(scratch.path() / "places.txt");
        std::istringstream line(all.substr(all.rfind('\n', all.size() - 2) + 1));
        return {std::istream_iterator<double>(line), {}};
    }
};

TEST_P(ResumedScript, SeesTheSameGrains) {
    scratch.write("grains.csv", "id,x,y,vx\n0,5.8,4,8\n1,5.5,2,4\n2,1,1,0\n3,2.5,0.51,0.5\n");
    script(witness);
    const std::string keys =
        GetParam() + " --set domain.right=free --set fluid.reynolds=3600 --set time.end=";
    ASSERT_EQ(run(" --force" + keys + "0.5").code, 0);
    const std::vector<double> whole = last_places();
    EXPECT_EQ(whole.size(), 2u) << "two have left";
    const std::string steps = text(scratch.path() / "steps.txt");
    ASSERT_EQ(run(" --force" + keys + "0.2").code, 0);
    EXPECT_EQ(last_places().size(), 3u) << "one has left";
    const Answer resumed =
        shell(program + " resume " + run_folder().string() + " --set time.end=0.5");
    EXPECT_EQ(resumed.code, 0) << resumed.out << resumed.err;
    const std::vector<double> places = last_places();
    ASSERT_EQ(places.size(), whole.size());
    // Recorders name files after these, and tell the time by them.
    EXPECT_EQ(text(scratch.path() / "steps.txt"), steps) << "O.iter and O.time";
    // YADE's own contacts are summed in another order once they have been loaded.
    for (std::size_t i = 0; i < whole.size(); ++i) EXPECT_NEAR(places[i], whole[i], 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Hosts, ResumedScript,
                         ::testing::Values(" --set grains.adapter=yade-nscd",
                                           " --set grains.adapter=yade-md",
                                           " --set grains.adapter=yade-md "
                                           "--set coupling.scheme=sub-iterated"),
                         [](const auto& info) { return "Host" + std::to_string(info.index); });

TEST_F(UsersScript, IsCheckedBeforeAnythingStarts) {
    const auto check = [&](const std::string& options) {
        return shell(program + " check case.yaml" + options);
    };
    Answer answer = check("");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "grains.script");
    EXPECT_SAYS(answer.err, "mine.py");
    script("pass\n");
    EXPECT_EQ(check("").code, 0);
    answer = check(" --set grains.adapter=standalone-nscd");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "A script runs inside YADE");
    scratch.write("mine.txt", "");
    answer = check(" --set grains.script=mine.txt");
    EXPECT_EQ(answer.code, 2);
    EXPECT_SAYS(answer.err, "ends with .py");
}

}  // namespace
}  // namespace turbidite
