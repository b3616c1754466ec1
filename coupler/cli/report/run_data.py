# SPDX-License-Identifier: LGPL-2.1-or-later
"""What a run folder holds, read for the report: case and run record, history, grains, fluid velocity.

Everything is returned in the run's own units (see run.json: D, u_c, t_c). What is missing is None, and
`RunData.remarks` says so in words.
"""
import csv
import json
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import processor_fields


@dataclass
class Grains:
    """Discs at one time: centres (n, 2), radii (n,)."""

    time: float
    centres: np.ndarray
    radii: np.ndarray


@dataclass
class VelocityField:
    """Cell-centred velocity of a one-layer block, arrays of shape (rows, columns)."""

    time: float
    horizontal: np.ndarray
    vertical: np.ndarray


@dataclass
class RunData:
    folder: Path
    record: dict = field(default_factory=dict)
    case: dict = field(default_factory=dict)
    history: dict = None
    remarks: list = field(default_factory=list)

    def scale(self, name):
        """D, u_c or t_c; 1 when run.json does not tell (non-physical cases)."""
        return float(self.record.get(name) or 1.0)

    def size(self):
        """Width and height of the domain [D]."""
        return [float(v) for v in self.case['domain.size'].strip('[]').split(',')]


def load_run(folder):
    run = RunData(Path(folder))
    run.record = _optional(run, 'run.json', _read_json) or {}
    run.case = _optional(run, 'case.yaml', read_resolved_case) or {}
    run.history = _optional(run, 'history.csv', read_history)
    if run.history is not None and len(run.history['time']) == 0:
        run.history = None
        run.remarks.append('history.csv has no row yet: no curves.')
    return run


def _optional(run, name, read):
    path = run.folder / name
    if not path.exists():
        run.remarks.append(f'{name} is missing.')
        return None
    try:
        return read(path)
    except (ValueError, KeyError, OSError, ElementTree.ParseError) as error:
        run.remarks.append(f'{name} cannot be read: {error}')
        return None


def _read_json(path):
    return json.loads(path.read_text())


def read_resolved_case(path):
    """The flat keys of a resolved case, which is two levels of plain `key: value` lines."""
    case, group = {}, ''
    for line in path.read_text().splitlines():
        text = line.split('  #')[0].rstrip()
        if not text or text.startswith('#'):
            continue
        key, _, value = text.strip().partition(':')
        if not line.startswith(' ') and not value.strip():
            group = key + '.'
        else:
            name = (group if line.startswith(' ') else '') + key
            case[name] = value.strip().strip('"')
    return case


def read_history(path):
    """Columns by name; empty cells become nan."""
    with open(path, newline='') as file:
        table = csv.DictReader(file)
        names, rows = table.fieldnames or [], list(table)
    if 'time' not in names:
        raise ValueError('it has no column "time"')
    number = lambda text: float(text) if text not in (None, '') else np.nan
    return {name: np.array([number(row[name]) for row in rows]) for name in names}


# --- grains ---------------------------------------------------------------------------------------

def grain_series(run):
    """(time, path) of every instant of grains/grains.pvd."""
    index = run.folder / 'grains' / 'grains.pvd'
    if not index.exists():
        run.remarks.append('grains/grains.pvd is missing: pictures have no grains.')
        return []
    return [(float(entry.get('timestep')), index.parent / entry.get('file'))
            for entry in ElementTree.parse(index).iter('DataSet')]


def read_grains(time, path):
    """Centres and radii of a VTK PolyData file with ascii arrays."""
    piece = ElementTree.parse(path).find('.//Piece')
    points = _array(piece.find('Points/DataArray')).reshape(-1, 3)
    radii = [a for a in piece.iter('DataArray') if a.get('Name') == 'radius']
    if not radii:
        raise ValueError(f'{path.name} has no array "radius"')
    return Grains(time, points[:, :2], _array(radii[0]))


def _array(element):
    if element.get('format') != 'ascii':
        raise ValueError(f'array format {element.get("format")} is not ascii')
    return np.array((element.text or '').split(), dtype=float)


# --- fluid ----------------------------------------------------------------------------------------

def field_times(run):
    """(time, folder) of every instant with a velocity field, in order."""
    fluid = run.folder / 'fluid'
    if run.case.get('fluid.enabled') == 'false':
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


def mesh_cells(run):
    """Columns and rows of the one block: domain size in D times cells per diameter."""
    per_diameter = float(run.case['fluid.cells_per_diameter'])
    return tuple(int(round(length * per_diameter)) for length in run.size())


def read_velocity(time, folder, cells):
    """Reads `U` of a single block, x running fastest, as OpenFOAM writes it: ascii or binary."""
    columns, rows = cells
    values = processor_fields.whole_field(
        folder, columns * rows, lambda part, n: read_vectors(_contents(part / 'U'), n))
    if len(values) != columns * rows:
        raise ValueError(f'{folder.name}/U has {len(values)} cells, the case {columns} x {rows}')
    grid = values.reshape(rows, columns, 3)
    return VelocityField(time, grid[:, :, 0], grid[:, :, 1])


def _contents(path):
    if path.exists():
        return path.read_bytes()
    import gzip
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
