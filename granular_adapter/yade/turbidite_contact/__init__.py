# SPDX-License-Identifier: GPL-3.0-or-later
"""Rigid grains by non-smooth contact dynamics in your own YADE script, without coupling:

    import turbidite_contact
    O.engines = turbidite_contact.engines(gravity=(0, -9.81, 0))

docs/yade.md explains which bodies, materials and forces are supported, and how results reach YADE's tools.
"""
from yade.minieigenHP import Vector3
from yade.wrapper import ForceResetter, NewtonIntegrator, Omega, PyRunner

from . import host as _host
from . import memory
from .parts import disc, make_disc, polygon
from .refusal import Refused

__all__ = ['Refused', 'attach', 'contact_force', 'contacts', 'disc', 'engines', 'make_disc', 'polygon', 'refresh',
           'report', 'show', 'step']

O = Omega()
_DEFAULT_GRAVITY = (0.0, -9.81, 0.0)
_STEP = 'import turbidite_contact; turbidite_contact.step()'
_present = None  # the host of the scene that made the last step


def engines(gravity=_DEFAULT_GRAVITY, show=0, diameter=None, **contact):
    """A list for O.engines, which begins with ForceResetter and ends with the store of contact impulses.

    gravity  [m/s2]; no z component where bodies move in the plane
    show     interval in steps at which O.interactions and O.forces show the contacts (0: never); recorders that
             read them must run at multiples of it, after these engines
    diameter [m] of the grains between which adhesion_force acts, with adhesion='capillary' or 'cohesion'
    contact  tolerance, iterations, law, solver, ...: the keys of `turbidite keys` in the group contact,
             in SI units, except friction, which is that of the bodies' materials

    Engines that add forces (O.forces.addF) belong after the first of the list, all others after the last.
    Raises Refused or RuntimeError, naming the key, for a setting that is not allowed.
    """
    settings = _host.settings(gravity, show, diameter, contact)
    return [
        ForceResetter(),
        # Inactive: unbalancedForce and similar functions read gravity from it.
        NewtonIntegrator(gravity=Vector3(*settings['gravity']), damping=0.0, dead=True),
        PyRunner(command=_STEP, iterPeriod=1, initRun=True, label='turbidite_contact'),
        memory.holder(settings),
    ]


def attach(gravity=None, show=0, diameter=None, **contact):
    """Sets O.engines to engines(...) in place of those present engines that detect contacts or integrate.

    What stands before the integrator, such as a ForceEngine, acts before the contacts; the rest follows them. The
    default gravity is that of the present integrator, or (0, -9.81, 0) without one. Impulses stored by the present
    engines, or in a scene saved by a coupled run, are kept.
    """
    present = O.engines
    integrators = [k for k, engine in enumerate(present) if type(engine).__name__ == 'NewtonIntegrator']
    if gravity is None:
        gravity = present[integrators[0]].gravity if integrators else _DEFAULT_GRAVITY
    ours = engines(gravity, show, diameter, **contact)
    for engine in present:
        if engine.label == memory.LABEL:
            memory.succeed(engine, ours[-1])
    place = integrators[0] if integrators else 0
    O.engines = ours[:1] + _kept(present[:place]) + ours[1:] + _kept(present[place:])


def _kept(engines):
    """Those that the contact engine does not replace."""
    replaced = ('ForceResetter', 'InsertionSortCollider', 'InteractionLoop', 'NewtonIntegrator',
                'GlobalStiffnessTimeStepper')
    return [engine for engine in engines
            if type(engine).__name__ not in replaced and not engine.label.startswith('turbidite')]


def step():
    """One step of length O.dt; called by the PyRunner of engines()."""
    global _present
    store = memory.find()
    if _present is None or not memory.is_marked(store, _present.mark):
        _present = _host.Host(*memory.read(store), memory.mark(store))
    _present.step(store)


def report():
    """Results of the last step's solver: contacts, iterations, residual, converged, quad, max, candidates, and
    unconverged_steps since the script started or loaded a scene."""
    return dict(_stepped().report)


def contacts():
    """Contact points of the last step with a force: objects with id1, id2, point [m], normal (from id1 to id2),
    gap [m], normal_force, shear_force (on id2) [N], rolling_moment [N m]."""
    return _stepped().contacts()


def contact_force(body):
    """Sum of the contact forces of the last step on a body or wall, by its id [N]; Refused if there is none."""
    return _stepped().contact_force(body)


def show():
    """Writes the last step's contacts into O.interactions and O.forces now."""
    _stepped().show()


def refresh():
    """Re-reads the scene before the next step; needed after a script has replaced the state of a body, changed a
    shape, or moved a body where it overlaps others. Bodies that come or go, other masses, degrees of freedom, masks,
    materials, friction angles, walls and periodic cells are detected without it."""
    if _present is not None:
        _present.read_again = True


def _stepped():
    if _present is None or not memory.is_marked(memory.find(), _present.mark):
        raise Refused('turbidite_contact: no step of this scene has been made yet')
    return _present
