# SPDX-License-Identifier: LGPL-2.1-or-later
"""The free surface of a heap: its highest point in each column of width D. Grains whose motion is prescribed are ground, not
heap."""
import itertools

import numpy as np

import curves
import grain_files
from space import free_surface


def surface(run, grains):
    """(centres of the columns, heights), both in D; 0 where there is no free grain. In space the mean over the depth."""
    grains = grains.free()
    if run.in_space():
        return free_surface.over_length(run, grains)
    diameter = run.scale('D')
    centres, radii = grains.centres / diameter, grains.radii / diameter
    columns = int(np.ceil(run.size()[0]))
    heights = np.zeros(columns)
    for i, shift in itertools.product(range(len(radii)), images(run)):
        corners, centre = (grains.outlines or {}).get(i), centres[i] + shift
        first, last = int(np.floor(centre[0] - radii[i])), int(np.floor(centre[0] + radii[i]))
        for column in range(max(first, 0), min(last, columns - 1) + 1):
            top = top_of_disc(centre, radii[i], column) if corners is None else top_of_polygon(
                corners / diameter + shift, column)
            heights[column] = max(heights[column], top)
    return np.arange(columns) + 0.5, heights


def images(run):
    """Shifts of a grain to itself and its images beyond cyclic sides [D]."""
    length = run.size()[0]
    return [(x, 0.0) for x in ((0.0, length, -length) if run.case.get('domain.left') == 'cyclic' else (0.0,))]


def top_of_disc(centre, radius, column):
    """Highest point with column <= x <= column + 1; 0 if the disc does not reach it."""
    nearest = min(max(centre[0], column), column + 1.0) - centre[0]
    return centre[1] + np.sqrt(radius**2 - nearest**2) if abs(nearest) < radius else 0.0


def top_of_polygon(corners, column):
    """The same for a polygon: a corner in the column, or a point where an edge enters or leaves it."""
    inside = (corners[:, 0] >= column) & (corners[:, 0] <= column + 1.0)
    tops = [0.0, *corners[inside, 1]]
    for (x1, y1), (x2, y2) in zip(corners, np.roll(corners, -1, axis=0)):
        tops += [y1 + (y2 - y1) * (x - x1) / (x2 - x1) for x in (column, column + 1.0)
                 if min(x1, x2) < x < max(x1, x2)]
    return max(tops)


def ends_along_x(run, grains):
    """(left, right) ends of the free grains, or of the outlines of polygons [D]."""
    grains = grains.free()
    diameter = run.scale('D')
    left, right = (grains.centres[:, 0] - grains.radii) / diameter, (grains.centres[:, 0] + grains.radii) / diameter
    for i, corners in (grains.outlines or {}).items():
        left[i], right[i] = corners[:, 0].min() / diameter, corners[:, 0].max() / diameter
    return left, right


def trimmed(x, *heights):
    """Removes the empty columns beyond the last one with grains in the first of `heights`."""
    reach = np.flatnonzero(heights[0])
    end = reach[-1] + 2 if len(reach) else 1
    return (x[:end], *(height[:end] for height in heights))


def decorate(axes):
    curves.decorate(axes, 'Surface', r'$y\,/\,D$')
    axes.set_xlabel(r'$x\,/\,D$')
    axes.set_xlim(left=0.0)
    axes.set_ylim(bottom=0.0)
    axes.legend(fontsize=8)


def last_grains(run):
    """Grains of the last readable output; None, and a remark, if there is none."""
    for time, path in reversed(grain_files.grain_series(run)):
        try:
            return grain_files.read_grains(time, path)
        except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
            run.remarks.append(f'{path.name} cannot be read: {error}')
    return None


def final_surface(run):
    """(time [t_c], columns, heights) at the end; None without grains or domain."""
    if 'domain.size' not in run.case or not (run.folder / 'grains/grains.pvd').exists():
        return None
    grains = last_grains(run)
    return None if grains is None else (grains.time / run.scale('t_c'), *surface(run, grains))
