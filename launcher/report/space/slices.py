# SPDX-License-Identifier: LGPL-2.1-or-later
"""Pictures of planes of the fluid in space (slice_files.py): the vertical velocity in colour as in the plane (red up,
blue down, white at rest), the pressure, and the spheres where the plane cuts them."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

import grain_drawing
import grain_files
import pictures
from analysis.snapshots import evenly
from document.typeset import plain
from space import free_surface
from space.slice_files import AXES, read, series

PANEL_WIDTH = 420
MOST_TIMES = 6
PRESSURES = 2
INCHES = 5.6           # width of a picture, its text readable at 420 pixels
TALLEST = 7.0
MARGIN = 0.55          # of the labels
COLOURED_PART = pictures.COLOURED_PART
WALLS = ListedColormap(['#8a8a8a'])


def cut_grains(run, one, grains, larger=0.0):
    """The spheres, with radii larger by so much, as discs where the plane cuts them, with their images beyond cyclic
    sides."""
    positions, period = grains.positions(), periods(run)
    off = positions[:, one.axis] - one.place
    if period[one.axis]:
        off -= period[one.axis] * np.round(off / period[one.axis])
    radii = grains.radii + larger
    there = np.abs(off) < radii
    centres, cut = positions[there][:, [one.across, one.up]], np.sqrt(radii[there]**2 - off[there]**2)
    for k, axis in enumerate((one.across, one.up)):
        if period[axis]:
            centres, cut = free_surface.with_images_along(k, period[axis], centres, cut)
    return grain_files.Grains(grains.time, centres, cut)


def periods(run):
    """Of the three axes, in the unit of the run; 0 where sides are not cyclic."""
    lengths = np.array([*run.size(), run.depth()]) * run.scale('D')
    return [length if run.case.get(f'domain.{side}') == 'cyclic' else 0.0
            for length, side in zip(lengths, ('left', 'bottom', 'front'))]


def add(page, run):
    """A section of the report; nothing for runs without slices."""
    planes = series(run)
    if not planes:
        return
    wanted = [(0, i) for i in evenly(len(planes[0]), MOST_TIMES)]
    wanted += [(plane, len(planes[plane]) - 1) for plane in range(1, len(planes))]
    loaded = [load(run, *planes[plane][i]) for plane, i in wanted]
    shown = [one for one in loaded if one is not None]
    if not shown:
        return
    limit = velocity_limit(run, shown)
    figures = [(velocity_panel(run, one, grains, limit), f'slice-{k}') for k, (one, grains) in enumerate(shown)]
    of_first = [pair for pair in shown if (pair[0].axis, pair[0].place) == (shown[0][0].axis, shown[0][0].place)]
    chosen = [of_first[i] for i in evenly(len(of_first), PRESSURES)]
    highest = pressure_limit(run, chosen)
    figures += [(pressure_panel(run, one, grains, highest), f'slice-pressure-{k}')
                for k, (one, grains) in enumerate(chosen)]
    page.heading('Fluid in slices')
    page.panels(figures, caption(run, shown), PANEL_WIDTH)


def load(run, time, path):
    """(slice, grains or None); None if the file cannot be read, which is noted."""
    try:
        return read(time, path), grain_files.grains_at(run, time)
    except (ValueError, KeyError, OSError, AttributeError, SyntaxError) as error:
        run.remarks.append(f'Slice at {time:g}: {error}')
        return None


def velocity_limit(run, shown):
    """Symmetric limit of the colours [u_c]."""
    return float(max([0.05] + [quantile(np.abs(one.velocity[..., 1]), areas(one), COLOURED_PART) / run.scale('u_c')
                               for one, _ in shown]))


def areas(one):
    """Of the cells: rows may be stretched."""
    across, up = (np.diff(edges) for edges in one.edges)
    return up[:, None] * across


def quantile(values, weights, share):
    """What this share of the weight does not exceed; np.quantile where weights are equal."""
    order = np.argsort(values, axis=None)
    sorted_values, sorted_weights = values.ravel()[order], weights.ravel()[order]
    middles = np.cumsum(sorted_weights) - 0.5 * sorted_weights
    return float(np.interp(middles[0] + share * (middles[-1] - middles[0]), middles, sorted_values))


def level_free(one):
    """The pressure without its mean outside spheres: no side of the box need fix a level."""
    free = one.covered < 0.5
    return one.pressure - (np.average(one.pressure[free], weights=areas(one)[free]) if free.any() else 0.0)


def pressure_limit(run, shown):
    """Symmetric limit of the colours [rho_f u_c^2]."""
    free = [(one, one.covered < 0.5) for one, _ in shown]
    return float(max([1e-3] + [quantile(np.abs(level_free(one)[there]), areas(one)[there], 0.995) / run.scale('u_c')**2
                               for one, there in free if there.any()]))


def velocity_panel(run, one, grains, limit):
    return panel(run, one, grains, one.velocity[..., 1] / run.scale('u_c'), limit, 'RdBu_r', r'fluid, $v\,/\,u_c$')


def pressure_panel(run, one, grains, limit):
    return panel(run, one, grains, level_free(one) / run.scale('u_c')**2, limit, 'PuOr_r',
                 r'pressure, $p\,/\,\rho_f u_c^2$')


def panel(run, one, grains, values, limit, colours, label):
    """One picture with its colour bar."""
    diameter = run.scale('D')
    x, y = (edges / diameter for edges in one.edges)
    aspect = (y[-1] - y[0]) / (x[-1] - x[0])
    width = min(INCHES - 2 * MARGIN, TALLEST / aspect)
    below, above = 1.05, 0.35
    total = width * aspect + below + above
    figure = plt.figure(figsize=(INCHES, total), label=(
        f'Plane {one.name(run)} at t = {one.time / run.scale("t_c"):.3g} t_c: {plain(label)}, from {values.min():.2g} to '
        f'{values.max():.2g}'))
    left = 0.5 * (INCHES - width) / INCHES
    axes = figure.add_axes((left, below / total, width / INCHES, width * aspect / total))
    bar = figure.add_axes((0.25, 0.42 / total, 0.5, 0.12 / total))
    image = coloured(axes, x, y, values, cmap=colours, vmin=-limit, vmax=limit)
    walls = walls_share(run, one, grains)
    if walls is not None:
        coloured(axes, x, y, np.ones_like(walls), cmap=WALLS, vmin=0, vmax=1, alpha=walls)
    if grains is not None:
        grain_drawing.draw(axes, cut_grains(run, one, grains), diameter)
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]), aspect='equal')
    axes.set_xlabel(rf'${AXES[one.across]}\,/\,D$', fontsize=8, labelpad=1)
    axes.set_ylabel(rf'${AXES[one.up]}\,/\,D$', fontsize=8, labelpad=1)
    axes.set_title(rf'{one.name(run)}, $t = {one.time / run.scale("t_c"):.3g}\,t_c$', fontsize=10)
    axes.tick_params(labelsize=7)
    pictures.bar_below(figure, image, bar, label, 'both')
    return figure


def walls_share(run, one, grains):
    """Of each cell, what walls inside the box cover: the covered share away from the spheres; None without such walls."""
    if not run.given('domain.walls_file'):
        return None
    share = one.covered.copy()
    if grains is None:
        return share
    x, y = (0.5 * (edges[1:] + edges[:-1]) for edges in one.edges)
    # Spheres cover a little more than they are.
    cut = cut_grains(run, one, grains, run.scale('D') / float(run.case['fluid.cells_per_diameter']))
    for centre, radius in zip(cut.centres, cut.radii):
        share[np.hypot(x[None, :] - centre[0], y[:, None] - centre[1]) < radius] = 0.0
    return share


def coloured(axes, x, y, values, **how):
    """Between the centres of equal cells colours change gradually, as in the plane; stretched rows are drawn as they
    are."""
    if np.allclose(np.diff(y), y[1] - y[0], rtol=1e-3):
        return axes.imshow(values, origin='lower', extent=(x[0], x[-1], y[0], y[-1]), interpolation='bilinear', **how)
    return axes.pcolormesh(x, y, values, rasterized=True, **how)


def caption(run, shown):
    fastest = max((float(np.sqrt((one.velocity**2).sum(axis=-1)).max()), one.time) for one, _ in shown)
    planes = ', '.join(sorted({one.name(run) for one, _ in shown}))
    bodies = 'Spheres and walls (grey)' if run.given('domain.walls_file') else 'Spheres'
    return (f'Planes {planes} (output.slices; files for ParaView: fluid/slices/slices.pvd). Colour: vertical velocity of the '
            'fluid on one scale, red up, blue down; then its reduced pressure, the mean outside spheres taken off. '
            f'{bodies} where the plane cuts them. Fastest here: {fastest[0] / run.scale("u_c"):.3g} u_c at t = '
            f'{fastest[1] / run.scale("t_c"):.3g} t_c.')
