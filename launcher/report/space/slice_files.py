# SPDX-License-Identifier: LGPL-2.1-or-later
"""Planes of the fluid in space (output.slices): the files in fluid/slices. Apart from their pictures, since the Python
door reads them without what draws."""
from dataclasses import dataclass

import numpy as np

from space import rectilinear

AXES = 'xyz'


@dataclass
class Slice:
    """One plane at one time, in the units of the run. Arrays are (rows, columns) of a picture: `up` by `across`."""

    time: float
    axis: int               # that the plane is normal to
    place: float            # along it
    across: int             # axis to the right
    up: int                 # axis upwards
    edges: list             # of the cells, [across, up]
    pressure: np.ndarray    # over rho_f
    velocity: np.ndarray    # (rows, columns, 3)
    covered: np.ndarray     # share that spheres and walls cover

    def name(self, run):
        return f'{AXES[self.axis]} = {self.place / run.scale("D"):.4g} D'


def series(run):
    """[[(time, path), ...] of each plane], in the order of output.slices; empty without any."""
    planes = {}
    for time, part, path in rectilinear.entries(run, run.folder / 'fluid' / 'slices' / 'slices.pvd'):
        planes.setdefault(part, []).append((time, path))
    return [planes[part] for part in sorted(planes)]


def read(time, path):
    """A file of the fluid program (rectilinear.py); ValueError if it is damaged."""
    arrays = rectilinear.arrays(path)
    edges = [arrays[name] for name in AXES]
    axis = int(np.argmin([len(along) for along in edges]))
    across, up = [other for other in range(3) if other != axis]  # the first runs fastest
    shape = len(edges[up]) - 1, len(edges[across]) - 1
    pressure, covered = (arrays[name].reshape(shape) for name in ('p', 'covered'))
    velocity = arrays['U'].reshape(*shape, 3)
    if axis == 0:  # y upwards, z to the right
        across, up = up, across
        pressure, covered, velocity = pressure.T, covered.T, velocity.transpose(1, 0, 2)
    return Slice(time, axis, float(edges[axis][0]), across, up, [edges[across], edges[up]], pressure, velocity, covered)
