# SPDX-License-Identifier: LGPL-2.1-or-later
"""Parallel projection of space on a picture: x to the right, y upwards, seen from the side of large z.

With the azimuth a about the vertical and the elevation e above the horizontal,

    towards the viewer  v = (sin a cos e, sin e, cos a cos e)
    to the right        r = (cos a, 0, -sin a)
    upwards             u = v x r

a point x is seen at (r . x, u . x), and hides what has a smaller v . x.
"""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Camera:
    """Angles in degrees."""

    azimuth: float
    elevation: float

    def axes(self):
        """(3, 3): the rows r, u, v."""
        a, e = np.radians([self.azimuth, self.elevation])
        towards = np.array([np.sin(a) * np.cos(e), np.sin(e), np.cos(a) * np.cos(e)])
        right = np.array([np.cos(a), 0.0, -np.sin(a)])
        return np.array([right, np.cross(towards, right), towards])

    def seen(self, points):
        """(..., 3) of points (..., 3): to the right, upwards, towards the viewer."""
        return np.asarray(points, dtype=float) @ self.axes().T


OBLIQUE = Camera(azimuth=28.0, elevation=22.0)
SIDE = Camera(azimuth=0.0, elevation=0.0)
