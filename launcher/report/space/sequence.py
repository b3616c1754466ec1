# SPDX-License-Identifier: LGPL-2.1-or-later
"""The grains of a run in space at a few times: seen obliquely, and from the side, coloured by their speed."""
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize

import pictures
from analysis.snapshots import evenly
from space import scene, walls
from space.camera import OBLIQUE, SIDE

PANEL_WIDTH = 420  # pixels that a picture needs
SIDE_VIEWS = 3


def panels(run, shown):
    """(figure, name) of each picture; from the side at the start, in the middle and at the end."""
    there = [picture for picture in shown if picture.grains is not None]
    if not there:
        return []
    limit = pictures.speed_limit(run, there)
    views = [(OBLIQUE, 'sequence', there), (SIDE, 'side', [there[i] for i in evenly(len(there), SIDE_VIEWS)])]
    found = []
    for camera, name, some in views:
        frame = scene.frame(run, [picture.grains for picture in there], camera)
        found += [(panel(run, frame, picture.grains, limit), f'{name}-{k}') for k, picture in enumerate(some)]
    return found


def panel(run, frame, grains, limit):
    """One picture with its colour bar; `limit`: speed of the last colour [u_c]."""
    result, axes, below = scene.axes_for(frame, bar=True)
    result.set_label(('From the side: ' if frame.camera is SIDE else 'Obliquely from above: ')
                     + pictures.in_words(run, pictures.Picture(grains.time, grains, None)))
    scene.draw_box(axes, frame)
    walls.draw(axes, run, frame, grains.time / run.scale('t_c'))
    speeds = grains.speeds()
    colours = scene.colours_of(None if speeds is None else speeds / run.scale('u_c'), limit, pictures.SPEED_COLOURS)
    axes.imshow(scene.image_of(frame, run, grains, colours), origin='lower', extent=frame.extent, zorder=1,
                interpolation='antialiased')
    axes.set_title(scene.title(run, grains.time), fontsize=10)
    scale = ScalarMappable(Normalize(0.0, limit), scene.colour_map(pictures.SPEED_COLOURS))
    pictures.bar_below(result, scale, below, r'speed of the grains, $|u|\,/\,u_c$', 'max')
    return result


def caption(run, shown):
    """What is shown of the box; the rest is that of the plane (captions.sequence)."""
    length, height, depth = scene.frame(run, [picture.grains for picture in shown], OBLIQUE).box
    return (f'Obliquely from above, and from the side (the last pictures). Shown are {length:g} × {height:g} × '
            f'{depth:g} D of the box, marks on the floor every {scene.TICKS:g} D. Grains that lie deeper than those '
            'around them are darker.')
