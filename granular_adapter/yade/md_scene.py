# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's bodies and engines for molecular dynamics of the grains of a case.

Contacts, forces and motion are YADE's own; a window of a coupled run consists of many YADE steps. Whatever a
user's script adds to O.engines runs in every one of them.
"""
import math
import os
import tempfile

import domain_sides
import users_script
from yade import *
from yade import utils

# Ratio of tangential to normal stiffness and damping in the plane and in space, for which both directions oscillate
# with the same period: an impulse moves the contact point of a disc three times as far tangentially as normally, that
# of a sphere 7/2 times.
TANGENTIAL = {2: 1.0 / 3.0, 3: 2.0 / 7.0}

# Margin of bounding boxes beyond a disc, over the smallest radius. A larger one means fewer searches for pairs,
# and more pairs without contact.
VERLET = 0.1


class Scene:
    """YADE's bodies and engines for the grains of a case."""

    def __init__(self):
        self.body_of = {}   # grain id -> body id
        self.materials = set()  # labels
        self.walls = {}     # body id -> side: 0 left, 1 right, 2 bottom, 3 top, 4 front, 5 back
        self.radii = (0.0, 0.0)  # smallest and largest
        self.script = users_script.NoScript()

    def create(self, settings, grains):
        """Adds the walls and one body per grain; returns the grains' body ids in the order of `grains`."""
        self.settings = settings
        self.in_space = domain_sides.in_space(settings)
        self.frequency = float(settings['run.md_frequency'])
        self.damping = float(settings['run.md_damping'])
        self.friction_angle = math.atan(float(settings['contact.friction']))
        self.walls = domain_sides.create_walls(settings, self._material(0.0))
        radii = [grain['radius'] for grain in grains] or [0.0]
        self.radii = min(radii), max(radii)
        self.body_of = {grain['id']: self._create_round(grain) for grain in grains}
        O.dt = float(settings['run.step']) / int(settings['run.md_substeps'])
        O.engines = self._engines(float(settings['run.gravity']))
        return list(self.body_of.values())

    def _material(self, mass):
        """Springs in series have k = k1 k2/(k1 + k2). With k_i = m_i w^2 every pair of grains has its reduced mass
        times w^2, and a contact with a wall, which has no spring of its own, the disc's m w^2."""
        label = 'mass %r' % mass
        if label not in self.materials:
            self.materials.add(label)
            dry = TANGENTIAL[3 if self.in_space else 2]
            tangential = float(self.settings.get('run.md_tangential_share', dry))  # with what springs move in a fluid
            spring, dashpot = mass * self.frequency**2, 2.0 * self.damping * mass * self.frequency
            O.materials.append(ViscElMat(
                kn=spring, cn=dashpot, ks=tangential * spring, cs=tangential * dashpot,
                frictionAngle=self.friction_angle, label=label))
        return label

    def _create_round(self, grain):
        body = utils.sphere(grain['position'], grain['radius'], material=self._material(grain['mass']))
        state = body.state
        # In the plane the mass of a disc per unit length, not of YADE's sphere.
        state.mass = grain['mass']
        state.inertia = (grain['inertia'],) * 3
        state.blockedDOFs = '' if self.in_space else 'zXY'
        state.vel = grain['velocity']
        state.angVel = grain['angular_velocity']
        return O.bodies.append(body)

    def _engines(self, gravity):
        return [
            ForceResetter(),
            InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=-VERLET),
            InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                            [Ip2_ViscElMat_ViscElMat_ViscElPhys()],
                            [Law2_ScGeom_ViscElPhys_Basic()]),
            NewtonIntegrator(gravity=(0, -gravity, 0), damping=0),
        ]

    def complete(self):
        """Called when all bodies and engines exist; runs the user's additions to the scene."""
        self.script = users_script.complete_scene(self.settings)

    def begin_window(self):
        self.script.check()
        self.script.check_walls()

    def play(self, participant):
        while participant.step():
            pass

    def states(self, bodies):
        return [O.bodies[body].state for body in bodies]

    def erase(self, bodies):
        gone = set(bodies)
        self.body_of = {grain: body for grain, body in self.body_of.items() if body not in gone}
        self.script.expect_fewer(bodies)
        for body in bodies:
            O.bodies.erase(body)

    def forces(self):
        return O.forces

    def step(self):
        """One sub-step. O.run(n, wait=True) would test only every 40 ms whether it has finished."""
        self.script.check_step()
        before = O.iter
        O.step()
        self.script.check_one_step(before)

    def contacts(self):
        """Number of contacts with a force."""
        return O.interactions.countReal()

    def touching(self):
        """Contacts of the last step: (side of the domain or -1, grain, grain, whether it slides, overlap, point,
        normal from the first to the second, force on the second, branch between the centres or from a wall)."""
        grain_of = {body: grain for grain, body in self.body_of.items()}
        return [self._contact(contact, grain_of) for contact in O.interactions if contact.isReal]

    def _contact(self, contact, grain_of):
        """The record of one contact; the smaller grain id, or the wall, comes first."""
        geom, phys = contact.geom, contact.phys
        first, second, sense = contact.id1, contact.id2, 1.0
        if second in self.walls or first not in self.walls and grain_of[first] > grain_of[second]:
            first, second, sense = second, first, -1.0
        wall = self.walls.get(first, -1)
        force, normal = sense * (phys.normalForce + phys.shearForce), sense * geom.normal
        place = O.bodies[second].state.pos
        branch = place - (geom.contactPoint if wall >= 0 else O.bodies[first].state.pos)
        slides = phys.shearForce.norm() >= (1.0 - 1e-9) * phys.tangensOfFrictionAngle * phys.normalForce.norm()
        return (wall, 0 if wall >= 0 else grain_of[first], grain_of[second], bool(slides), geom.penetrationDepth,
                *geom.contactPoint, *normal, *force, *branch)

    def deepest_overlap(self, known):
        """Largest overlap of two grains in the last step [m], or less than what is `known` of the window."""
        smallest, largest = self.radii
        # YADE's ratio is that of the overlap to 2 R1 R2/(R1 + R2), which is at most the largest radius.
        bound = max(0.0, utils.maxOverlapRatio() * largest)
        if smallest == largest or bound <= known:
            return bound
        return max((contact.geom.penetrationDepth for contact in O.interactions
                    if contact.isReal and contact.id1 not in self.walls and contact.id2 not in self.walls), default=0.0)

    def save(self):
        """The whole simulation as bytes, contacts with their springs included."""
        self.script.before_save()
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'scene.yade')
            O.save(file, quiet=True)
            with open(file, 'rb') as saved:
                return saved.read()

    def restore(self, bytes):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, 'scene.yade')
            with open(file, 'wb') as saved:
                saved.write(bytes)
            O.load(file, quiet=True)
        self.script.after_load()
