# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE's scene of a coupled run with the contact engine.

Bodies, walls, materials and engines are YADE's own and available to recorders and plots; contacts and motion are
computed by the contact engine, which a PyRunner calls once per window.
"""
import json
import math
import os
import sys

import domain_sides
import turbidite_contact
import users_script
from yade import *
from yade import utils
from yade.minieigenHP import Vector3

# One window of the coupled run, called from YADE's loop.
WINDOW = 'import nscd_scene; nscd_scene.play_window()'
_playing = None


def play_window():
    if _playing is None or _playing.participant is None:
        raise RuntimeError('no coupled run is active: grains.script must not step; to continue a saved scene without '
                           'the fluid, call turbidite_contact.attach()')
    _playing.play_window()


class Store:
    """Settings and contact impulses in YADE's scene, stored where turbidite_contact finds them."""

    # Units of the keys of a case, by key of the group contact.
    UNITS = {'recovery_speed': 'run.velocity_scale', 'restitution_speed': 'run.velocity_scale',
             'adhesion_range': 'run.diameter', 'adhesion_length': 'run.diameter',
             'adhesion_force': 'run.grain_weight'}

    def __init__(self, case, corners):
        options = {key.removeprefix('contact.'): value for key, value in case.items()
                   if key.startswith('contact.') and key.count('.') == 1 and key != 'contact.friction'}
        for key, unit in self.UNITS.items():
            if key in options:
                options[key] = repr(float(options[key]) * float(case[unit]))
        self.settings = {'gravity': [0.0, -float(case['run.gravity']), 0.0], 'show': 0, 'options': options,
                         'diameter': float(case['run.diameter'])}
        if missing := not_in_yade(case, corners):
            self.settings['not_in_yade'] = missing
        self.engine = turbidite_contact.memory.holder(self.settings)

    def keep(self, contacts):
        turbidite_contact.memory.write(self.engine, self.settings, contacts)


class Scene:
    """Builds YADE's bodies for the grains of a case, removes those that leave, and runs the windows."""

    def __init__(self):
        self.body_of = {}  # grain id -> body id
        self.labels = []   # labels of YADE's materials, by material index of the grains
        self.sides, self.plates = [], []  # body ids of the walls
        self.case = {}
        self.corners = False     # of some grain
        self.script = None       # users_script
        self.participant = None  # turbidite_yade.Participant, when windows are played
        self.engine_error = None
        self.over = False        # the run, for this program

    def create(self, settings, grains):
        """Adds the walls and one body per grain, in the order of their ids; returns states and turns (turn.hpp) in the
        order of `grains`."""
        self.case = settings
        self._create_materials(settings, grains[0]['density'] if grains else 1.0)
        self.sides = list(domain_sides.create_walls(settings, self.labels[int(settings.get('run.side_material', 0))]))
        self.corners = any(grain['vertices'] for grain in grains)
        in_space = domain_sides.in_space(settings)
        # What the engine remembers of a contact is named by the smaller id first: bodies that stand in for grains in a
        # saved scene (turbidite_contact.attach) are in the same order.
        made = {grain['id']: self._add_body(grain, in_space) for grain in sorted(grains, key=lambda grain: grain['id'])}
        states, turns = ([made[grain['id']][k] for grain in grains] for k in (0, 1))
        O.dt = float(settings['run.step'])
        if walls_of_the_engine(settings):
            print(f'{walls_of_the_engine(settings)} walls inside the box are not in YADE\'s scene: the contact engine '
                  'has them, and recorders and pictures of YADE do not show them', flush=True)
        return states, turns

    def _add_body(self, grain, in_space):
        """(state, turn) of the body of a grain."""
        body = self._create_polygon(grain) if grain['vertices'] else self._create_sphere(grain)
        turn = axes_of(body) if grain['vertices'] else None
        state = body.state
        # As in the contact problem: per unit length in the plane.
        state.mass = grain['mass']
        state.inertia = (Vector3(1, 1, 1) if in_space else Vector3(0.5, 0.5, 1)) * grain['inertia']
        state.blockedDOFs = 'xyzXYZ' if grain['prescribed'] else '' if in_space else 'zXY'
        state.vel = grain['velocity']
        state.angVel = grain['angular_velocity']
        self.body_of[grain['id']] = O.bodies.append(body)
        return O.bodies[self.body_of[grain['id']]].state, turn

    def _create_materials(self, settings, density):
        """YADE materials for the scene's own use; the contact engine has its own table."""
        for name in ['grains'] + settings.get('run.materials', '').split():
            friction = settings.get('contact.materials.%s.friction' % name, settings['contact.friction'])
            O.materials.append(FrictMat(
                density=density, frictionAngle=math.atan(float(friction)), label=name))
            self.labels.append(name)

    def _create_sphere(self, grain):
        return utils.sphere(grain['position'], grain['radius'], material=self.labels[grain['material']])

    def _create_polygon(self, grain):
        """YADE rotates a Polyhedra to its principal axes; the participant converts the orientation."""
        body = turbidite_contact.polygon(grain['vertices'], material=self.labels[grain['material']])
        body.state.pos = grain['position']
        return body

    def side_states(self):
        """States of the solid sides, in the order left, right, bottom, top, front, back."""
        return [O.bodies[i].state for i in self.sides]

    def create_plates(self, half_lengths):
        """Creates the walls inside the box, along x around the origin; the participant places and moves them.

        The position of a facet is the centre of its inscribed circle. For these triangles that is the middle of the
        line, from -h to h, in which they cross z = 0.
        """
        root = math.sqrt(3)
        corners = [((-1.5 * h, 0, -0.5 * root * h), (1.5 * h, 0, -0.5 * root * h), (0, 0, root * h))
                   for h in half_lengths]
        self.plates = [O.bodies.append(utils.facet(triangle, material='grains')) for triangle in corners]
        return [O.bodies[i].state for i in self.plates]

    def complete(self):
        """Called when bodies are in place: adds the engines and runs the user's additions to the scene."""
        global _playing
        _playing = self
        self.store = Store(self.case, self.corners)
        windows = windows_before(sys.argv[1])
        begin_at(windows)
        O.engines = [PyRunner(command=WINDOW, iterPeriod=1, label='turbidite'), self.store.engine]
        self.script = users_script.complete_scene(self.case)
        if windows > 0:
            go_on_with_periods(windows)

    def begin_window(self, index, moved):
        if self.engine_error is not None:
            raise self.engine_error
        self.script.check(moved)

    def play(self, participant):
        """Runs all windows. An error in an engine between two windows is reported in the next window."""
        self.participant = participant
        try:
            O.run(wait=True)
            if not self.over:
                self.engine_error = self.script.stopped()
        except RuntimeError as error:
            self.engine_error = error
        if self.engine_error is not None:
            participant.step()

    def play_window(self):
        """Runs one window and stores the contact impulses, so that O.save in a script includes them."""
        if not self.participant.step():
            self.over = True
            # Not O.pause(): O.run would return while engines after this one still work on the step, and YADE's exit,
            # which waits for its thread without releasing Python's lock, would wait for ever.
            O.stopAtIter = O.iter + 1
        if self.script.may_save:
            self.store.keep(self.participant.contacts())

    def erase(self, ids):
        bodies = [self.body_of.pop(grain) for grain in ids]
        self.script.expect_fewer(bodies)
        for body in bodies:
            O.bodies.erase(body)


def windows_before(run_folder):
    """Windows that earlier parts of a resumed run have done."""
    file = os.path.join(run_folder, 'run.json')
    if not os.path.exists(file):
        return 0
    with open(file) as record:
        parts = json.load(record).get('parts') or [{}]
    return parts[-1].get('from_window', 0)


def begin_at(windows):
    """O.iter counts windows, also of a run that was resumed: recorders name files by it, and tell the time."""
    if windows > 0:
        O._sceneObj.updateAttrs({'iter': windows, 'time': windows * O.dt})


def go_on_with_periods(windows):
    """Engines are due when they would be in a run that was not interrupted. As at its start, the first step is empty: an
    engine that has not been looked at (nDone = 0) would count its period from there."""
    for engine in O.engines:
        if getattr(engine, 'iterPeriod', 0) > 0:
            engine.updateAttrs({'iterLast': windows - windows % engine.iterPeriod, 'nDone': 1})
        if getattr(engine, 'virtPeriod', 0) > 0:
            periods = math.floor(windows * O.dt / engine.virtPeriod * (1.0 + 1e-12))
            engine.updateAttrs({'virtLast': periods * engine.virtPeriod, 'nDone': 1})


def walls_of_the_engine(case):
    """How many walls inside the box YADE's scene does not have: all those of space."""
    walls = case.get('run.walls', '')
    return len(walls.split(';')) if walls and domain_sides.in_space(case) else 0


def plates_of_their_own(case):
    """How many walls inside the box, in the plane, have a thickness or another friction than grains; YADE's facets have
    neither."""
    if domain_sides.in_space(case) or not case.get('run.walls'):
        return 0
    plates = [[float(number) for number in plate.split()] for plate in case['run.walls'].split(';')]
    # id x1 y1 x2 y2 vx vy spin px py friction thickness
    return sum(plate[10] != float(case['contact.friction']) or plate[11] > 0.0 for plate in plates)


def remembers_states(case):
    """The law of a case whose contacts have states that outlive a window, in words; '' without."""
    for key, plain in (('adhesion', 'none'), ('law', 'coulomb')):
        if case.get('contact.' + key, plain) != plain:
            return case['contact.' + key]
    return ''


def not_in_yade(case, corners):
    """What holds the grains of a case and is not in YADE's scene, in words; '' without any. `corners`: it has polygons."""
    parts = []
    if walls_of_the_engine(case):
        parts.append(f'{walls_of_the_engine(case)} walls inside the box (domain.walls_file)')
    if own := plates_of_their_own(case):
        parts.append(f'{own} walls inside the box of a thickness or friction of their own (domain.walls_file)')
    if corners and remembers_states(case):
        parts.append(f'{remembers_states(case)} between polygons, whose corners YADE numbers in another order,')
    cyclic = [side for side in domain_sides.NAMES if case.get('domain.' + side) == 'cyclic']
    if cyclic:
        parts.append(f'cyclic sides ({", ".join(cyclic)})')
    return ' and '.join(parts)


def axes_of(body):
    """Orientation of a body in the axes in which it was created, (w, x, y, z)."""
    ori = body.state.ori
    return ori[3], ori[0], ori[1], ori[2]
