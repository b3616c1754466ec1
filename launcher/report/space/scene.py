# SPDX-License-Identifier: LGPL-2.1-or-later
"""What all pictures of spheres share: the part of the box that is shown, the camera, and the drawing of one time.

Lengths are in D. A picture shows the floor of the box with marks every 10 D along its lower edges, and behind the
grains the edges of the part of the box that they reach.
"""
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap

from space import ball_image, walls
from space.camera import Camera

PIXELS = 680.0        # along the longer side of a picture, as wide as a page shows it
FINER = 2             # pixels are computed so many times finer, and averaged
MARGIN = 0.8          # D around what is seen
TICKS = 10.0          # D
TICK_LENGTH = 0.6
EDGE = '#8a8a8a'
DARKEST = 0.2         # of a colour map that is used
PLAIN = (0.80, 0.78, 0.73)  # of grains without a value
INCHES = 5.6          # width of a single picture, its text readable at 420 pixels


@dataclass
class Frame:
    """The box that pictures of one run show, seen by one camera."""

    camera: Camera
    box: np.ndarray     # (3,) length, height, depth from the corner (0, 0, 0)
    extent: tuple       # left, right, bottom, top of the picture

    @property
    def aspect(self):
        left, right, bottom, top = self.extent
        return (top - bottom) / (right - left)

    @property
    def pixels_per_length(self):
        left, right, bottom, top = self.extent
        return PIXELS / max(right - left, top - bottom)


def frame(run, all_grains, camera):
    """Around everything that the grains reach at these times and the walls at the start, inside the box; the whole
    depth of the box is shown."""
    box = np.array([*run.size(), run.depth()])
    reach = [((one.positions() + one.radii[:, None]) / run.scale('D')).max(axis=0) for one in all_grains
             if one is not None and len(one.radii)]
    inner = walls.extent(run)
    if inner is not None:
        reach.append(inner[1])
    if reach:
        box[:2] = np.minimum(box[:2], np.ceil(np.max(reach, axis=0)[:2] + 1.0))
    seen = camera.seen(corners(box))
    low, high = seen.min(axis=0) - MARGIN, seen.max(axis=0) + MARGIN
    return Frame(camera, box, (low[0], high[0], low[1], high[1]))


def corners(box):
    """(8, 3)"""
    return np.array([[x, y, z] for x in (0.0, box[0]) for y in (0.0, box[1]) for z in (0.0, box[2])])


def colour_map(name):
    """Without its darkest part, in which shaded spheres would be black."""
    return ListedColormap(plt.get_cmap(name)(np.linspace(DARKEST, 1.0, 256)))


def colours_of(values, limit, name):
    """(n, 3) of values between 0 and `limit` in a colour_map; plain without values."""
    if values is None:
        return None
    return colour_map(name)(np.clip(values / limit, 0.0, 1.0))[:, :3]


def image_of(shown, run, grains, colours):
    """(rows, columns, 4) of the grains at one time, rows from the bottom."""
    diameter = run.scale('D')
    radii = grains.radii / diameter
    if colours is None:
        colours = np.tile(PLAIN, (len(radii), 1))
    pixels = FINER * shown.pixels_per_length
    found = ball_image.surfaces(shown.camera.seen(grains.positions() / diameter), radii, shown.extent, pixels)
    typical = float(np.median(radii)) * pixels if len(radii) else 1.0
    return ball_image.halved(ball_image.shaded(found, colours, typical))


def axes_for(shown, bar=False):
    """(figure, axes, axes of a colour bar or None) for one picture."""
    below, above = (0.62 if bar else 0.12), 0.32
    height = INCHES * shown.aspect
    result = plt.figure(figsize=(INCHES, height + below + above))
    total = height + below + above
    axes = result.add_axes((0.0, below / total, 1.0, height / total))
    axes.set(xlim=shown.extent[:2], ylim=shown.extent[2:], aspect='equal')
    axes.set_axis_off()
    return result, axes, result.add_axes((0.25, 0.4 / total, 0.5, 0.1 / total)) if bar else None


def draw_box(axes, shown):
    """Edges of the shown part of the box behind the grains, and marks along the floor."""
    length, height, depth = shown.box
    floor = [(0, 0, 0), (length, 0, 0), (length, 0, depth), (0, 0, depth), (0, 0, 0)]
    upright = [[(0, 0, 0), (0, height, 0)], [(length, 0, 0), (length, height, 0)], [(0, 0, depth), (0, height, depth)],
               [(0, height, depth), (0, height, 0), (length, height, 0)]]
    lines = [shown.camera.seen(line)[:, :2] for line in (floor, *upright)]
    axes.add_collection(LineCollection(lines, colors=EDGE, linewidths=0.6, zorder=0))
    marks = [[(x, 0, depth), (x, 0, depth + TICK_LENGTH)] for x in np.arange(0.0, length + 1e-9, TICKS)]
    axes.add_collection(LineCollection([shown.camera.seen(mark)[:, :2] for mark in marks], colors=EDGE,
                                       linewidths=0.6, zorder=0))


def title(run, time):
    return rf'$t = {time / run.scale("t_c"):.3g}\,t_c$'
