# SPDX-License-Identifier: LGPL-2.1-or-later
"""The free surface of a heap of spheres: the highest point in each column of one D x D."""
import numpy as np

BARE = 0.5  # D: a mean height below this counts as bare floor, with single spheres on it


def heights(run, grains):
    """(columns along x, columns along z), in D; 0 where there is no grain."""
    diameter = run.scale('D')
    centres, radii = grains.positions() / diameter, grains.radii / diameter
    shape = int(np.ceil(run.size()[0])), int(np.ceil(run.depth()))
    found = np.zeros(shape)
    reach = int(np.ceil(radii.max())) if len(radii) else 0
    own = np.floor(centres[:, [0, 2]]).astype(int)
    for i in range(-reach, reach + 1):
        for k in range(-reach, reach + 1):
            column = own + (i, k)
            top = tops(centres, radii, column)
            there = (top > 0.0) & (column >= 0).all(axis=1) & (column < shape).all(axis=1)
            np.maximum.at(found, tuple(column[there].T), top[there])
    return found


def tops(centres, radii, column):
    """Highest point of each sphere above its column; 0 if it does not reach it."""
    nearest = np.clip(centres[:, [0, 2]], column, column + 1.0) - centres[:, [0, 2]]
    below = radii**2 - (nearest**2).sum(axis=1)
    return np.where(below > 0.0, centres[:, 1] + np.sqrt(np.maximum(0.0, below)), 0.0)


def over_length(run, grains):
    """(middles of the columns along x, their mean height over the depth), both in D; 0 where the floor is bare."""
    mean = heights(run, grains).mean(axis=1)
    return np.arange(len(mean)) + 0.5, np.where(mean < BARE, 0.0, mean)
