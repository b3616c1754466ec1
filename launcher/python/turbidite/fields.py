# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of the fluid as arrays with coordinates: of the whole box, of any number of ranks, and of the planes of
`output.slices`."""
import numpy as np

from . import units
from .errors import NotThere
from .readers import reader
from .series import Output, Series


class Field(Output):
    """Cell values of the fluid, arrays by name. Of the box in the plane (rows, columns), vectors (rows, columns, 2); in
    space (layers, rows, columns), vectors (..., 3); of a slice (rows, columns), vectors (..., 3).

    x, y, z: centres of the columns, rows and layers [D]; of a slice, its place along the axis it is normal to; z is None
    in the plane.
    """

    def __init__(self, time, arrays, x, y, z=None):
        super().__init__(time, arrays)
        self.x, self.y, self.z = x, y, z

    def __repr__(self):
        return f'<Field at {self.time:g} t_c: {", ".join(self)}>'


class Lazy(dict):
    """Arrays that are read when they are asked for."""

    def __init__(self, names, read):
        super().__init__(dict.fromkeys(names))
        self._read = read

    def __getitem__(self, name):
        if super().__getitem__(name) is None:
            self[name] = self._read(name)
        return super().__getitem__(name)

    def items(self):
        return [(name, self[name]) for name in self]


def require_fluid(data):
    if not data.is_wet():
        raise NotThere(f'{data.folder} is a run without fluid (fluid.enabled: false): it has no fields')


def fields(data):
    """Series of Field; NotThere without a fluid or any output of it."""
    require_fluid(data)
    files, of = reader('fluid_fields'), units.of_fields(data)
    entries = files.field_times(data)
    if not entries:
        raise NotThere(f'{data.folder}/fluid holds no fields so far')

    def read(number):
        time, folder = entries[number]
        arrays = Lazy(files.field_names(folder), lambda name: flat(files.cell_values(data, folder, name)) / of.get(name, 1.0))
        return Field(units.in_t_c(data, time), arrays, *centres(data))

    def flat(values):
        if data.in_space():
            return values
        return values[0, ..., :2] if values.ndim == 4 else values[0]
    return Series('fields', [units.in_t_c(data, time) for time, _ in entries], read)


def centres(data):
    """x, y, z of the cells [D]; z is None in the plane."""
    files = reader('fluid_fields')
    columns, rows, layers = files.mesh_cells(data)
    x, y, z = (middles(np.linspace(0.0, length, count + 1)) for length, count in
               zip((*data.size(), data.depth() if data.in_space() else 1.0), (columns, rows, layers)))
    if files.is_stretched(data):
        y = middles(files.row_edges(data) / data.scale('D'))
    return x, y, z if data.in_space() else None


def middles(edges):
    return 0.5 * (edges[1:] + edges[:-1])


def slices(data):
    """[Series of Field, ...] of the planes, in the order of `output.slices`; NotThere without any."""
    require_fluid(data)
    files = reader('space.slice_files')
    planes = files.series(data)
    if not planes:
        raise NotThere(f'{data.folder} has no slices: cases in space write those of output.slices')
    return [plane_series(data, entries) for entries in planes]


def plane_series(data, entries):
    files, of = reader('space.slice_files'), units.of_fields(data)

    def read(number):
        one = files.read(*entries[number])
        at = {one.axis: one.place / data.scale('D'), one.across: middles(one.edges[0]) / data.scale('D'),
              one.up: middles(one.edges[1]) / data.scale('D')}
        arrays = {'U': one.velocity / of['U'], 'p': one.pressure / of['p'], 'covered': one.covered}
        return Field(units.in_t_c(data, one.time), arrays, at[0], at[1], at[2])
    return Series('slices', [units.in_t_c(data, time) for time, _ in entries], read)
