# SPDX-License-Identifier: LGPL-2.1-or-later
"""Where an avalanche shears, and the plane on which it slides (Topin et al. 2011, section 3.2: the dense packing "is
sliced into two parts, the upper part sliding on a lower quiescent part along a preferred direction forming an angle
of 45 degrees").

The shear rate is the difference of the principal rates of strain, averaged over square cells of a coarse grid
(packing_triangles.py). The band is the connected set of cells above half of the largest rate that has the largest
sum; its angle is that of its major axis of inertia, weighted by the rate.
"""
from dataclasses import dataclass

import numpy as np

from analysis import peaks
from analysis import coarse_grid, packing_triangles, snapshots
from analysis.once import once_per_run

CELL = 1.5              # D
IN_BAND = 0.5           # of the largest shear rate
LEAST_ELONGATION = 1.5  # of the band's axes: a rounder region has no direction
FEWEST_CELLS = 4
SLOW = 0.1              # of the fast grains' speed: below, a grain is quiescent
FAST_QUANTILE = 0.9


@dataclass
class ShearBand:
    time: float          # t_c
    grid: coarse_grid.Grid
    rate: np.ndarray     # (rows, columns) shear rate [1/t_c], nan without grains
    band: np.ndarray     # (rows, columns) bool
    middle: np.ndarray   # of the band [D]
    angle: float         # degrees below the horizontal, towards the right; None if the band is round
    elongation: float
    quiescent: float     # share of the grains

    @property
    def is_slip_plane(self):
        """The band is long, and falls to the side that is free."""
        return self.angle is not None and self.angle > 0.0

    @property
    def slip_angle(self):
        """Degrees below the horizontal; None if the band is no slip plane."""
        return self.angle if self.is_slip_plane else None


@once_per_run
def shear_band(run):
    """When the mean velocity of an avalanche has risen to half of its peak; None if it has not slid, and in space."""
    found = moment(run)
    return None if found is None else band_of(found, coarse_grid.grid_over(run, CELL))


def moment(run):
    """The snapshot nearest to half of the peak, on the rise."""
    half = peaks.half_time(run)
    if not run.is_avalanche() or run.in_space() or half is None or 'domain.size' not in run.case:
        return None
    there = [one for one in snapshots.snapshots(run) if one.time > 0.0]
    return min(there, key=lambda one: abs(one.time - half)) if there else None


def band_of(snapshot, grid):
    mesh = packing_triangles.triangles(snapshot)
    if mesh is None:
        return None
    rate = grid.means(mesh.middles, mesh.shear_rate(), mesh.areas)
    if not np.nanmax(rate, initial=0.0) > 0.0:
        return None
    band = strongest_part(np.nan_to_num(rate), IN_BAND)
    middle, angle, elongation = axis_of(grid, np.where(band, np.nan_to_num(rate), 0.0))
    directed = band.sum() >= FEWEST_CELLS and elongation >= LEAST_ELONGATION
    return ShearBand(snapshot.time, grid, rate, band, middle, angle if directed else None, elongation,
                     quiescent_share(snapshot))


def quiescent_share(snapshot):
    """Share of the free grains that are slower than a tenth of the speed which a tenth of them exceed."""
    speeds = np.hypot(*snapshot.velocities[snapshot.free()].T)
    return float((speeds < SLOW * np.quantile(speeds, FAST_QUANTILE)).mean())


def strongest_part(rate, share):
    """The connected cells (8 neighbours) above `share` of the largest rate with the largest sum of rates."""
    left = rate >= share * rate.max()
    best, best_sum = np.zeros_like(left), 0.0
    while left.any():
        part = connected(left, np.unravel_index(int(left.argmax()), left.shape))
        if rate[part].sum() > best_sum:
            best, best_sum = part, rate[part].sum()
        left &= ~part
    return best


def connected(cells, seed):
    """Those of `cells` that are joined to `seed`."""
    part = np.zeros_like(cells)
    part[seed] = True
    while True:
        padded = np.pad(part, 1)
        grown = cells & np.any([padded[i:i + part.shape[0], j:j + part.shape[1]]
                                for i in range(3) for j in range(3)], axis=0)
        if (grown == part).all():
            return part
        part = grown


def axis_of(grid, weights):
    """(middle [D], degrees that the major axis falls to the right, ratio of the axes). Each cell is a square, so that
    one row of cells has a finite ratio."""
    x, y = grid.middles()
    total = weights.sum()
    middle = np.array([(weights.sum(axis=0) * x).sum(), (weights.sum(axis=1) * y).sum()]) / total
    dx, dy = np.meshgrid(x - middle[0], y - middle[1])
    own = grid.cell**2 / 12.0
    moments = np.array([[(weights * dx * dx).sum(), (weights * dx * dy).sum()],
                        [(weights * dx * dy).sum(), (weights * dy * dy).sum()]]) / total + own * np.eye(2)
    sizes, axes = np.linalg.eigh(moments)
    major = axes[:, 1]
    angle = -np.degrees(np.arctan2(major[1], major[0]))
    return middle, float((angle + 90.0) % 180.0 - 90.0), float(np.sqrt(sizes[1] / sizes[0]))


def draw(found, axes):
    """The field in colour, the band outlined, its axis dashed; returns the image."""
    image = axes.pcolormesh(*found.grid.edges(), found.rate, cmap='magma_r', vmin=0.0,
                            vmax=np.nanquantile(found.rate, 0.995))
    axes.contour(*found.grid.middles(), found.band.astype(float), levels=[0.5], colors='#1d5fa8', linewidths=1.0)
    if found.is_slip_plane:
        slope = -np.tan(np.radians(found.angle))
        axes.axline(found.middle, slope=slope, color='#1d5fa8', linestyle='--', linewidth=1.2)
    return image


def caption(found):
    text = (f'Shear rate at t = {found.time:.4g} t_c, when the mean velocity passes half of its peak; outlined: the '
            'band above half of the largest rate.')
    if found.is_slip_plane:
        text += f' Its axis falls to the right at {found.angle:.3g}°.'
    return text + f' Grains at rest then: {100 * found.quiescent:.3g} %.'
