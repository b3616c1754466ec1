// SPDX-License-Identifier: LGPL-2.1-or-later
//
// `turbidite yade SCRIPT`: a YADE user's script that attaches the contact engine in two lines moves
// its bodies exactly as the engine alone does.
#include <cmath>
#include <sstream>

#include "granular_adapter/nscd/engine/engine.hpp"
#include "tests/system/program.hpp"
#include "tests/system/shell_test.hpp"

namespace turbidite {
namespace {

constexpr int rows = 6, columns = 5, steps = 400;
constexpr double step = 4e-3, density = 2500.0, rough = 0.6, smooth = 0.1;

// Discs of two sizes and materials fall on a fixed and a driven disc, between three walls.
constexpr const char* script = R"(
import math
import turbidite_contact
from yade import utils

O.materials.append([FrictMat(density=2500, frictionAngle=math.atan(mu)) for mu in (0.6, 0.1)])
for k in range(30):
    i, j = k % 5, k // 5
    O.bodies.append(turbidite_contact.disc((0.6 + 1.1 * i + 0.3 * (j % 2), 2.6 + 1.1 * j, 7), 0.5 if k % 3 else 0.4,
                                           material=k % 2))
O.bodies.append(turbidite_contact.disc((1.5, 1, 7), 0.5, material=0, fixed=True))
O.bodies.append(turbidite_contact.disc((4, 1, 7), 0.5, material=0, fixed=True))
O.bodies[31].state.vel, O.bodies[31].state.angVel = Vector3(0.25, 0, 0), Vector3(0, 0, 3)
O.bodies.append([utils.wall(0, 1, material=1), utils.wall(0, 0, material=1), utils.wall(6.5, 0, material=1)])
O.dt = 4e-3
O.engines = turbidite_contact.engines(gravity=(0, -9.81, 0))
O.run(400, True)
with open('states.txt', 'w') as file:
    for body in (O.bodies[i] for i in range(32)):
        s = body.state
        print(*(x.hex() for x in (s.pos[0], s.pos[1], s.vel[0], s.vel[1], s.angVel[2], s.ori[3], s.ori[2])), file=file)
)";

nscd::Body disc(int id, double x, double y, double radius, int material) {
    nscd::Body body;
    body.id = id;
    body.material = material;
    body.radius = radius;
    body.density = density;
    body.mass = density * M_PI * (radius * radius) * 1.0;
    body.inertia = 2.0 * (0.25 * body.mass * (radius * radius));
    body.weight_mass = body.mass;
    body.position = {x, y, 0.0};
    return body;
}

nscd::Wall wall(int key, const Vec3& point, const Vec3& normal) {
    nscd::Wall result;
    result.key = key;
    result.point = point;
    result.normal = normal;
    result.material = 1;
    return result;
}

nscd::Engine engine_of_the_script() {
    nscd::EngineSettings settings;
    settings.gravity = {0.0, -9.81, 0.0};
    settings.surfaces.resize(2);
    settings.surfaces[0].friction = std::tan(std::atan(rough));
    settings.surfaces[1].friction = std::tan(std::atan(smooth));
    nscd::Engine engine(
        settings, {{"disc", {}}},
        {wall(32, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}), wall(33, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}),
         wall(34, {6.5, 0.0, 0.0}, {-1.0, 0.0, 0.0})});
    for (int k = 0; k < rows * columns; ++k) {
        const int i = k % columns, j = k / columns;
        engine.bodies().add(
            disc(k, 0.6 + 1.1 * i + 0.3 * (j % 2), 2.6 + 1.1 * j, k % 3 ? 0.5 : 0.4, k % 2));
    }
    nscd::Body fixed = disc(30, 1.5, 1.0, 0.5, 0), driven = disc(31, 4.0, 1.0, 0.5, 0);
    fixed.fixed = driven.fixed = true;
    driven.twist = {{0.25, 0.0, 0.0}, {0.0, 0.0, 3.0}};
    engine.bodies().add(fixed);
    engine.bodies().add(driven);
    return engine;
}

class YadeScript : public ShellTest {};

TEST_F(YadeScript, MovesBodiesBitForBitAsTheEngineAlone) {
    scratch.write("two_lines.py", script);
    const Answer answer = shell(program + " yade two_lines.py");
    ASSERT_EQ(answer.code, 0) << answer.out << answer.err;

    nscd::Engine engine = engine_of_the_script();
    for (int n = 0; n < steps; ++n) {
        engine.step(step);
        engine.move(step);
    }
    const nscd::Bodies& bodies = engine.bodies();
    ASSERT_GT(engine.memory().contacts().size(), 30u);
    std::istringstream states(text(scratch.path() / "states.txt"));
    for (std::size_t i = 0; i < bodies.size(); ++i) {
        const double ours[] = {bodies.position[i][0],       bodies.position[i][1],
                               bodies.twist[i].velocity[0], bodies.twist[i].velocity[1],
                               bodies.twist[i].spin[2],     bodies.orientation[i][0],
                               bodies.orientation[i][3]};
        for (const double value : ours) {
            std::string word;
            ASSERT_TRUE(states >> word);
            EXPECT_EQ(std::strtod(word.c_str(), nullptr), value) << "body " << i;
        }
    }
}

TEST_F(YadeScript, AnErrorOfTheScriptEndsInItsExitCode) {
    scratch.write("wrong.py", "import sys, turbidite_contact\nprint(sys.argv[1:])\nsys.exit(5)\n");
    const Answer answer = shell(program + " yade wrong.py --speed 3");
    EXPECT_EQ(answer.code, 5) << answer.err;
    EXPECT_SAYS(answer.out, "['--speed', '3']");
    EXPECT_EQ(shell(program + " yade nowhere.py").code, 2);
}

}  // namespace
}  // namespace turbidite
