# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a run: vertical fluid velocity in colour (red up, blue down, white at rest) with the grains
on it, at a few instants from the start to the end."""
import numpy as np
from matplotlib.collections import EllipseCollection

import run_data

MOST_PICTURES = 6
# Farther apart than this part of an output interval, grains and fluid do not belong together.
SAME_TIME = 0.01


def instants(run):
    """Up to six (time, grains file or None, field folder or None), evenly over the run."""
    grains, fields = run_data.grain_series(run), run_data.field_times(run)
    leading = grains or fields
    if not leading:
        return []
    times = [time for time, _ in leading]
    count = min(MOST_PICTURES, len(times))
    chosen = sorted({int(round(i)) for i in np.linspace(0, len(times) - 1, count)})
    tolerance = SAME_TIME * _interval(times)
    return [(times[i], _at(times[i], grains, tolerance), _at(times[i], fields, tolerance))
            for i in chosen]


def _interval(times):
    return (times[-1] - times[0]) / (len(times) - 1) if len(times) > 1 else 1.0


def _at(time, series, tolerance):
    near = [path for t, path in series if abs(t - time) <= tolerance + 1e-6 * abs(time)]
    return near[0] if near else None


def load(run, instant):
    """Grains and field of an instant; what cannot be read is remarked and left out."""
    time, grains_file, field_folder = instant
    grains = velocity = None
    try:
        if grains_file is not None:
            grains = run_data.read_grains(time, grains_file)
        if field_folder is not None:
            velocity = run_data.read_velocity(time, field_folder, run_data.mesh_cells(run))
    except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
        run.remarks.append(f'Picture at {time:g}: {error}')
    return grains, velocity


def colour_limit(run, fields):
    """Symmetric limit of the colours in u_c: the largest speed seen, at least 0.05 u_c."""
    seen = [np.abs(f.vertical).max() / run.scale('u_c') for f in fields if f is not None]
    return max([0.05] + seen)


def draw(run, time, grains, velocity, limit, axes):
    """Returns the image for the colour bar, or None without a field."""
    width, height = run.size()
    image = None
    if velocity is not None:
        image = axes.imshow(velocity.vertical / run.scale('u_c'), origin='lower', cmap='RdBu_r',
                            extent=(0, width, 0, height), vmin=-limit, vmax=limit,
                            interpolation='bilinear')
    if grains is not None:
        _draw_grains(run, grains, axes)
    axes.set(xlim=(0, width), ylim=(0, height), aspect='equal')
    axes.set_title(f't = {time / run.scale("t_c"):.3g} t_c', fontsize=9)
    axes.tick_params(labelsize=7)
    return image


def _draw_grains(run, grains, axes):
    diameter = run.scale('D')
    sizes = 2.0 * grains.radii / diameter
    axes.add_collection(EllipseCollection(
        sizes, sizes, np.zeros_like(sizes), units='xy', offsets=grains.centres / diameter,
        transOffset=axes.transData, facecolors='#d9d4c7', edgecolors='#3a3a3a', linewidths=0.4))
