# SPDX-License-Identifier: GPL-3.0-or-later
"""grains.script: a Python file of the user that adds to the scene of a coupled run.

It runs once, after bodies and engines have been created and before the first window, in YADE's namespace like any
YADE script. It must not change what the coupling relies on: O.dt, the existing engines, and the bodies. All of
this is checked after the script and again before every window. Errors name the file.
"""
import os
import sys

import __main__
from yade import *


class Fault(Exception):
    """The script has changed something that belongs to the case."""


def complete_scene(settings):
    """Runs the script of the case, if there is one; returns the object that checks the scene before every window."""
    if not settings.get('grains.script'):
        return NoScript()
    return Script(os.path.join(sys.argv[1], settings['grains.script']))


class NoScript:
    may_save = False  # the scene, by O.save

    def check(self, moved=None):
        pass

    def check_walls(self):
        pass

    def check_step(self):
        pass

    def check_one_step(self, before):
        pass

    def stopped(self):
        return Fault('YADE has stopped before the run was over')

    def expect_fewer(self, bodies):
        pass

    def before_save(self):
        pass

    def after_load(self):
        pass


class Script:
    may_save = True

    # In O.tags, which a saved scene contains: places of the engines of the case among all of them.
    PLACES = 'turbidite_engines'

    def __init__(self, file):
        self.file = file
        self.step, self.engines = O.dt, list(O.engines)
        self.bodies, self.count = {body.id: body for body in O.bodies}, len(O.bodies)
        self.materials, self.setups = self._materials(), self._setups()
        self.walls = {i: self._place(body) for i, body in self.bodies.items() if not hasattr(body.shape, 'radius')}
        begin = (O.iter, self._motions())
        self._run()
        if O.iter != begin[0]:
            self._refuse('made steps (O.run, O.step) or loaded a scene', 'the coupled run makes the steps')
        self.check()
        for body, motion in self._motions().items():
            if motion != begin[1][body]:
                self._refuse(f'moved body {body} or changed its mass, size, material or degrees of freedom',
                             'grains begin as the case says: use grains.file')

    def _run(self):
        with open(self.file) as source:
            code = compile(source.read(), self.file, 'exec')
        exec(code, vars(__main__))

    def _motions(self):
        return {i: self._motion(O.bodies[i]) for i in self.bodies if O.bodies[i] is not None}

    @staticmethod
    def _motion(body):
        state = body.state
        return (tuple(state.pos), tuple(state.ori), tuple(state.vel), tuple(state.angVel), state.mass,
                tuple(state.inertia), state.blockedDOFs, getattr(body.shape, 'radius', None), body.material.id)

    @staticmethod
    def _place(body):
        return tuple(body.state.pos), tuple(body.state.vel), tuple(body.state.angVel)

    @staticmethod
    def _materials():
        """What contacts take from the materials: friction, and springs and dashpots of molecular dynamics."""
        return [tuple(getattr(material, name, None) for name in ('frictionAngle', 'kn', 'ks', 'cn', 'cs'))
                for material in O.materials]

    def _setups(self):
        """What engines of the case do: those that are dead do nothing; gravity and damping are the integrator's."""
        return [(engine.dead, tuple(getattr(engine, 'gravity', ())), getattr(engine, 'damping', None))
                for engine in self.engines]

    def check(self, moved=None):
        """Called before every window; `moved` is the id of a grain not moved by the coupling."""
        self.check_step()
        self._check_engines()
        self._check_bodies()
        # Materials that the script has added follow those of the case.
        if self._materials()[:len(self.materials)] != self.materials:
            self._refuse('changed the friction or the springs of a material',
                         'use contact.friction or contact.materials, and contact.md_stiffness')
        if moved is not None:
            self._refuse(f'moved grain {moved} or changed its velocity',
                         'the fluid also moves grains and would not see the change')

    def check_walls(self):
        """Called before every window where walls stay where they are."""
        for i, place in self.walls.items():
            if self._place(O.bodies[i]) != place:
                self._refuse(f'moved wall {i}', 'walls stay where the case has them')

    def check_step(self):
        """Called before every step: with a longer O.dt grains would leave the domain within the window."""
        if O.dt != self.step:
            self._refuse(f'changed O.dt from {self.step} to {O.dt}', 'use time.step, or contact.md_substeps')

    def check_one_step(self, before):
        """Called after a step of YADE that began with O.iter = `before`."""
        if O.iter != before + 1:
            self._refuse(f'made {O.iter - before - 1} steps within one (O.run, O.step)', 'the coupled run makes the steps')

    def stopped(self):
        """The fault of a YADE that has stopped before the run was over."""
        return Fault(f'grains.script: {self.file} stopped YADE before the run was over (O.pause, O.stopAtIter, O.stopAtTime); '
                     'to end a run early, make a file STOP in its folder')

    def _engine_places(self):
        present = list(O.engines)
        return [next((k for k, engine in enumerate(present) if engine is ours), None) for ours in self.engines]

    def _check_engines(self):
        places = self._engine_places()
        for ours, place in zip(self.engines, places):
            name = f'{type(ours).__name__} {ours.label}'.strip()
            if place is None:
                self._refuse(f'removed the engine {name}', 'O.engines = O.engines + [...] adds some')
        if places != sorted(places):
            self._refuse('reordered the engines of the case', 'keep their order and add others')
        for ours, before, now in zip(self.engines, self.setups, self._setups()):
            if now != before:
                self._refuse(f'switched off the engine {type(ours).__name__} {ours.label}'.rstrip() if now[0] != before[0]
                             else 'changed gravity or damping of the integrator',
                             'engines of the case do what it says; gravity is that of its scales')

    def _check_bodies(self):
        if len(O.bodies) != self.count:
            added = len(O.bodies) - self.count
            self._refuse(f'added {added} {"body" if added == 1 else "bodies"}', 'bodies are those of the case: use grains.file')
        for i in self.bodies:
            if O.bodies[i] is None:
                self._refuse(f'erased body {i}', 'bodies are those of the case')

    def expect_fewer(self, bodies):
        """Called when the coupling itself erases these bodies."""
        for i in bodies:
            del self.bodies[i]

    def before_save(self):
        """Called before the coupling saves the scene."""
        self._check_engines()
        O.tags[self.PLACES] = ' '.join(str(place) for place in self._engine_places())

    def after_load(self):
        """Called when the coupling has loaded a scene that it had saved: all of its objects are other ones."""
        present = list(O.engines)
        O.engines = present     # what has been set from Python is the same object when it is read again
        self.engines = [present[int(place)] for place in O.tags[self.PLACES].split()]
        self.bodies = {body.id: body for body in O.bodies}

    def _refuse(self, deed, remedy):
        raise Fault(f'grains.script: {self.file} {deed}, which belongs to the case; {remedy}')
