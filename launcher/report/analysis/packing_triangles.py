# SPDX-License-Identifier: LGPL-2.1-or-later
"""The packing as Delaunay triangles of the grains' centres, as for `pore_volume` of history.csv: only triangles with a
circumradius of at most D, or of the mean diameter of their grains if that is larger, belong to it.

In each triangle the velocity of the grains is taken as linear, so that its gradient is constant: deformation is
measured without any choice of a length, and added up afterwards over the cells of a coarse grid.
"""
from dataclasses import dataclass

import matplotlib.tri
import numpy as np

LARGEST_CIRCUMRADIUS = 1.0  # D


@dataclass
class Triangles:
    corners: np.ndarray    # (n, 3) indices of grains
    middles: np.ndarray    # (n, 2) [D]
    areas: np.ndarray      # (n,) [D^2]
    solid: np.ndarray      # (n,) of the areas; each grain's share is its angle over 2 pi
    gradients: np.ndarray  # (n, 2, 2) d u_i / d x_j [u_c/D]

    def pores(self):
        return self.areas - self.solid

    def dilatancy(self):
        """d u/dx + d v/dy [1/t_c]: relative growth of the area per time."""
        return self.gradients[:, 0, 0] + self.gradients[:, 1, 1]

    def shear_rate(self):
        """Difference of the principal rates of strain [1/t_c]: |du/dy| in simple shear."""
        d = self.gradients
        return np.hypot(d[:, 0, 0] - d[:, 1, 1], d[:, 0, 1] + d[:, 1, 0])


def triangles(snapshot, limit=LARGEST_CIRCUMRADIUS):
    """Of a snapshots.Snapshot; None for fewer than three grains, or if all stand in one line."""
    points = snapshot.centres
    if len(points) < 3 or np.ptp(points, axis=0).min() < 1e-9:
        return None
    try:
        corners = matplotlib.tri.Triangulation(*points.T).triangles
    except RuntimeError:  # an oblique line
        return None
    places = points[corners]  # (n, 3, 2)
    sides = np.roll(places, -1, axis=1) - places
    lengths = np.hypot(sides[..., 0], sides[..., 1])
    areas = 0.5 * np.abs(sides[:, 0, 0] * sides[:, 1, 1] - sides[:, 0, 1] * sides[:, 1, 0])
    with np.errstate(divide='ignore'):
        kept = lengths.prod(axis=1) / (4.0 * areas) <= widest(snapshot.areas[corners], limit) * (1.0 + 1e-9)
    corners, places, sides, areas = corners[kept], places[kept], sides[kept], areas[kept]
    solid = (angles(sides) / (2.0 * np.pi) * snapshot.areas[corners]).sum(axis=1)
    return Triangles(corners, places.mean(axis=1), areas, solid, gradients(places, snapshot.velocities[corners]))


def widest(areas, limit):
    """Circumradius up to which a triangle belongs to the packing [D]; areas (n, 3) of its grains. `limit`: over D, or over
    their mean diameter if that is larger."""
    return limit * np.maximum(1.0, 2.0 * np.sqrt(areas.mean(axis=1) / np.pi))


def angles(sides):
    """(n, 3) inner angles [rad]; sides (n, 3, 2) from corner to corner."""
    back = -np.roll(sides, 1, axis=1)
    dot = (sides * back).sum(axis=2)
    cross = sides[..., 0] * back[..., 1] - sides[..., 1] * back[..., 0]
    return np.arctan2(np.abs(cross), dot)


def gradients(places, velocities):
    """(n, 2, 2) of the linear functions that take these values (n, 3, 2) at these places (n, 3, 2)."""
    edges = places[:, 1:] - places[:, :1]        # (n, 2, 2): edge, coordinate
    changes = velocities[:, 1:] - velocities[:, :1]  # (n, 2, 2): edge, component
    # Cramer's rule: numpy's solve may wake threads for each of thousands of such small systems.
    (a, b), (c, d) = edges.transpose(1, 2, 0)
    inverse = np.array([[d, -b], [-c, a]]).transpose(2, 0, 1) / (a * d - b * c)[:, None, None]
    return (inverse @ changes).transpose(0, 2, 1)
