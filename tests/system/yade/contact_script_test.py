# SPDX-License-Identifier: GPL-3.0-or-later
"""The contact engine in scripts of YADE users: `turbidite yade contact_script_test.py`.

Every test builds its own scene, usually of two or three bodies whose motion is known.
"""
import glob
import math
import os
import subprocess
import sys
import tempfile
import unittest

import turbidite_contact
from yade import utils

G = 10.0
DT = 1e-3


def material(mu):
    return O.materials.append(FrictMat(density=1000, frictionAngle=math.atan(mu)))


def discs(places, radius=0.5, mat=-1, **kw):
    return [O.bodies.append(turbidite_contact.disc((*place, 0), radius, material=mat, **kw)) for place in places]


def floor(y=0.0, mat=-1):
    return O.bodies.append(utils.wall(y, 1, material=mat))


def start(gravity=(0, -G, 0), **settings):
    O.dt = DT
    O.engines = turbidite_contact.engines(gravity=gravity, **settings)


def states():
    return [[x.hex() for x in (*b.state.pos, *b.state.ori, *b.state.vel, *b.state.angVel)] for b in O.bodies]


def pile(mu=0.4, seed=3):
    """Discs, triangles and squares above a floor between two walls."""
    import random
    draw = random.Random(seed)
    material(mu)
    for k in range(24):
        x, y, turn = 0.7 + 1.3 * (k % 6), 0.7 + 1.3 * (k // 6), draw.uniform(0, 6)
        if k % 3 == 0:
            O.bodies.append(turbidite_contact.disc((x, y, 0), draw.uniform(0.4, 0.6)))
        else:
            n = 2 + k % 3 + (k % 2)
            corners = [(x + 0.6 * math.cos(turn + 2 * math.pi * i / n), y + 0.6 * math.sin(turn + 2 * math.pi * i / n))
                       for i in range(n)]
            O.bodies.append(turbidite_contact.polygon(corners))
    floor()
    O.bodies.append(utils.wall(-0.3, 0))
    O.bodies.append(utils.wall(8.2, 0))


class SceneTest(unittest.TestCase):
    def setUp(self):
        O.reset()

    def refused(self, *parts):
        """The next step is refused with this message."""
        with self.assertRaises(turbidite_contact.Refused) as caught:
            turbidite_contact.step()
        for part in parts:
            self.assertIn(part, str(caught.exception))


class Motion(SceneTest):
    def test_free_fall_and_rest(self):
        """Eq. 16: v = -g n dt exactly; on the floor the disc comes to rest at its radius."""
        material(0.3)
        high, low = discs([(0, 9), (5, 0.5)])
        floor()
        start()
        O.run(100, True)
        self.assertAlmostEqual(O.bodies[high].state.vel[1], -G * 100 * DT, delta=1e-12)
        self.assertAlmostEqual(O.bodies[low].state.pos[1], 0.5, delta=1e-9)
        mass = O.bodies[low].state.mass
        self.assertAlmostEqual(mass, 1000 * math.pi * 0.25, delta=1e-9)
        self.assertAlmostEqual(turbidite_contact.contact_force(low)[1], mass * G, delta=1e-6 * mass * G)

    def test_pairs_take_the_smaller_friction(self):
        """A block that cannot turn slides on a floor: its deceleration is g times the smaller mu."""
        rough, smooth = material(0.6), material(0.2)
        on_rough = discs([(0, 0.5)], mat=smooth)[0]
        floor(mat=rough)
        O.bodies[on_rough].state.blockedDOFs = 'zXYZ'
        O.bodies[on_rough].state.vel = Vector3(3, 0, 0)
        start()
        O.run(100, True)
        self.assertAlmostEqual(O.bodies[on_rough].state.vel[0], 3 - 0.2 * G * 100 * DT, delta=1e-3)
        O.materials[smooth].frictionAngle = math.atan(0.1)  # noticed
        before = O.bodies[on_rough].state.vel[0]
        O.run(100, True)
        self.assertAlmostEqual(O.bodies[on_rough].state.vel[0], before - 0.1 * G * 100 * DT, delta=1e-3)

    def test_forces_of_the_script_are_loads(self):
        """m v = F n dt for a force set in every step and for a permanent one; likewise for a torque."""
        material(0.3)
        pushed, pulled, turned = discs([(0, 0), (5, 0), (10, 0)])
        start(gravity=(0, 0, 0))
        O.engines = O.engines[:1] + [PyRunner(
            command=f'O.forces.addF({pushed}, (6, 0, 0)); O.forces.addT({turned}, (0, 0, 2))', iterPeriod=1,
            initRun=True)] + O.engines[1:]
        O.forces.setPermF(pulled, (0, -4, 0))
        O.run(50, True)
        mass, inertia = O.bodies[pushed].state.mass, O.bodies[turned].state.inertia[2]
        self.assertAlmostEqual(O.bodies[pushed].state.vel[0], 6 * 50 * DT / mass, delta=1e-12)
        self.assertAlmostEqual(O.bodies[pulled].state.vel[1], -4 * 50 * DT / mass, delta=1e-12)
        self.assertAlmostEqual(O.bodies[turned].state.angVel[2], 2 * 50 * DT / inertia, delta=1e-12)
        self.assertEqual(O.bodies[turned].state.vel, Vector3.Zero)

    def test_attach_keeps_gravity_and_what_acts_before_the_integrator(self):
        material(0.3)
        body, = discs([(0, 5)])
        mass = O.bodies[body].state.mass
        O.dt = DT
        O.engines = [ForceResetter(), InsertionSortCollider([Bo1_Sphere_Aabb()]),
                     ForceEngine(ids=[body], force=(2 * mass, 0, 0)), NewtonIntegrator(gravity=(0, -3, 0)),
                     PyRunner(command='pass', iterPeriod=1, label='after')]
        turbidite_contact.attach()
        self.assertEqual([type(engine).__name__ for engine in O.engines],
                         ['ForceResetter', 'ForceEngine', 'NewtonIntegrator', 'PyRunner', 'PyRunner', 'PyRunner'])
        self.assertEqual(O.engines[-1].label, 'after')
        O.run(100, True)
        velocity = O.bodies[body].state.vel
        self.assertAlmostEqual(velocity[0], 0.2, 12)
        self.assertAlmostEqual(velocity[1], -0.3, 12)

    def test_another_material_counts_from_the_next_step(self):
        material(0.3)
        body, = discs([(0, 0.5)])
        floor()
        start()
        O.bodies[body].state.vel = Vector3(1, 0, 0)
        O.step()
        before = O.bodies[body].state.vel[0]
        self.assertAlmostEqual(before, 1 - 0.3 * G * DT, 12)
        O.bodies[body].mat = O.materials[O.materials.append(FrictMat(density=1000, frictionAngle=0, label='smooth'))]
        O.step()
        self.assertAlmostEqual(O.bodies[body].state.vel[0], before, 12)

    def test_a_cell_that_changes_is_seen(self):
        material(0.3)
        discs([(0.6, 5), (4.4, 5)])
        O.periodic = True
        O.cell.hSize = Matrix3(20, 0, 0, 0, 20, 0, 0, 0, 20)
        start(gravity=(0, 0, 0))
        O.bodies[0].state.vel = Vector3(-1, 0, 0)
        O.step()
        self.assertEqual(turbidite_contact.report()['candidates'], 0)
        O.cell.hSize = Matrix3(4.8, 0, 0, 0, 20, 0, 0, 0, 20)  # 1 apart across the side
        O.run(5, True)
        self.assertLess(O.bodies[1].state.vel[0], -0.4)
        O.cell.velGrad = Matrix3(0.1, 0, 0, 0, 0, 0, 0, 0, 0)
        self.refused('the periodic cell deforms')

    def test_bodies_come_and_go(self):
        """A disc that loses its support falls; one that is added lands on the other."""
        material(0.3)
        low, high = discs([(0, 0.5), (0, 1.5)])
        floor()
        start()
        O.run(20, True)
        self.assertAlmostEqual(O.bodies[high].state.vel[1], 0, delta=1e-6)
        O.bodies.erase(low)
        O.run(20, True)
        self.assertAlmostEqual(O.bodies[high].state.vel[1], -20 * G * DT, delta=1e-6)
        O.bodies[high].state.pos, O.bodies[high].state.vel = Vector3(0, 0.5, 0), Vector3.Zero
        added = discs([(0, 1.5)])[0]
        O.run(20, True)
        self.assertAlmostEqual(O.bodies[added].state.pos[1], 1.5, delta=1e-6)
        self.assertEqual({(c.id1, c.id2) for c in turbidite_contact.contacts()}, {(high, added), (2, high)})

    def test_driven_bodies_and_moving_walls(self):
        """A lift raises a disc, a belt accelerates one to its own speed."""
        material(0.5)
        lifted, carried = discs([(0, 0.5), (10, 0.5)])
        lift = O.bodies.append(utils.box((0, -0.5, 0), (2, 0.5, 1), fixed=True))
        belt = O.bodies.append(utils.facet([(5, 0, -1), (500, 0, -1), (250, 0, 500)]))
        O.bodies[lift].state.vel, O.bodies[belt].state.vel = Vector3(0, 1, 0), Vector3(-1, 0, 0)
        start()
        O.run(400, True)
        self.assertAlmostEqual(O.bodies[lift].state.pos[1], -0.5 + 0.4, delta=1e-9)
        self.assertAlmostEqual(O.bodies[lifted].state.pos[1], 0.5 + 0.4, delta=1e-5)
        # mu g t = 2 > 1: it rolls without slipping, and a disc that starts at rest keeps v + R omega/2 = 0.
        state = O.bodies[carried].state
        self.assertAlmostEqual(state.vel[0] + 0.5 * state.angVel[2], -1, delta=1e-6)
        self.assertAlmostEqual(state.vel[0], -1 / 3, delta=1e-6)

    def test_a_periodic_cell_joins_its_ends(self):
        """A smooth disc moves across the periodic boundary into the other one: both continue at half its speed."""
        material(0)
        O.periodic = True
        O.cell.hSize = Matrix3(4, 0, 0, 0, 50, 0, 0, 0, 50)
        left, right = discs([(0.9, 0.5), (3.7, 0.5)])
        floor()
        O.bodies[left].state.vel = Vector3(-1, 0, 0)
        start()
        O.run(600, True)
        for body in (left, right):
            self.assertAlmostEqual(O.bodies[body].state.vel[0], -0.5, delta=1e-6)
        self.assertAlmostEqual((O.bodies[left].state.pos[0] - O.bodies[right].state.pos[0]) % 4, 1, delta=1e-6)


class Results(SceneTest):
    def test_the_stress_of_a_periodic_cell_is_that_of_its_contacts(self):
        """Three discs of 1 m in a row of 2.97 m that repeats: one of three contacts is across the end of the cell."""
        material(0)
        O.periodic = True
        O.cell.hSize = Matrix3(2.97, 0, 0, 0, 50, 0, 0, 0, 50)
        discs([(0.3, 0.5), (1.29, 0.5), (2.28, 0.5)])
        start(gravity=(0, 0, 0), show=1)
        O.step()
        points = turbidite_contact.contacts()
        self.assertEqual(len(points), 3)
        self.assertGreater(points[0].normal_force.norm(), 1)
        pressure = 0.99 * sum(point.normal_force.norm() for point in points)
        self.assertAlmostEqual(utils.getStress(1.0)[0, 0], -pressure, delta=0.02 * pressure)
        for interaction in O.interactions:
            self.assertAlmostEqual(interaction.geom.refR1, 0.495, delta=0.01)
            self.assertAlmostEqual(interaction.geom.refR2, 0.495, delta=0.01)

    def test_forces_of_bridges_are_those_of_grains_of_the_given_diameter(self):
        for diameter, holds in ((1.0, True), (2.0, False)):  # half the force on grains half as large
            O.reset()
            material(0)
            discs([(0, 1.5)], fixed=True)
            low, = discs([(0, 0.5)])
            weight = G * O.bodies[low].state.mass
            start(adhesion='capillary', adhesion_force=1.5 * weight, adhesion_range=0.01, adhesion_length=0.01,
                  diameter=diameter)
            O.run(200, True)
            self.assertEqual(O.bodies[low].state.pos[1] > 0.45, holds)

    def test_contacts_reach_the_tools_of_yade(self):
        """At rest floor and walls carry the weight: in O.forces, in O.interactions, in VTKRecorder's files."""
        pile()
        walls = (24, 25, 26)
        folder = tempfile.mkdtemp()
        start(show=2000, tolerance=1e-5)
        O.dt = 2e-3
        O.engines = O.engines + [VTKRecorder(recorders=['spheres', 'intr'], fileName=folder + '/p-', iterPeriod=2000)]
        O.run(4001, True)
        weight = G * sum(O.bodies[i].state.mass for i in range(24))
        self.assertLess(utils.kineticEnergy(), 1e-4 * weight)
        carried = sum((turbidite_contact.contact_force(wall) for wall in walls), Vector3.Zero)
        self.assertAlmostEqual(carried[1], -weight, delta=2e-3 * weight)
        self.assertAlmostEqual(carried[0], 0, delta=2e-3 * weight)
        shown = sum((O.forces.f(wall, True) for wall in walls), Vector3.Zero)
        self.assertAlmostEqual((shown - carried).norm(), 0, delta=1e-9 * weight)
        seen = sum((i.phys.normalForce + i.phys.shearForce for i in O.interactions if i.id1 in walls), Vector3.Zero)
        self.assertAlmostEqual((seen + carried).norm(), 0, delta=1e-9 * weight)
        self.assertLess(utils.unbalancedForce(), 5e-3)
        # Sum of force times branch over all contacts: compression is negative.
        self.assertLess(utils.getStress(1.0)[1, 1], 0)
        written = sorted(glob.glob(folder + '/p-intrs*'))
        self.assertTrue(written)
        self.assertIn('forceN', open(written[-1], 'rb').read().decode('latin-1'))
        O.step()
        self.assertEqual(len(O.interactions), 0)  # no contacts rather than outdated ones

    def test_a_contact_says_what_it_is(self):
        """Two discs pressed together between fixed ones: normal from id1 to id2, force on id2."""
        material(0.3)
        a, b = discs([(0, 0), (1, 0)])
        O.bodies[b].state.blockedDOFs = 'xyzXYZ'
        start(gravity=(G, 0, 0))
        O.run(3, True)
        contact, = turbidite_contact.contacts()
        force = G * O.bodies[a].state.mass
        self.assertEqual((contact.id1, contact.id2, contact.wall), (a, b, False))
        self.assertAlmostEqual((contact.normal - Vector3(1, 0, 0)).norm(), 0, delta=1e-12)
        self.assertAlmostEqual((contact.force - Vector3(force, 0, 0)).norm(), 0, delta=1e-6 * force)
        self.assertAlmostEqual((contact.point - Vector3(0.5, 0, 0)).norm(), 0, delta=1e-6)
        turbidite_contact.show()
        self.assertAlmostEqual(O.interactions[a, b].phys.normalForce[0], force, delta=1e-6 * force)


class SaveAndLoad(SceneTest):
    def test_every_way_of_saving_continues_bit_for_bit(self):
        pile()
        start(law='coulomb')
        O.dt = 2e-3
        folder = tempfile.mkdtemp()
        O.run(300, True)
        files = [f'{folder}/scene.{kind}' for kind in ('yade', 'yade.gz', 'xml', 'xml.bz2')]
        for file in files:
            O.save(file)
        O.saveTmp('there')
        O.run(100, True)
        expected = states()
        for file in (None, *files):
            O.load(file) if file else O.loadTmp('there')
            O.saveTmp('again')
            O.loadTmp('again')  # immediately: other bodies, the same impulses
            self.assertNotEqual(states(), expected)
            O.run(100, True)
            self.assertEqual(states(), expected, file)
        O.load(files[-1])
        O.run(3, True)
        O.reload()
        O.run(100, True)
        self.assertEqual(states(), expected)
        result = subprocess.run(['/usr/bin/yade', '-n', '-x', sys.argv[0], files[1]], capture_output=True, text=True,
                                check=True)
        self.assertIn(repr(expected), result.stdout)
        # Without the impulses the motion differs: the files must contain them.
        O.load(files[0])
        from turbidite_contact import memory
        settings, _ = memory.read(memory.find())
        memory.write(memory.find(), settings, b'')
        O.run(100, True)
        self.assertNotEqual(states(), expected)

    def test_another_scene_begins_without_impulses(self):
        pile()
        start()
        O.run(50, True)
        O.reset()
        material(0.3)
        discs([(0, 5)])
        start()
        O.step()
        self.assertEqual(turbidite_contact.report()['candidates'], 0)
        self.assertEqual(turbidite_contact.contacts(), [])


def spheres(places, radius=0.5, **kw):
    return [O.bodies.append(utils.sphere(place, radius, **kw)) for place in places]


class InSpace(SceneTest):
    def test_a_sphere_falls_along_z_and_rests_on_a_wall(self):
        material(0.3)
        high, low = spheres([(0, 0, 9), (5, 1, 0.5)])
        O.bodies.append(utils.wall(0, 2))
        start(gravity=(0, 0, -G))
        O.run(100, True)
        self.assertAlmostEqual(O.bodies[high].state.vel[2], -100 * G * DT, delta=1e-12)
        self.assertAlmostEqual(O.bodies[high].state.pos[2], 9 - G * DT**2 * 100 * 101 / 2, delta=1e-12)
        self.assertAlmostEqual(O.bodies[low].state.pos[2], 0.5, delta=1e-12)
        self.assertEqual(turbidite_contact.report()['contacts'], 1)

    def test_a_sphere_rolls_down_a_slope_in_any_direction(self):
        """Without sliding as tan(alpha) <= 3.5 mu: 5/7 g sin(alpha). Sliding: g (sin(alpha) - mu cos(alpha))."""
        alpha = 0.5
        for mu, rate in ((0.3, 5 / 7 * math.sin(alpha)), (0.1, math.sin(alpha) - 0.1 * math.cos(alpha))):
            for turn in (0.0, 0.9, 2.2):
                O.reset()
                material(mu)
                ball = O.bodies[spheres([(0, 0.5, 0)])[0]]
                floor()
                way = Vector3(math.cos(turn), 0, math.sin(turn))
                start(gravity=tuple(G * math.sin(alpha) * way - G * math.cos(alpha) * Vector3(0, 1, 0)))
                O.run(200, True)
                self.assertAlmostEqual(ball.state.vel.dot(way), G * rate * 200 * DT, delta=1e-9)
                self.assertAlmostEqual(ball.state.vel.cross(way).norm(), 0.0, delta=1e-9)
                contact, = turbidite_contact.contacts()
                self.assertAlmostEqual(contact.shear_force.dot(way), ball.state.mass * G * (rate - math.sin(alpha)),
                                       delta=1e-6 * ball.state.mass)

    def test_a_pile_carries_its_weight_to_the_floor_and_the_walls(self):
        import random
        draw = random.Random(5)
        material(0.4)
        for k in range(48):
            spheres([(0.6 + 1.1 * (k % 4) + draw.uniform(-0.04, 0.04), 0.6 + 1.1 * (k // 16),
                      0.6 + 1.1 * (k // 4 % 4) + draw.uniform(-0.04, 0.04))], draw.uniform(0.45, 0.5))
        base = floor()
        walls = [O.bodies.append(utils.wall(place, axis, sense=sense))
                 for axis in (0, 2) for place, sense in ((0, 1), (4.6, -1))]
        start(tolerance=1e-5, iterations=5000)
        O.run(8000, True)
        weight = sum(body.state.mass for body in O.bodies) * G
        speeds = sorted(body.state.vel.norm() for body in O.bodies)
        self.assertLess(speeds[len(speeds) // 2], 0.02)  # single spheres on top go on rolling
        self.assertGreater(turbidite_contact.report()['contacts'], 60)
        lifted = [-turbidite_contact.contact_force(body)[1] / weight for body in (base, *walls)]
        self.assertAlmostEqual(sum(lifted), 1.0, delta=0.01)
        self.assertGreater(lifted[0], 0.8)  # friction at the walls, in either direction, is the rest
        self.assertGreater(max(map(abs, lifted[1:])), 1e-3)
        place, before = states(), O.iter
        O.saveTmp('there')
        O.run(50, True)
        expected = states()
        O.loadTmp('there')
        self.assertEqual(states(), place)
        O.run(50, True)
        self.assertEqual((O.iter, states()), (before + 50, expected))

    def test_torsion_stops_a_spinning_sphere(self):
        material(0.3)
        ball = O.bodies[spheres([(0, 0.5, 0)])[0]]
        floor()
        ball.state.angVel = Vector3(0, 1, 0)
        start(torsion_friction=0.1)
        O.run(400, True)
        self.assertEqual(turbidite_contact.report()['contacts'], 1)
        self.assertAlmostEqual(ball.state.angVel[1], 0.0, delta=1e-9)

    def test_what_belongs_to_the_plane_is_refused(self):
        material(0.3)
        spheres([(0, 0.5, 0)])
        start()
        discs([(3, 0.5)])
        self.refused('body 1 (Sphere) is blocked in some directions', "'zXY'")
        O.bodies.erase(1)
        O.bodies.append(turbidite_contact.polygon([(5, 0), (6, 0), (5, 1)]))
        self.refused('has a shape that is not supported in space (Polyhedra)', 'Sphere, Wall')
        O.bodies.erase(O.bodies[-1].id)
        O.bodies.append(utils.facet([(0, 0, 0), (1, 0, 0), (0, 0, 1)]))
        self.refused('is a Facet while bodies move in space')


class Refusals(SceneTest):
    def scene(self):
        material(0.3)
        start()
        return O.bodies[discs([(0, 0.5)])[0]]

    def test_motion_in_space(self):
        body = self.scene()
        body.state.blockedDOFs = ''
        self.refused('body 0 (Sphere) has moments of inertia', 'is free in space', 'zXY')
        body.state.blockedDOFs = 'xzXY'
        self.refused('body 0 (Sphere) is blocked in one direction only')
        body.state.blockedDOFs, body.state.vel = 'zXY', Vector3(0, 0, 1)
        self.refused('body 0 (Sphere) moves out of the plane')

    def test_numbers_that_make_no_sense(self):
        body = self.scene()
        mass = body.state.mass
        body.state.mass = 0
        self.refused('body 0 (Sphere) has mass 0.0', 'positive mass')
        body.state.mass, body.state.inertia = mass, Vector3.Zero
        self.refused('body 0 (Sphere) has moment of inertia 0.0')
        body.state.inertia, body.state.pos = Vector3(1, 1, 1), Vector3(math.nan, 0, 0)
        self.refused('body 0 (Sphere) has a position or velocity that is not finite')
        body.state.pos = Vector3(0, 1, 0)
        O.materials[0].frictionAngle = -0.1
        self.refused('body 0 (Sphere) has frictionAngle = -0.1', '[0, pi/2)')

    def test_bodies_in_each_other(self):
        self.scene()
        discs([(0.9, 0.5)])
        self.refused('bodies 0 and 1 overlap by 0.1, 0.2 of the smaller radius', 'Move them apart')
        O.bodies[1].state.pos = Vector3(0.98, 0.5, 0)  # removed slowly
        turbidite_contact.step()
        O.bodies.append(turbidite_contact.polygon([(-0.4, 0.6), (-0.4, 1.6), (-1.2, 1)]))
        self.refused('bodies 0 and 2 overlap')

    def test_bodies_in_walls(self):
        self.scene()
        floor(0.1)
        self.refused('body 0 reaches 0.1 into wall 1, 0.2 of the smaller radius', 'Move them apart')
        O.bodies[0].state.pos = Vector3(0, 0.58, 0)  # removed slowly
        turbidite_contact.step()
        O.bodies.append(utils.facet([(-1, 1, 0), (1, 1, -1), (1, 1, 1)], fixed=True))
        self.refused('body 0 reaches ', ' into wall 2')

    def test_vertices_of_no_polygon(self):
        for vertices, fault in (([(0, 0), (1, 0), (2, 0)], 'collinear'), ([(0, 0), (0, 0), (1, 1)], 'the same as'),
                                ([(0, 0), (math.nan, 0), (1, 1)], 'finite'),
                                ([(0, 0), (1, 0), (0.2, 0.2), (0, 1)], 'convex')):
            with self.assertRaisesRegex(turbidite_contact.Refused, fault):
                turbidite_contact.polygon(vertices)

    def test_a_force_of_no_body(self):
        self.scene()
        O.step()
        self.assertEqual(turbidite_contact.contact_force(0), Vector3.Zero)
        with self.assertRaisesRegex(turbidite_contact.Refused, r'contact_force\(9\)'):
            turbidite_contact.contact_force(9)

    def test_bodies_of_other_kinds(self):
        self.scene()
        O.bodies.append(utils.tetra([(0, 0, 5), (1, 0, 5), (0, 1, 5), (0, 0, 6)]))
        self.refused('body 1 (Tetra) has a shape that is not supported', 'Sphere, Polyhedra')
        O.bodies.erase(1)
        O.bodies.appendClumped([utils.sphere((3, 0, 0), 0.5), utils.sphere((3.5, 0, 0), 0.5)])
        self.refused('body 2 (Sphere) is a clump or part of one')

    def test_planes_walls_and_masks(self):
        body = self.scene()
        discs([(4, 0.5)])
        O.bodies[1].state.pos = Vector3(4, 0.5, 0.3)
        self.refused('body 1 (Sphere) lies at z = 0.3, body 0 at z = 0')
        O.bodies[1].state.pos, O.bodies[1].mask = Vector3(4, 0.5, 0), 2
        self.refused('body 1 (Sphere) has mask 2')
        O.bodies[1].mask = 1
        wall = O.bodies[O.bodies.append(utils.wall(0, 2))]
        self.refused('body 2 (Wall) has its normal along z')
        O.bodies.erase(2)
        O.bodies.append(utils.wall(2, 0))
        self.refused('body 3 (Wall) has bodies on both sides (1 and 0)')
        O.bodies.erase(3)
        O.bodies.append(utils.wall(2, 0, sense=1))
        self.refused('body 4 (Wall) has the centre of body 0 behind it')
        self.assertTrue(wall is not None and body is not None)

    def test_a_box_that_is_no_prism(self):
        self.scene()
        O.bodies.append(utils.box((5, 0, 0), (1, 1, 1), orientation=Quaternion((1, 0, 0), 0.3), fixed=True))
        self.refused('body 1 (Box) has no axis along z')

    def test_the_loop(self):
        self.scene()
        O.dt = 1e-8
        self.refused('O.dt = 1e-08')
        O.dt = DT
        O.engines = O.engines + [NewtonIntegrator()]
        self.refused('NewtonIntegrator in O.engines')
        O.engines[1].gravity = Vector3(0, 0, -G)
        self.refused('has gravity = (0.0, 0.0, -10.0), the contact engine (0.0, -10.0, 0.0)')
        O.engines[1].gravity = Vector3(0, -G, 0)
        O.engines = O.engines[:-1] + turbidite_contact.engines(gravity=(0, -G, 0))
        self.refused('twice')
        start()
        O.engines = O.engines + [NewtonIntegrator()]
        O.engines = O.engines[1:-1]
        self.refused('no ForceResetter')
        O.engines = O.engines[:-1]
        self.refused('turbidite_contact_state')

    def test_settings(self):
        for gravity in ((0, -9.81), 9.81):
            with self.assertRaisesRegex(turbidite_contact.Refused, r'must be \(x, y, z\)'):
                turbidite_contact.engines(gravity=gravity)
        with self.assertRaisesRegex(turbidite_contact.Refused, 'frictionAngle'):
            turbidite_contact.engines(friction=0.3)
        with self.assertRaisesRegex(RuntimeError, 'contact.tolerance = 2'):
            turbidite_contact.engines(tolerance=2)
        with self.assertRaisesRegex(RuntimeError, 'contact.theta is no longer a key'):
            turbidite_contact.engines(theta=0.5)
        with self.assertRaisesRegex(RuntimeError, '(?s)contact.tolerence.*Did you mean contact.tolerance'):
            turbidite_contact.engines(tolerence=0.5)

    def test_friction_at_rest_is_not_below_that_of_a_rough_wall(self):
        material(0.1)
        ball, = discs([(0, 0.5)])
        floor(mat=material(0.5))
        O.bodies[ball].state.blockedDOFs = 'zXYZ'
        alpha = math.atan(0.15)  # would slide with 0.1
        start(gravity=(G * math.sin(alpha), -G * math.cos(alpha), 0), law='static-dynamic', static_friction=0.2)
        O.run(100, True)
        self.assertAlmostEqual(O.bodies[ball].state.vel[0], 0.0, delta=1e-9)

    def test_what_nothing_depends_on_may_be_zero(self):
        body = self.scene()
        body.state.inertia, body.state.blockedDOFs = Vector3(0, 0, 0), 'zXYZ'
        fixed, = discs([(3, 5)], fixed=True)
        O.bodies[fixed].state.mass = 0
        O.step()
        self.assertEqual(turbidite_contact.contact_force(0), Vector3.Zero)

    def test_a_diameter_where_forces_depend_on_it(self):
        bridges = dict(adhesion='capillary', adhesion_force=1, adhesion_range=0.01, adhesion_length=0.01)
        with self.assertRaisesRegex(turbidite_contact.Refused, r"adhesion = 'capillary' needs diameter \[m\]"):
            turbidite_contact.engines(**bridges)
        with self.assertRaisesRegex(turbidite_contact.Refused, 'diameter = -1 must be a positive length'):
            turbidite_contact.engines(diameter=-1, **bridges)

    def test_results_stay_when_the_scene_is_to_be_read_again(self):
        self.scene()
        base = floor()
        O.step()
        turbidite_contact.refresh()
        self.assertAlmostEqual(turbidite_contact.contact_force(base)[1], -G * O.bodies[0].state.mass, delta=1e-3)

    def test_an_error_ends_the_run(self):
        body = self.scene()
        body.state.blockedDOFs = ''
        with self.assertRaisesRegex(RuntimeError, 'is free in space'):
            O.step()


def continue_scene(file):
    O.load(file)
    O.run(100, True)
    print(states())


if len(sys.argv) > 1:
    continue_scene(sys.argv[1])
else:
    suite = unittest.defaultTestLoader.loadTestsFromModule(sys.modules['__main__'])
    outcome = unittest.TextTestRunner(verbosity=2).run(suite)
    sys.stdout.flush()
    os._exit(0 if outcome.wasSuccessful() and outcome.testsRun > 15 else 1)
