# SPDX-License-Identifier: LGPL-2.1-or-later
"""Grains and contacts of a run folder as arrays."""
import numpy as np

from . import units
from .errors import NotThere
from .readers import reader
from .series import Points, Series, Trajectories

INTEGERS = ('id', 'shape', 'material', 'prescribed', 'id_a', 'id_b', 'feature', 'status')
TOPOLOGY = ('connectivity', 'offsets')     # of the VTK file, no data
VECTORS = ('position', 'velocity', 'force', 'contact_force', 'normal', 'point')
SPINS = ('angular_velocity', 'torque')     # in the plane their z component


def grains(data):
    """Trajectories; NotThere without any output."""
    entries, files = entries_of(data, 'grains'), reader('grain_files')

    def read(number):
        time, path = entries[number]
        arrays = files.read_shaped(path)
        there = files.grains_of(time, path, arrays)
        found = scaled({'position': arrays.pop('Points'), **arrays}, units.of_grains(data, there), data.in_space())
        return Points(units.in_t_c(data, time), found, outlines_of(data, there))
    return Trajectories('grains', [units.in_t_c(data, time) for time, _ in entries], read)


def contacts(data):
    """Series; NotThere for programs that do not tell their contacts."""
    entries, files = entries_of(data, 'contacts'), reader('grain_files')
    grain_entries = dict(files.quiet_series(data))
    dimension = 3 if data.in_space() else 2

    def read(number):
        time, path = entries[number]
        there = files.read_grains(time, grain_entries[time]) if time in grain_entries else None
        arrays, of = files.read_shaped(path), units.of_contacts(data, there)
        ends = arrays.pop('Points').reshape(-1, 2, 3)[..., :dimension] / of['ends']
        return Points(units.in_t_c(data, time), {**scaled(arrays, of, data.in_space()), 'ends': ends})
    return Series('contacts', [units.in_t_c(data, time) for time, _ in entries], read)


def entries_of(data, name):
    index = data.folder / 'grains' / f'{name}.pvd'
    if not index.exists():
        raise NotThere(f'{data.folder} has no {name}: {index} is missing')
    entries = reader('grain_files').series(data, index)
    if not entries:
        raise NotThere(f'{data.folder} has no {name}: {index} holds no whole entry. A run at work may be writing it: try again')
    return entries


def scaled(arrays, of, in_space):
    """Arrays (n,), vectors (n, 2) or (n, 3), quaternions (n, 4), divided by their units."""
    found = {}
    for name, values in arrays.items():
        if name in TOPOLOGY:
            continue
        if name in INTEGERS:
            found[name] = values.astype(np.int64)
        else:
            found[name] = in_plane(name, values, in_space) / of.get(name, 1.0)
    return found


def in_plane(name, values, in_space):
    if in_space or values.ndim == 1:
        return values
    if name in SPINS:
        return values[:, 2]
    return values[:, :2] if name in VECTORS else values


def outlines_of(data, grains):
    """{id: corners (k, 2) [D]}"""
    return {int(grains.ids[k]): corners / data.scale('D') for k, corners in (grains.outlines or {}).items()}
