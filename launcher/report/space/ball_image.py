# SPDX-License-Identifier: LGPL-2.1-or-later
"""A picture of many spheres without a graphics library: every sphere marks the pixels that it covers, and the nearest
surface stays (z-buffer). Spheres of one size in pixels are marked together.

Light comes from the upper left, behind the viewer. Where a surface lies deeper than its surroundings it is darker
(Luft, Colditz and Deussen 2006: unsharp masking of the depth), so that gaps and fronts of a heap can be seen.
"""
from dataclasses import dataclass

import numpy as np

LIGHT = np.array([-0.35, 0.65, 0.67]) / np.linalg.norm([-0.35, 0.65, 0.67])
AMBIENT = 0.5
DEEP_SHADE = 0.38     # the darkest that depth makes a surface
SHADE_REACH = 1.2     # of the depth compared with its surroundings, in median radii
FEWEST_PIXELS = 0.5   # radius of the smallest mark
CHUNK = 4_000_000     # pixels that are marked at one time


@dataclass
class Surfaces:
    """The nearest surface per pixel, rows from the bottom."""

    owner: np.ndarray   # (rows, columns) index of the sphere, -1 without one
    depth: np.ndarray   # (rows, columns) towards the viewer [D]
    offset: np.ndarray  # (rows, columns, 2) from the centre of the sphere, over its radius


def surfaces(seen, radii, extent, pixels_per_length):
    """`seen`: centres as a camera sees them (n, 3); `extent`: left, right, bottom, top of the picture."""
    left, right, bottom, top = extent
    columns, rows = (max(1, int(np.ceil((high - low) * pixels_per_length)))
                     for low, high in ((left, right), (bottom, top)))
    seen, radii = seen.astype(np.float32), np.asarray(radii, dtype=np.float32)
    found = Surfaces(np.full(rows * columns, -1, dtype=np.int32), np.full(rows * columns, -np.inf, dtype=np.float32),
                     np.zeros((rows * columns, 2), dtype=np.float32))
    places = (seen[:, :2] - np.float32([left, bottom])) * np.float32(pixels_per_length) - np.float32(0.5)
    sizes = np.maximum(radii * np.float32(pixels_per_length), np.float32(FEWEST_PIXELS))
    half = np.ceil(sizes).astype(int)
    for reach in np.unique(half):
        members = np.flatnonzero(half == reach)
        per_chunk = max(1, CHUNK // (2 * reach + 1)**2)
        for first in range(0, len(members), per_chunk):
            _mark(found, members[first:first + per_chunk], reach, places, sizes, seen[:, 2], radii, (rows, columns))
    return Surfaces(found.owner.reshape(rows, columns), found.depth.reshape(rows, columns),
                    found.offset.reshape(rows, columns, 2))


def _mark(found, members, reach, places, sizes, towards, radii, shape):
    """Marks the pixels of these spheres, all of which reach `reach` pixels from their nearest pixel."""
    rows, columns = shape
    j, i = np.mgrid[-reach:reach + 1, -reach:reach + 1]
    nearest = np.rint(places[members]).astype(int)
    column, row = (nearest[:, k, None] + step.ravel() for k, step in enumerate((i, j)))
    dx, dy = ((pixel - places[members, k, None]) / sizes[members, None] for k, pixel in enumerate((column, row)))
    inside = dx**2 + dy**2
    keep = (inside <= 1.0) & (column >= 0) & (column < columns) & (row >= 0) & (row < rows)
    depth = towards[members, None] + radii[members, None] * np.sqrt(np.maximum(0.0, 1.0 - inside))
    owner = np.broadcast_to(members[:, None], keep.shape)[keep]
    pixel, depth, offset = (row * columns + column)[keep], depth[keep], np.stack([dx[keep], dy[keep]], axis=-1)
    order = np.argsort(depth, kind='stable')  # of several assignments to a pixel the last one stays: the nearest
    order = order[depth[order] > found.depth[pixel[order]]]
    found.depth[pixel[order]], found.owner[pixel[order]] = depth[order], owner[order]
    found.offset[pixel[order]] = offset[order]


def shaded(found, colours, radius):
    """(rows, columns, 4) of colours (n, 3) per sphere; transparent without a sphere. `radius`: a typical one, in
    pixels."""
    covered = found.owner >= 0
    facing = np.sqrt(np.maximum(0.0, 1.0 - (found.offset**2).sum(axis=-1)))
    diffuse = np.clip(found.offset @ LIGHT[:2] + facing * LIGHT[2], 0.0, 1.0)
    light = (AMBIENT + (1.0 - AMBIENT) * diffuse) * _depth_shade(found.depth, covered, radius)
    image = np.zeros((*covered.shape, 4), dtype=np.float32)
    image[covered, :3] = colours[found.owner[covered]] * light[covered, None]
    image[covered, 3] = 1.0
    return image


def _depth_shade(depth, covered, radius):
    """Between DEEP_SHADE and 1: how far a surface lies below the mean of its surroundings."""
    if not covered.any():
        return np.ones(depth.shape)
    reach = max(1, int(round(SHADE_REACH * radius)))
    filled = np.where(covered, depth, 0.0)
    weight = blurred(covered.astype(np.float32), reach)
    below = np.where(covered, blurred(filled, reach) / np.maximum(weight, 1e-9) - filled, 0.0)
    scale = np.quantile(np.abs(below[covered]), 0.95) or 1.0
    return 1.0 - (1.0 - DEEP_SHADE) * np.clip(below / (2.0 * scale), 0.0, 1.0)


def blurred(image, reach):
    """Mean over squares of 2 reach + 1 pixels, twice; beyond the border is zero."""
    for _ in range(2):
        for axis in (0, 1):
            image = _running_mean(image, reach, axis)
    return image


def _running_mean(image, reach, axis):
    width = [(0, 0), (0, 0)]
    width[axis] = (reach + 1, reach)
    sums = np.cumsum(np.pad(image, width), axis=axis, dtype=np.float64)
    size = image.shape[axis]
    upper, lower = (np.take(sums, np.arange(size) + shift, axis=axis) for shift in (2 * reach + 1, 0))
    return ((upper - lower) / (2 * reach + 1)).astype(np.float32)


def halved(image):
    """Means of squares of four pixels: smooth edges. Colours count by their opacity."""
    rows, columns = image.shape[0] // 2 * 2, image.shape[1] // 2 * 2
    blocks = image[:rows, :columns].reshape(rows // 2, 2, columns // 2, 2, 4)
    opacity = blocks[..., 3:].mean(axis=(1, 3))
    colour = (blocks[..., :3] * blocks[..., 3:]).mean(axis=(1, 3)) / np.maximum(opacity, 1e-9)
    return np.concatenate([colour, opacity], axis=-1)
