# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fluid's fields in a run folder: the times at which they were written, and in the plane a field at one of them as
2-D arrays; in space they are only summed up, and slices.py has what is drawn. Only this file depends on how OpenFOAM and the box
program store it (format, folders)."""
import gzip
import re
from dataclasses import dataclass

import numpy as np

import processor_fields
from space import rectilinear


@dataclass
class VelocityField:
    """Cell-centred velocity of a one-layer block, arrays of shape (rows, columns). Rows are equally high: of a mesh
    with stretched rows, each is given as often as rows of the others' height fit into it."""

    time: float
    horizontal: np.ndarray
    vertical: np.ndarray


def field_times(run):
    """(time, folder) of every output with a velocity field, in order; of the box program (time, file)."""
    fluid = run.folder / 'fluid'
    if not run.is_wet():
        return []
    if run.record.get('fluid_program') == 'box':
        return [(time, path) for time, _, path in rectilinear.entries(run, fluid / 'fields' / 'fields.pvd')]
    found = {}
    for parent in processor_fields.time_parents(fluid) if fluid.exists() else []:
        for entry in parent.iterdir():
            try:
                time = float(entry.name)
            except ValueError:
                continue
            if (entry / 'U').exists() or (entry / 'U.gz').exists():
                found.setdefault(time, entry)
    if not found:
        run.remarks.append('fluid/ holds no velocity field: pictures show grains only.')
    return sorted(found.items())


def velocity_at(run, time, folder):
    """The field of one (time, folder) of `field_times`; ValueError if it is damaged."""
    grid = _field(run, folder, 'U', read_vectors)
    return VelocityField(time, grid[:, :, 0], grid[:, :, 1])


def pressure_at(run, time, folder):
    """p/rho_f of one (time, folder) of `field_times`, (rows, columns); ValueError if it is missing or damaged."""
    if not ((folder / 'p').exists() or (folder / 'p.gz').exists()):
        raise ValueError(f'{folder.name} has no pressure')
    return _field(run, folder, 'p', read_scalars)


def field_names(folder):
    """Names of the scalar and vector fields in a folder of `field_times`, in order."""
    if _of_box(folder):
        return sorted(set(rectilinear.names(folder)) - set('xyz'))
    named = {path.name.removesuffix('.gz') for path in folder.iterdir() if path.is_file()}
    return sorted(name for name in named if _class_of(folder, name) in READERS)


def cell_values(run, folder, name):
    """A field of one (time, folder) of `field_times` as it is in the files: (depth, rows, columns), vectors (..., 3);
    depth is 1 in the plane. ValueError if it is damaged."""
    if _of_box(folder):
        return _cells_of_box(rectilinear.arrays(folder, {*'xyz', name}), name)
    return _cells(run, folder, name, READERS[_class_of(folder, name)])


def mean_square_velocity(run, time, folder):
    """Mean of |u|^2 over the volume of the box, in the plane over its area; ValueError if the field is damaged."""
    if not run.in_space():
        velocity = velocity_at(run, time, folder)
        return float((velocity.vertical**2 + velocity.horizontal**2).mean())
    if _of_box(folder):
        return _mean_square_of_box(folder)
    of_rows = (_cells(run, folder, 'U', read_vectors)**2).sum(axis=-1).mean(axis=(0, 2))
    heights = np.diff(row_edges(run)) if is_stretched(run) else None
    return float(np.average(of_rows, weights=heights))


def _mean_square_of_box(path):
    arrays = rectilinear.arrays(path, {*'xyz', 'U'})
    of_rows = (_cells_of_box(arrays, 'U')**2).sum(axis=-1).mean(axis=(0, 2))
    return float(np.average(of_rows, weights=np.diff(arrays['y'])))


def _of_box(path):
    """Whether this is a file of the box program, not a folder of OpenFOAM's."""
    return path.suffix == '.vtr'


def _cells_of_box(arrays, name):
    """As cell_values, of the arrays of a file; ValueError if their numbers do not fit the mesh."""
    shape = tuple(len(arrays[axis]) - 1 for axis in 'zyx')
    components, rest = divmod(len(arrays[name]), int(np.prod(shape)))
    if rest or components not in (1, 3):
        raise ValueError(f'{name} has {len(arrays[name])} values for {" x ".join(map(str, shape[::-1]))} cells')
    return arrays[name].reshape(*shape, *([3] if components == 3 else []))


def _field(run, folder, name, read):
    """(rows, columns, ...) with equally high rows, in the plane."""
    grid = _cells(run, folder, name, read)[0]
    return grid[rows_at_equal_heights(row_edges(run))] if is_stretched(run) else grid


def _cells(run, folder, name, read):
    """(depth, rows, columns, ...) of all cells; x runs fastest, then y."""
    shape = mesh_cells(run)[::-1]
    values = processor_fields.whole_field(
        folder, int(np.prod(shape)), lambda part, n: read(_contents(part / name), n))
    if len(values) != np.prod(shape):
        told = ' x '.join(str(count) for count in mesh_cells(run) if count > 1)
        raise ValueError(f'{folder.name}/{name} has {len(values)} cells, the case {told}')
    return values.reshape(*shape, *values.shape[1:])


def mesh_cells(run):
    """Columns, rows and layers along z (1 in the plane) of the one block: domain size in D times cells per diameter,
    unless rows are stretched."""
    columns, rows, depth = _equal_cells(run)
    return columns, len(row_edges(run)) - 1 if is_stretched(run) else rows, depth


def _equal_cells(run):
    """As many as there are if no row is stretched."""
    per_diameter = float(run.case['fluid.cells_per_diameter'])
    columns, rows = (int(round(length * per_diameter)) for length in run.size())
    return columns, rows, int(round(run.depth() * per_diameter)) if run.in_space() else 1


def is_stretched(run):
    """Whether rows of the mesh have different heights."""
    return float(run.case.get('fluid.stretch_ratio', 1)) > 1


def row_edges(run):
    """Heights at which rows of the mesh begin and end, from the points of its left side, of the box program from the
    first of its fields; ValueError if the mesh is damaged or there are no fields."""
    if run.record.get('fluid_program') == 'box':
        files = [path for _, path in field_times(run)]
        if not files:
            raise ValueError('fluid/fields holds no fields, and with them no mesh')
        return rectilinear.arrays(files[0], {'y'})['y']
    columns, _, depth = _equal_cells(run)
    points = read_points(_contents(run.folder / 'fluid/constant/polyMesh/points'))
    edges = points[:len(points) // (depth + 1):columns + 1, 1]  # x runs fastest, then y
    if len(edges) < 2 or (np.diff(edges) <= 0).any():
        raise ValueError('fluid/constant/polyMesh/points does not hold rows of cells')
    return edges


def rows_at_equal_heights(edges):
    """Index of the row at the middle of each of the equal rows of the first one's height."""
    count = int(round((edges[-1] - edges[0]) / (edges[1] - edges[0])))
    heights = edges[0] + (np.arange(count) + 0.5) * (edges[-1] - edges[0]) / count
    return np.searchsorted(edges, heights) - 1


def _class_of(folder, name):
    """OpenFOAM's name of a file's type; empty without one."""
    found = re.search(rb'\bclass\s+(\w+)\s*;', _beginning(folder / name))
    return found.group(1).decode() if found else ''


def _beginning(path):
    """With the head of a file, whose fields may have gigabytes."""
    plain = path.exists()
    with open(path, 'rb') if plain else gzip.open(path.with_suffix('.gz')) as file:
        return file.read(2000)


def _contents(path):
    if path.exists():
        return path.read_bytes()
    return gzip.decompress(path.with_suffix('.gz').read_bytes())


def read_points(data):
    """The points of an OpenFOAM mesh, (n, 3)."""
    head = re.search(rb'\n(\d+)\s*\(', data)
    if not head:
        raise ValueError('the mesh has no list of points')
    return _vectors(data, int(head.group(1)), head, 'the list of points')


def read_vectors(data, count):
    """The internal field of an OpenFOAM vector field, (n, 3)."""
    uniform = re.search(rb'internalField\s+uniform\s+\(([^)]*)\)', data)
    if uniform:
        return np.tile(np.array(uniform.group(1).split(), dtype=float), (count, 1))
    head = re.search(rb'internalField\s+nonuniform\s+List<vector>\s+(\d+)\s*\(', data)
    if not head:
        raise ValueError('U has no internal field of vectors')
    return _vectors(data, int(head.group(1)), head, 'U')


def read_scalars(data, count):
    """The internal field of an OpenFOAM scalar field, (n,)."""
    uniform = re.search(rb'internalField\s+uniform\s+([-+.\deE]+)\s*;', data)
    if uniform:
        return np.full(count, float(uniform.group(1)))
    head = re.search(rb'internalField\s+nonuniform\s+List<scalar>\s+(\d+)\s*\(', data)
    if not head:
        raise ValueError('p has no internal field of scalars')
    n, start = int(head.group(1)), head.end()
    if re.search(rb'format\s+binary', data[:head.start()]):
        if len(data) < start + 8 * n:
            raise ValueError('p is cut off')
        return np.frombuffer(data, dtype='<f8', count=n, offset=start)
    return np.array(data[start:data.index(b')', start)].split(), dtype=float)


def _vectors(data, n, head, name):
    """The n vectors that follow `head`, the match of their beginning; binary or as text."""
    start = head.end()
    if re.search(rb'format\s+binary', data[:head.start()]):
        if len(data) < start + 24 * n:
            raise ValueError(f'{name} is cut off')
        return np.frombuffer(data, dtype='<f8', count=3 * n, offset=start).reshape(n, 3)
    end = data.index(b'\n)', start)
    numbers = data[start:end].replace(b'(', b' ').replace(b')', b' ').split()
    return np.array(numbers, dtype=float).reshape(n, 3)


READERS = {'volVectorField': read_vectors, 'volScalarField': read_scalars}  # by OpenFOAM's class
