# SPDX-License-Identifier: LGPL-2.1-or-later
"""Discs with springs and dashpots, in sub-steps, as a grains adapter: grains.command: /usr/bin/python3 springs.py

Frictionless; the same model as springs.cpp. docs/write-an-adapter.md explains every line."""
import sys

import numpy
import turbidite_adapter as turbidite


class Springs:
    name, version, host_code, native_substeps = 'springs-py', '1.0', 'numpy', True

    def initialise(self, settings, shapes, grains):
        sides = (settings.text('domain.' + side) for side in ('left', 'right', 'bottom', 'top'))
        if any(side != 'wall' for side in sides) or grains['prescribed'].any():
            raise ValueError('springs.py supports free grains between four walls only')
        if settings.real('contact.friction') > 0:
            raise ValueError('springs.py knows no friction: contact.friction')
        if settings.integer('grains.ranks') > 1:                    # contacts with grains of other ranks are not found
            raise ValueError('springs.py runs on one rank only: grains.ranks')
        self.grains, self.size = grains, (settings.real('run.size_x'), settings.real('run.size_y'))
        self.gravity, self.substeps = settings.real('run.gravity'), settings.integer('run.md_substeps')
        self.omega, self.damping = settings.real('run.md_frequency'), settings.real('run.md_damping')
        wet = settings.flag('fluid.enabled')
        fluid = settings.real('run.fluid_density') if wet else 0.0
        share = settings.real('fluid.hydrodynamic_radius')**2 if wet else 1.0
        area = numpy.pi * grains['radius']**2
        self.mass = area * (grains['density'] - share * fluid)      # the inertia of step 4, cM
        self.weight = area * (grains['density'] - fluid) * self.gravity
        return turbidite.Motion(grains)

    def push(self, force, overlap, closing, normal, reduced_mass):
        """Adds spring and dashpot along `normal` (n, 2); returns the force."""
        value = numpy.maximum(0.0, reduced_mass * self.omega * (self.omega * overlap + 2 * self.damping * closing))
        return numpy.where(overlap > 0, value, 0.0)[:, None] * normal

    def contact_forces(self, x, v):
        r, m, force = self.grains['radius'], self.mass, numpy.zeros_like(x)
        i, j = numpy.triu_indices(len(x), 1)                        # all pairs: an example
        apart = x[j] - x[i]
        distance = numpy.hypot(*apart.T)
        normal, overlap = apart / distance[:, None], r[i] + r[j] - distance
        closing = numpy.einsum('ij,ij->i', v[i] - v[j], normal)
        f = self.push(force, overlap, closing, normal, m[i] * m[j] / (m[i] + m[j]))
        numpy.add.at(force, j, f)
        numpy.add.at(force, i, -f)
        self.overlap = max(0.0, overlap.max(initial=0.0))
        for axis, sign, place in ((0, 1, 0), (0, -1, self.size[0]), (1, 1, 0), (1, -1, self.size[1])):
            wall = numpy.zeros((len(x), 2))
            wall[:, axis] = sign
            overlap = r - sign * (x[:, axis] - place)
            force += self.push(force, overlap, -sign * v[:, axis], wall, m)
            self.overlap = max(self.overlap, overlap.max())
        return force

    def advance(self, window, responses):
        x, v = self.grains['position'][:, :2].copy(), self.grains['velocity'][:, :2].copy()
        impulse, dt = numpy.zeros_like(x), window.step / self.substeps
        for _ in range(self.substeps):
            force = self.contact_forces(x, v)
            impulse += dt * force
            v += dt * (force - numpy.outer(self.weight, (0, 1))) / self.mass[:, None]
            x += dt * v
        self.moved, self.touched = x, numpy.any(impulse != 0, axis=1)
        self.grains['velocity'][:, :2], self.grains['contact_impulse'][:, :2] = v, impulse
        return turbidite.Motion(self.grains, contacts=int(self.touched.sum()), iterations=self.substeps)

    def apply_kick(self, window, kicks):
        if len(kicks):                                              # none without a fluid
            order = numpy.argsort(kicks['id'])[numpy.searchsorted(numpy.sort(kicks['id']), self.grains['id'])]
            for field in ('velocity', 'angular_velocity'):
                self.grains[field] = kicks[field][order]
        q, half = self.grains['orientation'], 0.5 * window.step * self.grains['angular_velocity'][:, 2]
        w, z = q[:, 0].copy(), q[:, 3].copy()                       # turns about z
        q[:, 0], q[:, 3] = numpy.cos(half) * w - numpy.sin(half) * z, numpy.cos(half) * z + numpy.sin(half) * w
        free = self.grains['position'][:, :2] + window.step * self.grains['velocity'][:, :2]
        self.grains['position'][:, :2] = numpy.where(self.touched[:, None], self.moved, free)
        return turbidite.Motion(self.grains, max_penetration=self.overlap, contacts=int(self.touched.sum()),
                                iterations=self.substeps)

    def save(self):                                                 # all that a window passes to the next one
        return self.grains.tobytes()

    def restore(self, state):
        self.grains = numpy.frombuffer(state, turbidite.GRAIN).copy()


turbidite.run_grains(Springs(), sys.argv[-1])
