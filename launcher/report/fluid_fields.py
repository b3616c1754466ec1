# SPDX-License-Identifier: LGPL-2.1-or-later
"""The fluid's velocity in a run folder: the times at which it was written, and the field at one of them as 2-D
arrays. Only this file depends on how OpenFOAM stores it (format, folders)."""
import gzip
import re
from dataclasses import dataclass

import numpy as np

import processor_fields


@dataclass
class VelocityField:
    """Cell-centred velocity of a one-layer block, arrays of shape (rows, columns)."""

    time: float
    horizontal: np.ndarray
    vertical: np.ndarray


def field_times(run):
    """(time, folder) of every output with a velocity field, in order."""
    fluid = run.folder / 'fluid'
    if not run.is_wet():
        return []
    found = []
    for entry in processor_fields.time_parent(fluid).iterdir() if fluid.exists() else []:
        try:
            time = float(entry.name)
        except ValueError:
            continue
        if (entry / 'U').exists() or (entry / 'U.gz').exists():
            found.append((time, entry))
    if not found:
        run.remarks.append('fluid/ holds no velocity field: pictures show grains only.')
    return sorted(found)


def velocity_at(run, time, folder):
    """The field of one (time, folder) of `field_times`; ValueError if it is damaged."""
    columns, rows = mesh_cells(run)
    values = processor_fields.whole_field(
        folder, columns * rows, lambda part, n: read_vectors(_contents(part / 'U'), n))
    if len(values) != columns * rows:
        raise ValueError(f'{folder.name}/U has {len(values)} cells, the case {columns} x {rows}')
    grid = values.reshape(rows, columns, 3)  # x runs fastest
    return VelocityField(time, grid[:, :, 0], grid[:, :, 1])


def mesh_cells(run):
    """Columns and rows of the one block: domain size in D times cells per diameter."""
    per_diameter = float(run.case['fluid.cells_per_diameter'])
    return tuple(int(round(length * per_diameter)) for length in run.size())


def _contents(path):
    if path.exists():
        return path.read_bytes()
    return gzip.decompress(path.with_suffix('.gz').read_bytes())


def read_vectors(data, count):
    """The internal field of an OpenFOAM vector field, (n, 3)."""
    uniform = re.search(rb'internalField\s+uniform\s+\(([^)]*)\)', data)
    if uniform:
        return np.tile(np.array(uniform.group(1).split(), dtype=float), (count, 1))
    head = re.search(rb'internalField\s+nonuniform\s+List<vector>\s+(\d+)\s*\(', data)
    if not head:
        raise ValueError('U has no internal field of vectors')
    n, start = int(head.group(1)), head.end()
    if re.search(rb'format\s+binary', data[:head.start()]):
        if len(data) < start + 24 * n:
            raise ValueError('U is cut off')
        return np.frombuffer(data, dtype='<f8', count=3 * n, offset=start).reshape(n, 3)
    end = data.index(b'\n)', start)
    numbers = data[start:end].replace(b'(', b' ').replace(b')', b' ').split()
    return np.array(numbers, dtype=float).reshape(n, 3)
