# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of the fluid's slices, and of the box program's fields: VTK RectilinearGrids and their series (.pvd)."""
import re

import numpy as np

import grain_files


def entries(run, index):
    """(time, part, path) of every file of a series that is there; empty without the series."""
    if not index.exists():
        return []
    found = [(float(entry.get('timestep')), int(entry.get('part')), index.parent / entry.get('file'))
             for entry in grain_files.series_entries(run, index)]
    return [entry for entry in found if entry[2].exists()]


def names(path):
    """Of the arrays in a file, `x`, `y`, `z` among them; ValueError if the file is damaged."""
    with path.open('rb') as file:
        return list(_offsets(path, file)[0])


def arrays(path, wanted=None):
    """{name: all its numbers}, edges of the cells along `x`, `y`, `z` among them; only those of `wanted` if it is given.
    They are float32 as raw appended data; ValueError if the file is damaged."""
    with path.open('rb') as file:
        offsets, begin = _offsets(path, file)
        return {name: _numbers(path, file, begin + offset) for name, offset in offsets.items()
                if wanted is None or name in wanted}


def _offsets(path, file):
    """{name: place of an array behind the beginning of the data}, and that beginning."""
    mark, head = b'<AppendedData encoding="raw">\n_', b''
    while mark not in head:
        more = file.read(1 << 16)
        if not more:
            raise ValueError(f'{path.name} has no appended data')
        head += more
    head = head[:head.index(mark)]
    found = re.findall(rb'<DataArray[^>]*Name="(\w+)"[^>]*offset="(\d+)"', head)
    return {name.decode(): int(offset) for name, offset in found}, len(head) + len(mark)


def _numbers(path, file, place):
    """Of an array: its length in bytes, and as many bytes."""
    file.seek(place)
    length = file.read(8)
    size = int.from_bytes(length, 'little')
    data = file.read(size)
    if len(length) < 8 or len(data) < size:
        raise ValueError(f'{path.name} is cut off')
    return np.frombuffer(data, dtype='<f4', count=size // 4).astype(float)
