# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws grains on a plot with axes in D: discs, and polygons at their angle. Places may run on across cyclic sides for
any number of periods: what is drawn is inside the box, with the images of what reaches through its sides."""
from dataclasses import fields, replace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import EllipseCollection, PolyCollection

FACE, EDGE = '#d9d4c7', '#3a3a3a'
EDGE_WIDTH = 0.4  # points


def draw(axes, grains, diameter, values=None, limits=None, colours='viridis', alpha=1.0):
    """Adds the grains; with `values`, one per grain, they are coloured between `limits` and the image for a colour
    bar is returned. Otherwise they are plain and None is returned."""
    image = None
    for chosen, collection in collections(axes, grains, diameter):
        collection.set(edgecolors=EDGE, linewidths=EDGE_WIDTH, alpha=alpha)
        if values is None:
            collection.set_facecolors(FACE)
        else:
            collection.set(array=values[chosen], cmap=plt.get_cmap(colours), clim=limits)
            collection.set_edgecolors('face')
            image = collection
        axes.add_collection(collection)
    return image


def periods(run):
    """(axis, length [D]) of the axes whose sides are cyclic."""
    sides = zip(('left', 'bottom'), run.size()) if 'domain.size' in run.case else ()
    return [(axis, length) for axis, (side, length) in enumerate(sides) if run.case.get(f'domain.{side}') == 'cyclic']


def images(cyclic, centres, low, high):
    """Which of some bodies, with these centres and between these corners (n, 2), are seen in a box with such periods,
    and by how much they are to be moved: each to its place inside, and what reaches through a side to the other one as
    well."""
    chosen, shifts = np.arange(len(centres)), np.zeros_like(centres)
    for axis, period in cyclic:
        shifts[:, axis] = -period * np.floor(centres[:, axis] / period)
    for axis, period in cyclic:
        step = period * np.eye(2)[axis]
        below = low[chosen, axis] + shifts[:, axis] < 0.0
        above = high[chosen, axis] + shifts[:, axis] > period
        chosen, shifts = (np.concatenate([chosen, chosen[below], chosen[above]]),
                          np.concatenate([shifts, shifts[below] + step, shifts[above] - step]))
    return chosen, shifts


def with_images(run, grains):
    """The grains as they are seen in the plane: images are grains of their own."""
    cyclic, diameter = periods(run), run.scale('D')
    if not cyclic or not len(grains.radii):
        return grains
    centres, radii = grains.centres / diameter, grains.radii[:, None] / diameter
    chosen, shifts = images(cyclic, centres, centres - radii, centres + radii)
    arrays = {one.name: getattr(grains, one.name) for one in fields(grains)}
    seen = {name: values[chosen] for name, values in arrays.items() if isinstance(values, np.ndarray)}
    seen['centres'] = seen['centres'] + shifts * diameter
    outlines = None if grains.outlines is None else {
        new: grains.outlines[old] + shifts[new] * diameter for new, old in enumerate(chosen) if old in grains.outlines}
    return replace(grains, **seen, outlines=outlines)


def lines_with_images(run, ends):
    """(which lines, their ends): the same of lines between two ends (n, 2, 2) [D]."""
    cyclic = periods(run)
    if not cyclic:
        return np.arange(len(ends)), ends
    chosen, shifts = images(cyclic, ends.mean(axis=1), ends.min(axis=1), ends.max(axis=1))
    return chosen, ends[chosen] + shifts[:, None]


def reach(run, grains):
    """How far the grains are seen to reach to the right and upwards [D]: not beyond cyclic sides."""
    seen = with_images(run, grains)
    far = ((seen.centres + seen.radii[:, None]) / run.scale('D')).max(axis=0)
    for axis, period in periods(run):
        far[axis] = min(far[axis], period)
    return far


def collections(axes, grains, diameter):
    """(indices of grains, their collection) of the discs and of the polygons, if there are any."""
    outlines = grains.outlines or {}
    polygons = np.array(sorted(outlines), dtype=int)
    discs = np.setdiff1d(np.arange(len(grains.radii)), polygons)
    found = []
    if len(discs):
        sizes = 2.0 * grains.radii[discs] / diameter
        found.append((discs, EllipseCollection(
            sizes, sizes, np.zeros_like(sizes), units='xy', offsets=grains.centres[discs] / diameter,
            transOffset=axes.transData)))
    if len(polygons):
        found.append((polygons, PolyCollection([outlines[i] / diameter for i in polygons])))
    return found
