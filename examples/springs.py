# SPDX-License-Identifier: LGPL-2.1-or-later
"""Discs or spheres with springs and dashpots, in sub-steps, as a grains adapter:
grains.command: /usr/bin/python3 springs.py

Frictionless; the same model as springs.cpp. docs/write-an-adapter.md explains every line."""
import sys

import numpy
import turbidite_adapter as turbidite


def turned(q, turn):
    """Quaternions (w, x, y, z) turned by these vectors, of angle |turn| about their direction."""
    half = 0.5 * numpy.sqrt((turn**2).sum(axis=1))
    c, s = numpy.cos(half), 0.5 * numpy.sinc(half / numpy.pi)[:, None] * turn      # sin(half) along the axis
    w = c * q[:, 0] - (s * q[:, 1:]).sum(axis=1)
    return numpy.column_stack([w, c[:, None] * q[:, 1:] + q[:, :1] * s + numpy.cross(s, q[:, 1:])])


class Springs:
    name, version, host_code, native_substeps = 'springs-py', '1.0', 'numpy', True
    shapes, dimensions = ['disc', 'sphere'], (2, 3)
    knows = ['restitution']                                         # cases with friction, free sides, ... are refused

    def initialise(self, settings, shapes, grains):
        self.axes = 3 if settings.get('run.dimension') == '3' else 2
        self.grains, self.size = grains, [settings.real('run.size_' + axis) for axis in 'xyz'[:self.axes]]
        self.gravity, self.substeps = settings.real('run.gravity'), settings.integer('run.md_substeps')
        self.omega, self.damping = settings.real('run.md_frequency'), settings.real('run.md_damping')
        wet = settings.flag('fluid.enabled')
        fluid = settings.real('run.fluid_density') if wet else 0.0
        shift = settings.real('run.surface_shift') if wet and 'run.surface_shift' in settings else 0.0
        seen = (settings.real('fluid.hydrodynamic_radius') if wet else 1.0) * grains['radius'] + shift
        volume = self.volume(grains['radius'])
        self.mass = volume * grains['density'] - self.volume(seen) * fluid          # the inertia of step 4, cM
        self.weight = volume * (grains['density'] - fluid) * self.gravity
        return turbidite.Motion(grains)

    def volume(self, radius):                                       # of a disc per unit length
        return 4 / 3 * numpy.pi * radius**3 if self.axes == 3 else numpy.pi * radius**2

    def push(self, force, overlap, closing, normal, reduced_mass):
        """Adds spring and dashpot along `normal` (n, 2); returns the force."""
        value = numpy.maximum(0.0, reduced_mass * self.omega * (self.omega * overlap + 2 * self.damping * closing))
        return numpy.where(overlap > 0, value, 0.0)[:, None] * normal

    def contact_forces(self, x, v):
        r, m, force = self.grains['radius'], self.mass, numpy.zeros_like(x)
        i, j = numpy.triu_indices(len(x), 1)                        # all pairs: an example
        apart = x[j] - x[i]
        distance = numpy.sqrt((apart**2).sum(axis=1))
        normal, overlap = apart / distance[:, None], r[i] + r[j] - distance
        closing = numpy.einsum('ij,ij->i', v[i] - v[j], normal)
        f = self.push(force, overlap, closing, normal, m[i] * m[j] / (m[i] + m[j]))
        numpy.add.at(force, j, f)
        numpy.add.at(force, i, -f)
        self.overlap = max(self.overlap, overlap.max(initial=0.0))
        for axis, sign, place in [side for k, size in enumerate(self.size) for side in ((k, 1, 0), (k, -1, size))]:
            wall = numpy.zeros_like(x)
            wall[:, axis] = sign
            overlap = r - sign * (x[:, axis] - place)
            force += self.push(force, overlap, -sign * v[:, axis], wall, m)
            self.overlap = max(self.overlap, overlap.max())
        return force

    def advance(self, window, responses):
        x, v = self.grains['position'][:, :self.axes].copy(), self.grains['velocity'][:, :self.axes].copy()
        impulse, dt = numpy.zeros_like(x), window.step / self.substeps
        self.overlap = 0.0                                          # the largest of the window
        for _ in range(self.substeps):
            force = self.contact_forces(x, v)
            impulse += dt * force
            v += dt * (force - numpy.outer(self.weight, (0, 1, 0)[:self.axes])) / self.mass[:, None]
            x += dt * v
        self.moved, self.touched = x, numpy.any(impulse != 0, axis=1)
        self.grains['velocity'][:, :self.axes], self.grains['contact_impulse'][:, :self.axes] = v, impulse
        return turbidite.Motion(self.grains, contacts=int(self.touched.sum()), iterations=self.substeps)

    def apply_kick(self, window, kicks):
        if len(kicks):                                              # none without a fluid
            order = numpy.argsort(kicks['id'])[numpy.searchsorted(numpy.sort(kicks['id']), self.grains['id'])]
            for field in ('velocity', 'angular_velocity'):
                self.grains[field] = kicks[field][order]
        self.grains['orientation'] = turned(self.grains['orientation'], window.step * self.grains['angular_velocity'])
        free = self.grains['position'][:, :self.axes] + window.step * self.grains['velocity'][:, :self.axes]
        self.grains['position'][:, :self.axes] = numpy.where(self.touched[:, None], self.moved, free)
        return turbidite.Motion(self.grains, max_penetration=self.overlap, contacts=int(self.touched.sum()),
                                iterations=self.substeps)

    def save(self):                                                 # all that a window passes to the next one
        return self.grains.tobytes()

    def restore(self, state):
        self.grains = numpy.frombuffer(state, turbidite.GRAIN).copy()


turbidite.run_grains(Springs(), sys.argv[-1])
