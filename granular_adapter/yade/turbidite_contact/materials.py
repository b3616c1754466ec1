# SPDX-License-Identifier: GPL-3.0-or-later
"""Coulomb friction from YADE's materials: mu = tan(frictionAngle), and the smaller of both in a contact."""
import math

from .refusal import refuse


class Materials:
    """Numbers the friction coefficients."""

    def __init__(self):
        self.frictions = []  # mu by number
        self._shared = {}  # id of a shared material -> number
        self._numbers = {}  # mu -> number

    def number(self, body):
        """The number of a body's coefficient; refuses a material without a valid friction angle."""
        material = body.mat
        if material is None:
            refuse(body, 'has no material', 'give it a FrictMat')
        if material.id >= 0 and material.id in self._shared:
            return self._shared[material.id]
        number = self._number_of(self._coefficient(body, material))
        if material.id >= 0:
            self._shared[material.id] = number
        return number

    def _coefficient(self, body, material):
        angle = getattr(material, 'frictionAngle', None)
        if angle is None:
            refuse(body, f'has a {type(material).__name__} without frictionAngle', 'use a FrictMat')
        if not 0 <= angle < 0.5 * math.pi:
            refuse(body, f'has frictionAngle = {angle}', 'it must lie in [0, pi/2)')
        return math.tan(angle)

    def _number_of(self, mu):
        if mu not in self._numbers:
            self._numbers[mu] = len(self.frictions)
            self.frictions.append(mu)
        return self._numbers[mu]
