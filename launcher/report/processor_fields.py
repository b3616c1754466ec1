# SPDX-License-Identifier: LGPL-2.1-or-later
"""Fields of a fluid case that several ranks wrote: fluid/processor0, fluid/processor1, ... A run that went on with another
number of ranks has fields of both: those of one rank in fluid/, those of several in fluid/processorN, and, of earlier numbers of
them, in fluid/until-SET/processorN.

Every rank writes the values of its own cells; cellProcAddressing, which decomposePar writes beside its mesh, maps
them to cells of the whole mesh.
"""
import re
from pathlib import Path

import numpy as np


def processor_folders(fluid):
    """The folders fluid/processorN in the order of N; empty for a case on one rank."""
    found = [p for p in Path(fluid).glob('processor*') if re.fullmatch(r'processor\d+', p.name)]
    return sorted(found, key=lambda p: int(p.name[len('processor'):]))


def time_parents(fluid):
    """The folders whose subfolders are times, the present number of ranks first: the first processor folder, the case
    itself, and the first processor folders of earlier numbers of ranks, the latest first."""
    earlier = sorted(Path(fluid).glob('until-*'), key=lambda path: path.name, reverse=True)
    own, *others = (processor_folders(folder) for folder in [Path(fluid), *earlier])
    return own[:1] + [Path(fluid)] + [folder for folders in others for folder in folders[:1]]


def whole_field(time_folder, count, read_part):
    """Values (count, ...) of all cells at the time of `time_folder`, which is a folder of the case or of its first
    processor. `read_part(folder, n)` reads the n values of one folder; n is None if unknown."""
    if not re.fullmatch(r'processor\d+', time_folder.parent.name):
        return read_part(time_folder, count)
    whole = None
    seen = np.zeros(count, dtype=int)
    for processor in processor_folders(time_folder.parent.parent):
        cells = read_labels((processor / 'constant/polyMesh/cellProcAddressing').read_bytes())
        if len(cells) and (cells.min() < 0 or cells.max() >= count):
            raise ValueError(f'{processor.name} has cells that the case does not have')
        part = read_part(processor / time_folder.name, len(cells))
        if len(part) != len(cells):
            raise ValueError(f'{processor.name}/{time_folder.name} has {len(part)} values for '
                             f'{len(cells)} cells')
        if whole is None:
            whole = np.zeros((count,) + part.shape[1:])
        whole[cells] = part
        seen[cells] += 1
    if not np.all(seen == 1):
        raise ValueError('the processor folders do not hold every cell once')
    return whole


def read_labels(data):
    """A labelList file of OpenFOAM, ascii or binary (32-bit labels)."""
    uniform = re.search(rb'\n(\d+)\s*\{(-?\d+)\}', data)
    if uniform:
        return np.full(int(uniform.group(1)), int(uniform.group(2)))
    head = re.search(rb'\n(\d+)\s*\(', data)
    if not head:
        raise ValueError('cellProcAddressing holds no list of labels')
    n, start = int(head.group(1)), head.end()
    if re.search(rb'format\s+binary', data[:head.start()]):
        if len(data) < start + 4 * n:
            raise ValueError('cellProcAddressing is cut off')
        return np.frombuffer(data, dtype='<i4', count=n, offset=start)
    return np.array(data[start:data.index(b')', start)].split(), dtype=int)
