# SPDX-License-Identifier: LGPL-2.1-or-later
"""The free surface of a heap: its highest point in each column of one D."""
import numpy as np

import run_data


def surface(run, grains):
    """(middles of the columns, heights), both in D; 0 where there is no grain."""
    diameter = run.scale('D')
    centres, radii = grains.centres / diameter, grains.radii / diameter
    columns = int(np.ceil(run.size()[0]))
    heights = np.zeros(columns)
    for (x, y), radius in zip(centres, radii):
        first, last = int(np.floor(x - radius)), int(np.floor(x + radius))
        for column in range(max(first, 0), min(last, columns - 1) + 1):
            nearest = min(max(x, column), column + 1.0) - x
            if abs(nearest) < radius:
                top = y + np.sqrt(radius**2 - nearest**2)
                heights[column] = max(heights[column], top)
    return np.arange(columns) + 0.5, heights


def last_grains(run):
    """Grains of the last instant that can be read; None, and a remark, when there is none."""
    for time, path in reversed(run_data.grain_series(run)):
        try:
            return run_data.read_grains(time, path)
        except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
            run.remarks.append(f'{path.name} cannot be read: {error}')
    return None


def final_surface(run):
    """(time [t_c], columns, heights) at the end; None without grains or domain."""
    if 'domain.size' not in run.case or not (run.folder / 'grains/grains.pvd').exists():
        return None
    grains = last_grains(run)
    return None if grains is None else (grains.time / run.scale('t_c'), *surface(run, grains))
