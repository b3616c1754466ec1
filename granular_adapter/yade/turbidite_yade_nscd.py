# SPDX-License-Identifier: GPL-3.0-or-later
"""YADE as the grains participant: `yade -n -x turbidite_yade_nscd.py RUN`, started by `turbidite run`.

Bodies, walls, materials and engines are YADE's own and open to recorders and plots; contacts and motion are
the contact engine's, called once per window by a PyRunner. `-x` is needed: without it a Python error
opens a prompt and the job waits for ever.
"""
import math
import sys
import traceback

# First of all: mpy splits the world when it is imported, and every process of the job takes part in that
# one split now. Imported later (YADE does so at its exit) it would hang a finished job.
from yade import mpy

import yade.config
from yade import *
from yade import utils


def abort():
    """Ends the whole job with the traceback of the present exception.

    An orderly exit would wait in MPI_Finalize for programs that wait for this one.
    """
    traceback.print_exc()
    sys.stderr.flush()
    mpy.MPI.COMM_WORLD.Abort(4)


try:
    import turbidite_yade
except ImportError:
    abort()


class Scene:
    """Builds YADE's bodies for the grains of a case and takes away those that leave."""

    def __init__(self):
        self.body_of = {}  # grain id -> body id

    def create(self, settings, grains):
        """Adds walls and one disc per grain; returns the discs' states in the order of `grains`."""
        O.materials.append(FrictMat(
            density=grains[0]['density'] if grains else 1.0,
            frictionAngle=math.atan(float(settings['contact.friction'])), label='grains'))
        self._create_walls(settings)
        states = []
        for grain in grains:
            body = utils.sphere(grain['position'], grain['radius'], material='grains')
            state = body.state
            # A disc per unit length, not YADE's sphere.
            state.mass = grain['mass']
            state.inertia = (grain['inertia'],) * 3
            state.blockedDOFs = 'zXY'
            state.vel = grain['velocity']
            state.angVel = grain['angular_velocity']
            self.body_of[grain['id']] = O.bodies.append(body)
            states.append(O.bodies[self.body_of[grain['id']]].state)
        O.dt = float(settings['run.step'])
        return states

    def _create_walls(self, settings):
        sides = {'left': (0, 0.0, 1), 'right': (0, float(settings['run.size_x']), -1),
                 'bottom': (1, 0.0, 1), 'top': (1, float(settings['run.size_y']), -1)}
        for side, (axis, position, sense) in sides.items():
            if settings['domain.' + side] == 'wall':
                O.bodies.append(utils.wall(position, axis, sense=sense, material='grains'))

    def erase(self, ids):
        for grain in ids:
            O.bodies.erase(self.body_of.pop(grain))


def play_window():
    """Called by YADE's loop: one window of the coupled run."""
    if not participant.step():
        O.pause()


try:
    participant = turbidite_yade.Participant(
        sys.argv[1], mpy.MPI._handleof(mpy.comm), Scene(), yade.config.version)
    if participant.start():
        O.engines = [PyRunner(command='play_window()', iterPeriod=1, label='turbidite')]
        O.run(wait=True)
    code = participant.leave()
except Exception:
    abort()
sys.stdout.flush()
if code != 0:
    sys.exit(code)
