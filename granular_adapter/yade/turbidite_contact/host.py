# SPDX-License-Identifier: GPL-3.0-or-later
"""The contact engine of one scene: detects changes made by the script, steps, keeps the memory up to date."""
import math

import turbidite_contact_engine
from yade.minieigenHP import Vector3
from yade.wrapper import Omega

from . import display, memory
from .refusal import Refused
from .scene import read_scene

O = Omega()
YADE_DEFAULT_STEP = 1e-8
# of the smaller radius, for new bodies; packings of soft bodies have 0.01 at most
MOST_OVERLAP = 0.05
OF_A_DIAMETER = ('capillary', 'cohesion')  # their forces depend on the radii
SAME_GRAVITY = 1e-12  # of it: digits of a saved scene


def settings(gravity, show, diameter, contact):
    """Checked settings in JSON types: gravity, show, diameter, options (strings, by key of the group contact)."""
    if not hasattr(gravity, '__len__') or len(gravity) != 3:
        told = tuple(gravity) if hasattr(gravity, '__len__') else gravity
        raise Refused(f'turbidite_contact: gravity = {told} must be (x, y, z); z is 0 in the plane')
    if int(show) != show or show < 0:
        raise Refused(f'turbidite_contact: show = {show} must be a whole number of steps, or 0')
    if 'friction' in contact:
        raise Refused('turbidite_contact: friction is that of the materials (FrictMat.frictionAngle) of the bodies')
    if diameter is None and contact.get('adhesion') in OF_A_DIAMETER:
        raise Refused(f'turbidite_contact: adhesion = {contact["adhesion"]!r} needs diameter [m]: adhesion_force is the '
                      'force between two grains of it, and that of others follows from their radii')
    if diameter is not None and not (diameter > 0 and math.isfinite(diameter)):
        raise Refused(f'turbidite_contact: diameter = {diameter!r} must be a positive length [m]')
    options = {key: str(value) for key, value in contact.items()}
    result = {'gravity': [float(g) for g in gravity], 'show': int(show), 'options': options}
    if diameter is not None:
        result['diameter'] = float(diameter)
    new_engine(result)  # raises for settings that the engine does not accept
    return result


def new_engine(settings):
    return turbidite_contact_engine.ContactEngine(settings['options'], settings['gravity'],
                                                  settings.get('diameter', 1.0))


class Contact:
    """One contact point; vectors have three components."""

    def __init__(self, record):
        self.id1, self.id2, point, normal, self.gap, pushing, dragging, self.rolling_moment, self.wall = record
        self.point, self.normal = Vector3(*point), Vector3(*normal)
        self.normal_force = pushing * self.normal
        self.shear_force = Vector3(*dragging)
        self.force = self.normal_force + self.shear_force


class Host:
    """`settings` as returned above; `mark`: that of the store with which this engine is up to date."""

    def __init__(self, settings, remembered, mark):
        if settings.get('not_in_yade'):
            raise Refused(f'turbidite_contact: the case of this scene has {settings["not_in_yade"]} that YADE\'s scene '
                          'does not have: its grains cannot go on without them')
        self.settings, self.mark = settings, mark
        self.engine = new_engine(settings)
        if remembered:
            self.engine.restore_memory(remembered)
        self.scene = None
        self.read_again = False  # a script has asked for it
        self.report = {}
        self.unconverged_steps = 0
        self.dt = None
        self.shown = False
        self.sync_count = -1

    def step(self, store):
        check_loop(Vector3(*self.settings['gravity']))
        self.follow_scene()
        self.dt = O.dt
        self.report = self.engine.step(self.dt, *self.loads())
        self.count_unconverged()
        self.mark = memory.write(store, self.settings, self.engine.memory())
        every = self.settings['show']
        if every and O.iter % every == 0:
            self.show()
        elif self.shown:
            display.clear()
            self.shown = False
        self.sync_count = O.forces.syncCount

    def follow_scene(self):
        """Lays the engine out again if bodies were added, erased or changed."""
        if self.scene is None or self.read_again or self.scene.changed() or self.engine.outdated(len(O.bodies)):
            known = [] if self.scene is None or self.read_again else self.scene.members()
            self.scene = read_scene()
            self.engine.lay_out(self.scene.layout)
            self.read_again = False
            if self.scene.members() != known:
                self.check_overlap()

    def check_overlap(self):
        worst = self.engine.overlap()
        if worst and worst[3] > MOST_OVERLAP:
            self.read_again = True
            first, second, depth, share, wall = worst
            pair = f'body {second} reaches {depth:.3g} into wall {first}' if wall else \
                f'bodies {first} and {second} overlap by {depth:.3g}'
            raise Refused(f'turbidite_contact: {pair}, {share:.3g} of the smaller radius; rigid bodies may start with '
                          f'at most {MOST_OVERLAP:g}. Move them apart')

    def loads(self):
        """(forces, torques) of O.forces by body; empty if none were set in this step.

        The force container counts how often it has summed the forces of its threads. No new sum since the last
        step, and no permanent forces, means that there are none.
        """
        ids = self.scene.ids
        if not ids:
            return [], []
        O.forces.f(ids[0], True)
        if O.forces.syncCount == self.sync_count and not O.forces.getPermForceUsed():
            return [], []
        return [O.forces.f(i) for i in ids], [O.forces.t(i) for i in ids]

    def count_unconverged(self):
        if not self.report['converged']:
            self.unconverged_steps += 1
            if self.unconverged_steps == 1:
                print(f'turbidite_contact: step {O.iter} did not converge (residual '
                      f'{self.report["residual"]:.2g} after {self.report["iterations"]} sweeps); '
                      'report()["unconverged_steps"] counts such steps', flush=True)
        self.report['unconverged_steps'] = self.unconverged_steps

    def contacts(self):
        return [Contact(record) for record in self.engine.contacts()]

    def contact_force(self, body):
        """Contact force on a body [N]; on a wall, the reaction."""
        for number, impulse, _ in self.engine.impulses():
            if number == body:
                return Vector3(*impulse) / self.dt
        if body not in self.scene.walls():
            raise Refused(f'turbidite_contact: contact_force({body!r}): there is no body or wall of that id')
        forces = (-contact.force for contact in self.contacts() if contact.wall and contact.id1 == body)
        return sum(forces, Vector3.Zero)

    def show(self):
        display.show(self.contacts(), self.engine.impulses(), self.dt)
        self.shown = True


def check_loop(gravity):
    """Checks that no other engine moves the bodies, that this one does so once, and that the forces of the last step
    are cleared."""
    if O.dt == YADE_DEFAULT_STEP or not O.dt > 0:
        raise Refused(f'turbidite_contact: O.dt = {O.dt} s; set the time step, usually 1e-3 to 1e-2 of sqrt(D/g)')
    resetter = False
    steps = 0
    for engine in O.engines:
        name = type(engine).__name__
        if engine.dead:
            if name == 'NewtonIntegrator' and (engine.gravity - gravity).norm() > SAME_GRAVITY * gravity.norm():
                raise Refused(f'turbidite_contact: the NewtonIntegrator of O.engines has gravity = '
                              f'{tuple(engine.gravity)}, the contact engine {tuple(gravity)}. Make the engines anew: '
                              'O.engines = turbidite_contact.engines(gravity=...), or attach(gravity=...)')
            continue
        if name == 'NewtonIntegrator':
            raise Refused('turbidite_contact: a NewtonIntegrator in O.engines would move the bodies a second time; '
                          'remove it (the dead one of turbidite_contact.engines() only supplies gravity)')
        resetter = resetter or name == 'ForceResetter'
        steps += engine.label == 'turbidite_contact'
        if steps > 1:
            raise Refused('turbidite_contact: its engines are in O.engines twice and would make two steps in one. '
                          'O.engines = turbidite_contact.engines(...) or attach(...) sets them once')
        if engine.label == 'turbidite_contact' and not resetter:
            raise Refused('turbidite_contact: no ForceResetter before it in O.engines; forces would accumulate from '
                          'step to step. Keep the one of turbidite_contact.engines()')
