# SPDX-License-Identifier: LGPL-2.1-or-later
"""falling.py RUN: discs that fall freely, spin and touch nothing, for tests of adapters in Python.

Falling(library): `library` is turbidite_adapter, or wire_adapter, which has the same names."""
import sys

import numpy


class Falling:
    name, version, host_code, restores_within_window = 'falling', '1', 'Python', True

    def __init__(self, library):
        self.library = library

    def initialise(self, settings, shapes, grains):
        wet = settings.flag('fluid.enabled')
        fluid = settings.real('run.fluid_density') if wet else 0.0
        h, r = settings.real('fluid.hydrodynamic_radius') if wet else 0.0, grains['radius']
        self.grains, self.g = grains, settings.real('run.gravity')
        self.mass = numpy.pi * r**2 * (grains['density'] - h**2 * fluid)            # cM of step 4
        self.inertia = numpy.pi / 2 * r**4 * (grains['density'] - h**4 * fluid)
        self.fall = numpy.pi * r**2 * (grains['density'] - fluid) * self.g / self.mass
        return self.answer()

    def advance(self, window, responses):
        if len(responses):
            self.hold(responses)
        else:
            self.grains['announced_impulse'] = self.grains['announced_angular_impulse'] = 0
            self.grains['velocity'][:, 1] -= self.fall * window.step
        return self.answer()

    def hold(self, responses):
        """The window once more, with the impulse that leads to the velocity of the response."""
        mine = self.places(responses)
        for field, held, inertia in (('velocity', 'announced_impulse', self.mass),
                                     ('angular_velocity', 'announced_angular_impulse', self.inertia)):
            self.grains[held] += inertia[:, None] * (responses[field][mine] - self.grains[field])
            self.grains[field] = responses[field][mine]

    def apply_kick(self, window, kicks):
        if len(kicks):                                  # none without a fluid
            mine = self.places(kicks)
            for field in ('velocity', 'angular_velocity'):
                self.grains[field] = kicks[field][mine]
        self.grains['position'] += window.step * self.grains['velocity']
        for grain in self.grains:
            grain['orientation'] = turned(grain['orientation'], window.step * grain['angular_velocity'][2])
        return self.answer()

    def places(self, records):
        """Of my grains in records with the same ids in another order."""
        order = numpy.argsort(records['id'])
        return order[numpy.searchsorted(records['id'], self.grains['id'], sorter=order)]

    def answer(self):
        return self.library.Motion(self.grains.copy())

    def save(self):
        return self.grains.tobytes()

    def restore(self, state):
        self.grains = numpy.frombuffer(state, self.library.GRAIN).copy()


def turned(q, angle):
    c, s = numpy.cos(angle / 2), numpy.sin(angle / 2)
    return numpy.array((c * q[0] - s * q[3], 0, 0, c * q[3] + s * q[0]))


if __name__ == '__main__':
    import turbidite_adapter
    turbidite_adapter.run_grains(Falling(turbidite_adapter), sys.argv[-1])
