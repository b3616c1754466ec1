# SPDX-License-Identifier: LGPL-2.1-or-later
"""The series in a run's grains folder, the content of a file of grains, and the walls inside the box."""
import csv
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, fields, replace

import numpy as np

from analysis.once import once_per_run, or_remark


@dataclass
class Grains:
    """The grains at one time, in the units of the run; values missing in the file are None."""

    time: float
    centres: np.ndarray            # (n, 2)
    radii: np.ndarray              # (n,) circumscribed
    ids: np.ndarray = None         # (n,)
    velocities: np.ndarray = None  # (n, 2)
    outlines: dict = None          # index of a polygon: its corners (k, 2)
    forces: np.ndarray = None      # (n, 2) of the fluid, buoyancy apart
    contact_forces: np.ndarray = None  # (n, 2) mean of the window
    densities: np.ndarray = None   # (n,)
    prescribed: np.ndarray = None  # (n,) bool
    z: np.ndarray = None           # (n,) of the centres; 0 in the plane
    velocity_z: np.ndarray = None  # (n,)
    spins: np.ndarray = None       # (n, 3) angular velocities

    def speeds(self):
        if self.velocities is None:
            return None
        in_plane = np.hypot(*self.velocities.T)
        return in_plane if self.velocity_z is None else np.hypot(in_plane, self.velocity_z)

    def free(self):
        """Those whose motion is not prescribed."""
        if self.prescribed is None or not self.prescribed.any():
            return self
        kept = np.flatnonzero(~self.prescribed)
        arrays = {one.name: getattr(self, one.name) for one in fields(self)}
        kept_arrays = {name: values[kept] for name, values in arrays.items() if isinstance(values, np.ndarray)}
        outlines = None if self.outlines is None else {
            new: self.outlines[old] for new, old in enumerate(kept) if old in self.outlines}
        return replace(self, **kept_arrays, outlines=outlines)

    def positions(self):
        """(n, 3) centres."""
        return np.column_stack([self.centres, np.zeros(len(self.radii)) if self.z is None else self.z])


def walls_of(run):
    """The rows of grains/walls.csv; none if there are no walls."""
    path = run.folder / 'grains' / 'walls.csv'
    if not path.exists():
        return []
    with open(path, newline='') as file:
        return list(csv.DictReader(file))


def has_moving_walls(run):
    rates = ('vx', 'vy', 'vz', 'spin', 'wx', 'wy', 'wz')
    return any(wall.get('motion') or any(float(wall.get(rate) or 0.0) for rate in rates) for wall in walls_of(run))


def grain_series(run):
    """(time, path) of every output in grains/grains.pvd; outlines of polygons are in files beside them."""
    index = run.folder / 'grains' / 'grains.pvd'
    if not index.exists():
        run.remarks.append('grains/grains.pvd is missing: pictures have no grains.')
        return []
    return series(run, index)


def quiet_series(run):
    """The same without a remark when there is none."""
    return grain_series(run) if (run.folder / 'grains' / 'grains.pvd').exists() else []


@once_per_run
def first_grains(run):
    """The grains of the first output; None without one, and a remark where it cannot be read."""
    first = quiet_series(run)[:1]
    return or_remark(run, 'The first output', lambda: read_grains(*first[0])) if first else None


@once_per_run
def last_grains(run):
    """The same of the last output."""
    last = quiet_series(run)[-1:]
    return or_remark(run, 'The last output', lambda: read_grains(*last[0])) if last else None


def grains_at(run, time):
    """The grains of the output at a time of another series; None without one."""
    near = [output for output in quiet_series(run) if abs(output[0] - time) <= 1e-6 * abs(time)]
    return read_grains(*near[0]) if near else None


def series(run, index):
    """(time, path) of the first part of every output."""
    return [(float(entry.get('timestep')), index.parent / entry.get('file'))
            for entry in series_entries(run, index) if entry.get('part', '0') == '0']


def series_entries(run, index):
    """The entries (`timestep`, `part`, `file`) of the index of a series (.pvd). A kill, a full disk or a run at work may have
    left it without its end: then those that are whole, and a remark."""
    found = []
    try:
        for _, element in ElementTree.iterparse(index):
            if element.tag == 'DataSet':
                found.append(element)
    except ElementTree.ParseError as error:
        remark = f'{index.relative_to(run.folder)} is cut off or damaged after {len(found)} whole entries: {error}'
        if remark not in run.remarks:
            run.remarks.append(remark)
    return found


def read_grains(time, path):
    """Grains of a VTK PolyData file, with the outlines from the file beside it if it exists."""
    return grains_of(time, path, read_arrays(path))


def grains_of(time, path, arrays):
    """The same of arrays that have been read."""
    if 'radius' not in arrays:
        raise ValueError(f'{path.name} has no array "radius"')
    grains = Grains(time, in_plane(arrays['Points']), arrays['radius'], z=across(arrays['Points']))
    if 'id' in arrays:
        grains.ids = arrays['id'].astype(np.int64)
    if 'velocity' in arrays:
        grains.velocities, grains.velocity_z = in_plane(arrays['velocity']), across(arrays['velocity'])
    if 'angular_velocity' in arrays:
        grains.spins = in_space(arrays['angular_velocity'])
    grains.densities = arrays.get('density')
    grains.prescribed = arrays['prescribed'] > 0 if 'prescribed' in arrays else None
    if 'force' in arrays:
        grains.forces = in_plane(arrays['force'])
    if 'contact_force' in arrays:
        grains.contact_forces = in_plane(arrays['contact_force'])
    corners = path.with_name(path.name.replace('grains_', 'outlines_', 1))
    if corners != path and corners.exists():
        grains.outlines = read_outlines(corners, grains.ids)
    return grains


def read_outlines(path, ids):
    """{index of the grain: its corners (k, 2)}"""
    arrays = read_arrays(path)
    points = in_plane(arrays['Points'])[arrays['connectivity'].astype(int)]
    corners = np.split(points, arrays['offsets'].astype(int)[:-1])
    index = {grain: i for i, grain in enumerate(ids)}
    return {index[grain]: outline for grain, outline in zip(arrays['id'].astype(np.int64), corners)}


def in_plane(triples):
    """(n, 2) of x, y, z in a row."""
    return triples.reshape(-1, 3)[:, :2]


def in_space(triples):
    """(n, 3) of x, y, z in a row."""
    return triples.reshape(-1, 3)


def across(triples):
    """(n,) the z of x, y, z in a row."""
    return triples.reshape(-1, 3)[:, 2]


def read_arrays(path):
    """Those of read_shaped, flat."""
    return {name: values.ravel() for name, values in read_shaped(path).items()}


def read_shaped(path):
    """Every array of a one-piece PolyData file by name, (n,) or (n, components), the positions as `Points`. Where points
    and cells share a name, it is that of the cells. ValueError unless the arrays are ascii."""
    piece = ElementTree.parse(path).find('.//Piece')
    arrays = {'Points': _array(piece.find('Points/DataArray'))}
    for group in ('Verts', 'Lines', 'Polys', 'PointData', 'CellData'):
        for element in piece.iterfind(f'{group}/DataArray'):
            arrays[element.get('Name')] = _array(element)
    return arrays


def _array(element):
    if element.get('format') != 'ascii':
        raise ValueError(f'array format {element.get("format")} is not ascii')
    values = np.array((element.text or '').split(), dtype=float)
    components = int(element.get('NumberOfComponents', 1))
    return values if components == 1 else values.reshape(-1, components)
