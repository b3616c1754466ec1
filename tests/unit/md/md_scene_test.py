# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's bodies and engines for molecular dynamics, against known results for springs, dashpots and friction.

usage: yade -n -x -j1 md_scene_test.py FOLDER_OF_MD_SCENE
"""
import math
import os
import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))

from yade import O

from md_scene import Scene

FREQUENCY = 300.0  # w [1/s]


def settings(**changes):
    values = {'run.md_frequency': FREQUENCY, 'run.md_damping': 0.0, 'run.md_substeps': 60, 'run.step': 0.01,
              'run.gravity': 0.0, 'run.size_x': 20.0, 'run.size_y': 10.0, 'contact.friction': 0.3,
              'domain.left': 'wall', 'domain.right': 'wall', 'domain.bottom': 'wall', 'domain.top': 'free'}
    values.update({key.replace('_', '.', 1): value for key, value in changes.items()})
    return {key: str(value) for key, value in values.items()}


def disc(number, x, y, velocity=(0, 0, 0), radius=0.5, spin=0.0):
    mass = math.pi * radius**2 * 1.5
    return {'id': number, 'radius': radius, 'density': 1.5, 'mass': mass, 'inertia': mass * radius**2 / 2,
            'position': (x, y, 0), 'velocity': velocity, 'angular_velocity': (0, 0, spin)}


def sphere(number, place, velocity=(0, 0, 0), radius=0.5):
    mass = 4 / 3 * math.pi * radius**3 * 1.5
    return {'id': number, 'radius': radius, 'density': 1.5, 'mass': mass, 'inertia': 0.4 * mass * radius**2,
            'position': place, 'velocity': velocity, 'angular_velocity': (0, 0, 0)}


def restitution(zeta):
    """Schwager and Poeschel 2007: the contact ends when the force vanishes, before the overlap does."""
    if zeta == 1.0:
        return math.exp(-2.0)
    s = math.sqrt(1.0 - zeta**2)
    return math.exp(-zeta / s * math.atan2(2 * zeta * s, 2 * zeta**2 - 1))


class MdScene(unittest.TestCase):
    def setUp(self):
        O.reset()

    def build(self, grains, **changes):
        self.scene = Scene()
        self.bodies = self.scene.create(settings(**changes), grains)
        self.states = self.scene.states(self.bodies)

    def play(self, steps):
        for _ in range(steps):
            self.scene.step()

    def test_undamped_discs_bounce_in_the_contact_time_and_lose_nothing(self):
        # Head-on at speed 1; reduced mass m/2, so w is FREQUENCY and the contact lasts pi/w. Largest overlap: 1/w.
        self.build([disc(5, 3.0, 5.0, (1, 0, 0)), disc(9, 4.0005, 5.0)], run_md_substeps=600)
        touching, deepest = 0, 0.0
        for _ in range(1200):
            self.scene.step()
            touching += self.scene.contacts()
            deepest = max(deepest, self.scene.deepest_overlap(0.0))
        self.assertAlmostEqual(touching * O.dt * FREQUENCY / math.pi, 1.0, delta=0.01)
        self.assertAlmostEqual(deepest * FREQUENCY, 1.0, delta=0.005)
        self.assertAlmostEqual(self.states[0].vel[0], 0.0, delta=1e-3)
        self.assertAlmostEqual(self.states[1].vel[0], 1.0, delta=1e-3)

    def test_restitution_follows_from_damping(self):
        for zeta in (0.1, 0.3, 0.6, 0.95, 1.0):
            O.reset()
            self.build([disc(5, 3.0, 5.0, (1, 0, 0)), disc(9, 4.0005, 5.0)], run_md_substeps=1200,
                       run_md_damping=zeta)
            self.play(6000)
            self.assertEqual(self.scene.contacts(), 0)
            bounced = self.states[1].vel[0] - self.states[0].vel[0]
            self.assertAlmostEqual(bounced, restitution(zeta), delta=0.004, msg='zeta %g' % zeta)

    def test_discs_of_any_size_and_walls_bounce_alike(self):
        # k = m_r w^2: the same contact time and restitution for a small disc on a large one and on the floor.
        zeta = 0.3
        self.build([disc(1, 3.0, 5.0, (1, 0, 0), 0.2), disc(2, 4.2005, 5.0, (0, 0, 0), 1.0),
                    disc(3, 10.0, 0.3005, (0, -1, 0), 0.3)], run_md_substeps=1200, run_md_damping=zeta)
        self.play(6000)
        between = self.states[1].vel[0] - self.states[0].vel[0]
        self.assertAlmostEqual(between, restitution(zeta), delta=0.004)
        self.assertAlmostEqual(self.states[2].vel[1], restitution(zeta), delta=0.004)

    def test_overlaps_are_those_of_the_pair_whatever_other_sizes_there_are(self):
        self.build([disc(1, 3.0, 5.0, radius=0.05), disc(2, 3.0999, 5.0, radius=0.05), disc(3, 10.0, 5.0, radius=2.0)])
        self.scene.step()
        self.assertAlmostEqual(self.scene.deepest_overlap(0.0), 1e-4, delta=1e-6)
        self.assertLessEqual(self.scene.deepest_overlap(1.0), 1.0)

    def test_a_stack_at_rest_hands_its_weight_to_the_floor(self):
        count, gravity = 5, 1.0
        self.build([disc(i, 5.0, 0.5 + i) for i in range(count)], run_gravity=gravity, run_md_damping=1.0)
        self.play(12000)
        weight = count * self.states[0].mass * gravity
        floor = next(wall for wall in self.scene.walls if O.bodies[wall].shape.axis == 1)
        self.assertAlmostEqual(O.forces.f(floor)[1], -weight, delta=1e-9 * weight)
        # k = m w^2 at the wall.
        self.assertAlmostEqual(self.scene.deepest_overlap(0.0), 2 * (count - 1) * gravity / FREQUENCY**2, delta=1e-8)
        self.assertEqual(self.scene.contacts(), count)

    def test_a_disc_pushed_along_the_floor_slides_until_it_rolls(self):
        # Slides with -mu g; the floor rotates it with mu m g R/I = 2 mu g/R; rolls at 2/3 of its speed.
        self.build([disc(1, 3.0, 0.5 - 1.0 / FREQUENCY**2, (1, 0, 0))], run_gravity=1.0, run_md_damping=1.0)
        self.play(3000)  # t = 0.5 < 1/(3 mu) = 1.11
        self.assertAlmostEqual(self.states[0].vel[0], 1.0 - 0.3 * 0.5, delta=1e-3)
        self.assertAlmostEqual(self.states[0].angVel[2], -2 * 0.3 * 0.5 / 0.5, delta=3e-3)
        self.play(6000)
        self.assertAlmostEqual(self.states[0].vel[0], 2.0 / 3.0, delta=1e-3)
        self.assertAlmostEqual(self.states[0].angVel[2], -4.0 / 3.0, delta=2e-3)

    def test_permanent_forces_are_part_of_what_acted(self):
        self.build([disc(1, 3.0, 5.0)], run_gravity=1.0)
        self.scene.forces().setPermF(self.bodies[0], (0.5, 0.25, 0))
        self.play(1)
        self.assertEqual(tuple(self.scene.forces().f(self.bodies[0])), (0.5, 0.25, 0.0))
        mass = self.states[0].mass
        self.assertAlmostEqual(self.states[0].vel[1], O.dt * (0.25 / mass - 1.0), delta=1e-16)

    def test_tells_its_contacts_one_by_one(self):
        # Disc 9 lies under disc 5 on the floor: the pair is reported as (5, 9) whatever YADE's order is.
        gravity = 1.0
        self.build([disc(9, 5.0, 0.5), disc(5, 5.0, 1.5)], run_gravity=gravity, run_md_damping=1.0)
        self.play(12000)
        weight = self.states[0].mass * gravity
        on_floor, pair = sorted(self.scene.touching(), key=lambda contact: -contact[0])
        self.assertEqual((on_floor[0], on_floor[2]), (2, 9))
        self.assertEqual(pair[:3], (-1, 5, 9))
        self.assertAlmostEqual(on_floor[12], 2 * weight, delta=1e-6)
        self.assertAlmostEqual(pair[12], -weight, delta=1e-6)  # on disc 9, downwards
        self.assertAlmostEqual(pair[9], -1.0, delta=1e-9)
        self.assertAlmostEqual(pair[15], -1.0, delta=1e-4)
        self.assertAlmostEqual(on_floor[15], 0.5, delta=1e-4)
        self.assertGreater(pair[4], 0.0)

    def test_spheres_stick_on_impact_and_come_back_along_the_contact_as_across_it(self):
        # In any direction of the floor: v_t' = -v_t at the point; with J_t = -2 v_t (2/7) m the centre keeps 3/7.
        for angle in (0.0, 1.1):
            O.reset()
            along = 0.05 * math.cos(angle), 0.05 * math.sin(angle)
            self.build([sphere(1, (3.0, 0.5005, 4.0), (along[0], -1.0, along[1]))], run_dimension=3, run_size_z=8.0,
                       domain_front='wall', domain_back='wall', run_md_substeps=600)
            self.play(1400)
            velocity, spin = self.states[0].vel, self.states[0].angVel
            self.assertAlmostEqual(velocity[1], 1.0, delta=2e-3)
            for axis, part in ((0, along[0]), (2, along[1])):
                self.assertAlmostEqual(velocity[axis], 3.0 / 7.0 * part, delta=1e-2 * 0.05)  # 0.4 % with 600 sub-steps
            # The point: v + w x (0, -R, 0)
            self.assertAlmostEqual(velocity[0] + 0.5 * spin[2], -along[0], delta=1e-2 * 0.05)
            self.assertAlmostEqual(velocity[2] - 0.5 * spin[0], -along[1], delta=1e-2 * 0.05)

    def test_front_and_back_are_walls_in_space(self):
        self.build([sphere(1, (3.0, 5.0, 0.5005), (0, 0, -1)), sphere(2, (6.0, 5.0, 7.4995), (0, 0, 1))],
                   run_dimension=3, run_size_z=8.0, domain_front='wall', domain_back='wall', run_md_substeps=600)
        self.play(1400)
        self.assertAlmostEqual(self.states[0].vel[2], 1.0, delta=2e-3)
        self.assertAlmostEqual(self.states[1].vel[2], -1.0, delta=2e-3)

    def test_erased_discs_are_gone(self):
        self.build([disc(1, 3.0, 5.0), disc(2, 3.9, 5.0)])
        self.play(2)
        self.assertEqual(self.scene.contacts(), 1)
        self.scene.erase(self.bodies[:1])
        self.play(2)
        self.assertEqual(self.scene.contacts(), 0)
        self.assertIsNone(O.bodies[self.bodies[0]])

    def pile(self):
        return [disc(10 * row + k, 4.0 + k + 0.5 * (row % 2), 0.4999 + 0.866 * row)
                for row in range(5) for k in range(6 - row % 2)]

    def motion(self):
        return [(tuple(state.pos), tuple(state.vel), tuple(state.angVel)) for state in self.states]

    def test_a_restored_simulation_goes_on_the_same_but_for_rounding(self):
        # Springs are restored exactly; the order in which YADE sums forces is not.
        self.build(self.pile(), run_gravity=1.0, run_md_damping=0.5)
        self.play(700)
        saved = self.scene.save()
        self.play(700)
        went_on = self.motion()
        self.scene.restore(saved)
        self.states = self.scene.states(self.bodies)
        self.play(700)
        differences = [abs(a - b) for one, other in zip(went_on, self.motion())
                       for x, y in zip(one, other) for a, b in zip(x, y)]
        self.assertLess(max(differences), 1e-13)
        self.assertGreater(self.scene.contacts(), 20)


result = unittest.main(argv=sys.argv[:1], exit=False).result
sys.stdout.flush()
sys.stderr.flush()
os._exit(0 if result.wasSuccessful() and result.testsRun > 0 else 1)
