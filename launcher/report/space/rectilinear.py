# SPDX-License-Identifier: LGPL-2.1-or-later
"""Files of the fluid's slices, and of the box program's fields: VTK RectilinearGrids and their series (.pvd)."""
import re
import xml.etree.ElementTree as ElementTree

import numpy as np


def entries(index):
    """(time, part, path) of every file of a series that is there; empty without the series."""
    if not index.exists():
        return []
    found = [(float(entry.get('timestep')), int(entry.get('part')), index.parent / entry.get('file'))
             for entry in ElementTree.parse(index).iter('DataSet')]
    return [entry for entry in found if entry[2].exists()]


def arrays(path):
    """{name: all its numbers}, edges of the cells along `x`, `y`, `z` among them: float32 as raw appended data;
    ValueError if the file is damaged."""
    head, mark, data = path.read_bytes().partition(b'<AppendedData encoding="raw">\n_')
    if not mark:
        raise ValueError(f'{path.name} has no appended data')
    found = {}
    for name, offset in re.findall(rb'<DataArray[^>]*Name="(\w+)"[^>]*offset="(\d+)"', head):
        start = int(offset)
        size = int.from_bytes(data[start:start + 8], 'little')
        if len(data) < start + 8 + size:
            raise ValueError(f'{path.name} is cut off')
        found[name.decode()] = np.frombuffer(data, dtype='<f4', count=size // 4, offset=start + 8).astype(float)
    return found
