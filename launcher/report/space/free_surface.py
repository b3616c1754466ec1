# SPDX-License-Identifier: LGPL-2.1-or-later
"""The free surface of a heap of spheres: the highest point in each column of one D x D. The last column is as wide as the box
has room for it."""
import numpy as np

BARE = 0.5  # D: a mean height below this counts as bare floor, with single spheres on it


def heights(run, grains):
    """(columns along x, columns along z), in D; 0 where there is no grain."""
    diameter = run.scale('D')
    centres, radii = with_images(run, grains.positions() / diameter, grains.radii / diameter)
    ends = np.array([run.size()[0], run.depth()])
    shape = tuple(np.ceil(ends).astype(int))
    found = np.zeros(shape)
    reach = int(np.ceil(radii.max())) if len(radii) else 0
    own = np.floor(centres[:, [0, 2]]).astype(int)
    for i in range(-reach, reach + 1):
        for k in range(-reach, reach + 1):
            column = own + (i, k)
            top = tops(centres, radii, column, np.minimum(column + 1.0, ends))
            there = (top > 0.0) & (column >= 0).all(axis=1) & (column < shape).all(axis=1)
            np.maximum.at(found, tuple(column[there].T), top[there])
    return found


def with_images(run, centres, radii):
    """Centres and radii, and those of the images of spheres that reach through a cyclic side."""
    for axis, side, length in ((0, 'left', run.size()[0]), (2, 'front', run.depth())):
        if run.case.get(f'domain.{side}') != 'cyclic':
            continue
        centres, radii = with_images_along(axis, length, centres, radii)
    return centres, radii


def with_images_along(axis, period, centres, radii):
    """Centres (n, d) inside a period, and the images of those that reach into it from beyond its ends."""
    centres = centres.copy()
    centres[:, axis] %= period
    shift = np.eye(centres.shape[1])[axis] * period
    low, high = centres[:, axis] < radii, centres[:, axis] > period - radii
    return (np.concatenate([centres, centres[low] + shift, centres[high] - shift]),
            np.concatenate([radii, radii[low], radii[high]]))


def tops(centres, radii, begin, end):
    """Highest point of each sphere above its column, between two corners (x, z); 0 if it does not reach it."""
    nearest = np.clip(centres[:, [0, 2]], begin, end) - centres[:, [0, 2]]
    below = radii**2 - (nearest**2).sum(axis=1)
    return np.where(below > 0.0, centres[:, 1] + np.sqrt(np.maximum(0.0, below)), 0.0)


def over_length(run, grains):
    """(middles of the columns along x, their mean height over the depth), both in D; 0 where the floor is bare."""
    found, depth = heights(run, grains), run.depth()
    widths = np.minimum(1.0, depth - np.arange(found.shape[1]))
    mean = found @ widths / depth
    return np.arange(len(mean)) + 0.5, np.where(mean < BARE, 0.0, mean)
