# SPDX-License-Identifier: LGPL-2.1-or-later
"""Draws grains on a plot with axes in D: discs, and polygons at their angle."""
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
