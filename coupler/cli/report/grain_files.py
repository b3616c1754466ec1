# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grain series of a run folder: where it is and what one of its files holds."""
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np


@dataclass
class Grains:
    """At one time, in the run's own units; what a file does not tell is None."""

    time: float
    centres: np.ndarray           # (n, 2)
    radii: np.ndarray             # (n,) circumscribed
    ids: np.ndarray = None        # (n,)
    velocities: np.ndarray = None  # (n, 2)
    outlines: dict = None         # index of a polygon: its corners (k, 2)

    def speeds(self):
        return None if self.velocities is None else np.hypot(*self.velocities.T)


def grain_series(run):
    """(time, path) of every instant of grains/grains.pvd."""
    return series(run, 'grains.pvd', 'pictures have no grains')


def series(run, name, consequence):
    """(time, path) of every instant of grains/`name`; a missing one is remarked if that has a
    consequence."""
    index = run.folder / 'grains' / name
    if not index.exists():
        if consequence:
            run.remarks.append(f'grains/{name} is missing: {consequence}.')
        return []
    return [(float(entry.get('timestep')), index.parent / entry.get('file'))
            for entry in ElementTree.parse(index).iter('DataSet')]


def read_grains(time, path, shapes=()):
    """Grains of a VTK PolyData file with ascii arrays. `shapes` is the shape table of run.json."""
    arrays = read_arrays(path)
    if 'radius' not in arrays:
        raise ValueError(f'{path.name} has no array "radius"')
    grains = Grains(time, arrays['Points'].reshape(-1, 3)[:, :2], arrays['radius'])
    if 'id' in arrays:
        grains.ids = arrays['id'].astype(np.int64)
    if 'velocity' in arrays:
        grains.velocities = arrays['velocity'].reshape(-1, 3)[:, :2]
    grains.outlines = outlines(grains, arrays, shapes)
    return grains


def outlines(grains, arrays, shapes):
    """Corners of the polygons: the shape's, in units of R, turned by the angle and moved to the centre."""
    corners = [corners_of(shape) for shape in shapes]
    if not any(corner is not None for corner in corners):
        return None
    kinds = arrays.get('shape', np.zeros(len(grains.radii))).astype(int)
    turns = angles(arrays, len(grains.radii))
    found = {}
    for i, kind in enumerate(kinds):
        if corners[kind] is None:
            continue
        c, s = np.cos(turns[i]), np.sin(turns[i])
        found[i] = grains.centres[i] + grains.radii[i] * corners[kind] @ np.array([[c, s], [-s, c]])
    return found


def corners_of(shape):
    """(k, 2) of a record {kind, vertices: [x, y, ...]}; None for round ones."""
    vertices = shape.get('vertices') or []
    return np.array(vertices, dtype=float).reshape(-1, 2) if vertices else None


def angles(arrays, count):
    """About z [rad], from the unit quaternions (w, x, y, z)."""
    if 'orientation' not in arrays:
        return np.zeros(count)
    q = arrays['orientation'].reshape(-1, 4)
    return 2.0 * np.arctan2(q[:, 3], q[:, 0])


def read_arrays(path):
    """Every array of a one-piece PolyData file by name, flat; those of points as `Points`."""
    piece = ElementTree.parse(path).find('.//Piece')
    arrays = {'Points': _array(piece.find('Points/DataArray'))}
    for group in ('PointData', 'CellData', 'Lines', 'Verts'):
        for element in piece.iterfind(f'{group}/DataArray'):
            arrays[element.get('Name')] = _array(element)
    return arrays


def _array(element):
    if element.get('format') != 'ascii':
        raise ValueError(f'array format {element.get("format")} is not ascii')
    return np.array((element.text or '').split(), dtype=float)
