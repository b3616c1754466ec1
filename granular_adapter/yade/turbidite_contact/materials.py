# SPDX-License-Identifier: GPL-3.0-or-later
"""Coulomb friction of YADE's materials: mu = tan(frictionAngle), the smaller of the two in a contact."""
import math

from .refusal import refuse


class Materials:
    """Remembers the materials it was asked about, to notice that a script changes an angle."""

    def __init__(self):
        self.known = []  # (material, its angle), each material once
        self.shared = {}  # id of a shared material -> mu
        self.values = {}  # mu -> a body that has it

    def friction(self, body):
        """mu of a body's material; refuses a material without a proper friction angle."""
        material = body.mat
        if material is None:
            refuse(body, 'has no material', 'give it a FrictMat')
        if material.id >= 0 and material.id in self.shared:
            return self.shared[material.id]
        angle = getattr(material, 'frictionAngle', None)
        if angle is None:
            refuse(body, f'has a {type(material).__name__} without frictionAngle', 'use a FrictMat')
        if not 0 <= angle < 0.5 * math.pi:
            refuse(body, f'has frictionAngle = {angle}', 'it must lie in [0, pi/2)')
        self.known.append((material, angle))
        mu = math.tan(angle)
        if material.id >= 0:
            self.shared[material.id] = mu
        self.values.setdefault(mu, body.id)
        return mu

    def changed(self):
        return any(material.frictionAngle != angle for material, angle in self.known)
