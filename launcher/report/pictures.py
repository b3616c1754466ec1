# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of a run at a few times from the start until the grains are at rest: with a fluid its vertical velocity in
colour (red up, blue down, white at rest) and the grains, otherwise the grains coloured by their speed."""
from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import MaxNLocator

import findings
import fluid_fields
import grain_drawing
import grain_files
import plates

MOST_PICTURES = 6
# Grains and fluid are matched if their times differ by less than this fraction of an output interval.
SAME_TIME = 0.01
FIGURE_WIDTH = 11.0    # inches
LARGEST_HEIGHT = 7.0   # of one picture
BAR_WIDTH = 1.5        # of a colour bar and the labels
LABEL_WIDTH = 0.5      # of the labels alone
# A few cells in a narrow gap can be much faster than the rest; this quantile sets the colour scale.
COLOURED_PART = 0.999
SPEED_COLOURS = 'viridis'
MARGIN, WET_MARGIN = 1.0, 3.0  # D beyond the grains
MOSTLY_EMPTY = 0.5  # of the domain: if the part with grains is smaller, the rest is not shown


@dataclass
class Picture:
    """One time, in the units of the run; grains or velocity may be None."""

    time: float
    grains: object
    velocity: object


def instants(run):
    """Up to six of all_instants, evenly spaced until the grains are at rest, or over the run if they are not."""
    every = all_instants(run)
    if not every:
        return []
    return [every[i] for i in _chosen([time for time, _, _ in every], findings.rest_time(run), run.scale('t_c'))]


def all_instants(run):
    """(time, grains file or None, field folder or None) of every output with grains; with a fluid in the plane, whose
    velocity is in the picture, of those outputs of its fields that have grains: a run that was resumed, or ends later now,
    has fields out of turn."""
    grains, fields = grain_files.grain_series(run), fluid_fields.field_times(run)
    of_fields = run.is_wet() and not run.in_space() and len(fields) > 1
    leading = fields if of_fields else grains or fields
    if not leading:
        return []
    times = [time for time, _ in leading]
    tolerance = SAME_TIME * _interval(times)
    found = [(time, _at(time, grains, tolerance), _at(time, fields, tolerance)) for time in times]
    return [instant for instant in found if instant[1] is not None or not grains]


def _chosen(times, rest, time_scale):
    end = len(times) - 1
    if rest is not None:
        end = int(np.abs(np.array(times) - rest * time_scale).argmin())
    count = min(MOST_PICTURES, end + 1)
    return sorted({int(round(i)) for i in np.linspace(0, end, count)})


def _interval(times):
    return (times[-1] - times[0]) / (len(times) - 1) if len(times) > 1 else 1.0


def _at(time, series, tolerance):
    near = [path for t, path in series if abs(t - time) <= tolerance + 1e-6 * abs(time)]
    return near[0] if near else None


def load(run, instant):
    """Grains and field at one time; unreadable data are noted and left out."""
    time, grains_file, field_folder = instant
    picture = Picture(time, None, None)
    try:
        if grains_file is not None:
            picture.grains = grain_files.read_grains(time, grains_file)
        if field_folder is not None and not run.in_space():
            picture.velocity = fluid_fields.velocity_at(run, time, field_folder)
    except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
        run.remarks.append(f'Picture at {time:g}: {error}')
    return picture


def colour_limit(run, pictures):
    """Symmetric limit of the colours in u_c, for all pictures, at least 0.05 u_c."""
    seen = [np.quantile(np.abs(p.velocity.vertical), COLOURED_PART) / run.scale('u_c')
            for p in pictures if p.velocity is not None]
    return float(max([0.05] + seen))


def speed_limit(run, pictures):
    """Largest speed in colour [u_c]."""
    seen = [np.quantile(p.grains.speeds(), COLOURED_PART) / run.scale('u_c') for p in pictures
            if p.grains is not None and p.grains.velocities is not None and len(p.grains.radii)]
    return float(max([1e-3] + seen))


def view(run, all_grains):
    """Width and height of the drawing [D], from the lower left corner: the part of the domain that grains reach at these
    times; with a fluid, whose motion reaches farther, the whole domain unless most of it is empty."""
    if not run.is_wet():
        return reached(run, all_grains, MARGIN)
    part, whole = reached(run, all_grains, WET_MARGIN), run.size()
    return part if part[0] * part[1] < MOSTLY_EMPTY * whole[0] * whole[1] else tuple(whole)


def reached(run, all_grains, margin):
    """Width and height of the part of the domain up to the farthest grains and `margin` beyond [D]."""
    width, height = run.size()
    reaches = [grain_drawing.reach(run, grains) for grains in all_grains if grains is not None and len(grains.radii)]
    if not reaches:
        return width, height
    right, top = np.ceil(np.max(reaches, axis=0) + margin)
    return min(width, right), min(height, top)


def columns_for(count, aspect):
    """Number of pictures of height/width `aspect` side by side."""
    return min(count, 6 if aspect > 1.5 else 3 if aspect > 0.6 else 2)


def figure(run, pictures):
    """All pictures side by side with one colour scale."""
    size = view(run, [picture.grains for picture in pictures])
    result, axes = frame(size, len(pictures))
    wet = run.is_wet()
    limit = shown_limit(run, pictures)
    images = [_draw(run, picture, limit, size, place) for picture, place in zip(pictures, axes.flat)]
    _colour_bar(result, axes, [image for image in images if image is not None],
                r'vertical fluid velocity $/\,u_c$' if wet else r'speed of the grains $/\,u_c$',
                extend='both' if wet else 'max')
    return result


def panel_width(size):
    """Pixels that a single picture of this size [D] needs to be readable: tall ones stand beside each other on a
    telephone."""
    aspect = size[1] / size[0]
    return 180 if aspect > 1.5 else 280 if aspect > 0.6 else 400


def panel_axes(size, bar=False):
    """(figure, axes, axes of a colour bar or None) for one picture of this size [D], its text readable at panel_width
    pixels. Margins are fixed: finding them takes longer than the drawing."""
    inches = panel_width(size) / 75.0
    plot = inches - 0.5, min((inches - 0.5) * size[1] / size[0], 3.2 * inches)
    below = 0.85 if bar else 0.3
    total = plot[1] + below + 0.35
    result = plt.figure(figsize=(inches, total))
    axes = result.add_axes((0.35 / inches, below / total, plot[0] / inches, plot[1] / total))
    return result, axes, result.add_axes((0.35 / inches, 0.42 / total, plot[0] / inches, 0.12 / total)) if bar else None


def panels(run, shown, limit=None):
    """(figure, name) of each picture; `limit` of the colours if it is not that of these pictures."""
    limit, size = limit or shown_limit(run, shown), view(run, [picture.grains for picture in shown])
    return [(panel(run, picture, limit, size), f'sequence-{k}') for k, picture in enumerate(shown)]


def shows_fluid(run):
    """Whether pictures are coloured by the velocity of the fluid; else by the speed of the grains."""
    return run.is_wet() and not run.in_space()


def shown_limit(run, shown):
    """Of the colours, for all of these pictures [u_c]."""
    return colour_limit(run, shown) if shows_fluid(run) else speed_limit(run, shown)


def panel(run, picture, limit, size):
    """One of the pictures, with a colour bar below it."""
    wet = run.is_wet()
    result, axes, below = panel_axes(size, bar=True)
    result.set_label(in_words(run, picture))
    image = _draw(run, picture, limit, size, axes)
    if image is None:
        below.set_axis_off()
        return result
    label, extend = (r'fluid, $v\,/\,u_c$', 'both') if wet else (r'grains, $|u|\,/\,u_c$', 'max')
    bar_below(result, image, below, label, extend)
    return result


def in_words(run, picture):
    """What a picture shows, for those who do not see it."""
    words = grains_in_words(run, picture.grains, picture.time)
    if picture.velocity is not None:
        low, high = (extreme(picture.velocity.vertical) / run.scale('u_c') for extreme in (np.min, np.max))
        return f'{words}, over the vertical velocity of the fluid, from {low:.2g} to {high:.2g} u_c'
    speeds = None if picture.grains is None else picture.grains.speeds()
    if speeds is None or not len(speeds):
        return words
    return f'{words}, coloured by their speed, up to {speeds.max() / run.scale("u_c"):.2g} u_c'


def grains_in_words(run, grains, time):
    """How many there are, when, and how far up and to the right they reach."""
    when = f't = {time / run.scale("t_c"):.3g} t_c'
    if grains is None or not len(grains.radii):
        return f'No grains at {when}'
    right, top = grain_drawing.reach(run, grains)
    return f'{len(grains.radii)} grains at {when}, up to x = {right:.3g} D and y = {top:.3g} D'


def bar_below(figure, image, axes, label, extend):
    """The colour bar of a single picture, in axes of its own."""
    bar = figure.colorbar(image, cax=axes, orientation='horizontal', extend=extend)
    bar.set_label(label, fontsize=8)
    axes.tick_params(labelsize=7)
    bar.locator = MaxNLocator(4)
    bar.update_ticks()


def frame(size, count, beside=BAR_WIDTH):
    """A figure with axes for each of `count` pictures of this size [D]; `beside` inches are left for labels and a colour
    bar."""
    width, height = size
    columns = columns_for(count, height / width)
    rows = -(-count // columns)
    place_width = (FIGURE_WIDTH - BAR_WIDTH) / columns
    place_height = min(place_width * height / width, LARGEST_HEIGHT)
    drawn_width = columns * place_height * width / height
    result, axes = plt.subplots(rows, columns, squeeze=False, sharex=True, sharey=True,
                                layout='constrained',
                                figsize=(drawn_width + beside, rows * (place_height + 0.45) + 0.35))
    for unused in list(axes.flat)[count:]:
        unused.set_axis_off()
    for place in axes[:, 0]:
        place.set_ylabel(r'$y\,/\,D$', fontsize=8)
    for place in axes[-1, :]:
        place.set_xlabel(r'$x\,/\,D$', fontsize=8)
    return result, axes


def _colour_bar(result, axes, images, label, extend):
    if not images:
        return
    bar = result.colorbar(images[-1], ax=axes, shrink=0.8, aspect=30, pad=0.01, extend=extend)
    bar.set_label(label, fontsize=9)
    bar.ax.tick_params(labelsize=8)


def _draw(run, picture, limit, size, axes):
    """Returns the image for the colour bar, or None without one."""
    width, height = run.size()
    image = None
    if picture.velocity is not None:
        image = axes.imshow(picture.velocity.vertical / run.scale('u_c'), origin='lower',
                            cmap='RdBu_r', extent=(0, width, 0, height), vmin=-limit, vmax=limit,
                            interpolation='bilinear')
    if picture.grains is not None:
        grains = grain_drawing.with_images(run, picture.grains)
        speeds = None if run.is_wet() else grains.speeds()
        coloured = grain_drawing.draw(
            axes, grains, run.scale('D'), colours=SPEED_COLOURS, limits=(0.0, limit),
            values=None if speeds is None else speeds / run.scale('u_c'))
        image = image or coloured
    decorate(run, axes, size, picture.time)
    return image


def decorate(run, axes, size, time):
    plates.draw(axes, run, time / run.scale('t_c'))
    axes.set(xlim=(0, size[0]), ylim=(0, size[1]), aspect='equal')
    axes.set_title(rf'$t = {time / run.scale("t_c"):.3g}\,t_c$', fontsize=10)
    axes.tick_params(labelsize=7)
