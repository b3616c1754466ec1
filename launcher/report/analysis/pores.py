# SPDX-License-Identifier: LGPL-2.1-or-later
"""Change of the pore volume during a collapse, Fig. 10 of Topin et al. 2011: dV/V0 against the relative displacement
dx/x0 of the centre of gravity.

Of the whole column V is `pore_volume` of history.csv. Of a cell of a coarse grid it is measured at constant solid,
dV/V0 = e/e0 - 1 with e the void ratio (pores over solid of the triangles in the cell): the same for a set of grains
that stays together, and it does not change when grains only pass through. The void ratio of the whole packing has no
edge at which triangles appear and vanish as the column spreads.
"""
from dataclasses import dataclass

import numpy as np

from analysis import coarse_grid, packing_triangles, snapshots
from analysis.once import once_per_run

AT = 0.05  # dx/x0 at which runs are compared
LEAST_SOLID = 3.0  # D^2 in a cell: fewer grains have no void ratio
REGIMES_TO = 0.3   # dx/x0: two lines are fitted to the curve until there ...
LEAST_SPAN = 0.1   # ... or to its end, if that is at least so far
FIT_POINTS = 300   # at equal distances in dx/x0


@dataclass
class PoreCurve:
    """Over the rows of the history, and over snapshots for the void ratio."""

    displacement: np.ndarray  # dx/x0
    change: np.ndarray        # dV/V0
    void_displacement: np.ndarray
    void_change: np.ndarray   # e/e0 - 1 of the whole packing


@once_per_run
def pore_curve(run):
    """None unless the scales are an avalanche's and the history has pores and positions."""
    time, pores = run.column('pore_volume')
    _, x = run.column('mean_position_x')
    if not run.is_avalanche() or len(pores) < 2 or len(x) != len(pores) or pores[0] <= 0.0 or x[0] <= 0.0:
        return None
    there, voids = void_ratios(run)
    moved = x / x[0] - 1.0
    return PoreCurve(moved, pores / pores[0] - 1.0, np.interp(there, time, moved), voids / voids[:1] - 1.0)


def void_ratios(run):
    """(times [t_c], void ratios of the whole packing) at the snapshots; none in space, where it has no triangles."""
    meshes = [] if run.in_space() else [(one.time, packing_triangles.triangles(one)) for one in snapshots.snapshots(run)]
    found = [(time, mesh.pores().sum() / mesh.solid.sum()) for time, mesh in meshes
             if mesh is not None and mesh.solid.sum() > 0.0]
    return np.array(found).reshape(-1, 2).T


def change_at(run, displacement=AT):
    """dV/V0 of the whole column when its centre of gravity has first moved so far; None if it has not."""
    found = pore_curve(run)
    if found is None or found.displacement.max() < displacement:
        return None
    after = int(np.argmax(found.displacement >= displacement))
    part = slice(max(after - 1, 0), after + 1)
    return float(np.interp(displacement, found.displacement[part], found.change[part]))


def largest_change(run):
    """dV/V0 of largest magnitude until the centre of gravity has moved by AT."""
    found = pore_curve(run)
    if found is None:
        return None
    there = change_at(run)
    initial = found.change if there is None else np.append(
        found.change[:int(np.argmax(found.displacement >= AT))], there)
    return float(initial[np.abs(initial).argmax()])


@dataclass
class Regimes:
    """dV/V0 over dx/x0 as a continuous curve of two straight lines."""

    knee: float    # dx/x0
    first: float   # slope of dV/V0 until there
    second: float  # and after it


def regimes(run):
    """The line through the origin and the one from its end, the knee, that fit dV/V0 over dx/x0 best; None if the column
    moves too little."""
    found = pore_curve(run)
    if found is None or found.displacement.max() < LEAST_SPAN:
        return None
    moved = np.maximum.accumulate(found.displacement)
    at = np.linspace(0.0, min(REGIMES_TO, moved[-1]), FIT_POINTS + 1)[1:]
    change = np.interp(at, moved, found.change)
    fits = [two_lines(at, change, knee) for knee in at[FIT_POINTS // 50:-FIT_POINTS // 50]]
    return min(fits, key=lambda fit: fit[0])[1]


def two_lines(at, change, knee):
    """(sum of squared errors, Regimes) of the best lines with this knee."""
    lengths = np.column_stack([np.minimum(at, knee), np.maximum(at - knee, 0.0)])
    slopes = np.linalg.lstsq(lengths, change, rcond=None)[0]
    return float(((lengths @ slopes - change)**2).sum()), Regimes(float(knee), *map(float, slopes))


def change_per_cell(run, snapshot):
    """(grid, (rows, columns) of e/e0 - 1) between the first output and this one; nan where either has too few
    grains."""
    grid = coarse_grid.grid_over(run)
    first, now = (void_ratio(grid, packing_triangles.triangles(one))
                  for one in (snapshots.snapshots(run)[0], snapshot))
    return grid, coarse_grid.ratio(now, first) - 1.0


def void_ratio(grid, mesh):
    if mesh is None:
        return np.full((grid.rows, grid.columns), np.nan)
    solid = grid.sums(mesh.middles, mesh.solid)
    return np.where(solid >= LEAST_SOLID, coarse_grid.ratio(grid.sums(mesh.middles, mesh.pores()), solid), np.nan)
