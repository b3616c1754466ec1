# SPDX-License-Identifier: LGPL-2.1-or-later
"""Local rheology of the moving packing: friction mu and compacity phi against the inertial number I and the viscous
number J, in cells of a coarse grid.

    p = (s1 + s2)/2      mu = (s1 - s2)/(2 p)      s1 >= s2 principal contact stresses
    I = rate D sqrt(rho_s/p)         J = eta_f rate/p         rate = |du/dy| in simple shear

(GDR MiDi 2004; Cassar, Nicolas & Pouliquen 2005 for the viscous number). The stress of a cell is the sum of f (x) l of
the contacts whose middle lies in it over the area of its triangles; the rate is that of its mean velocity gradient.
"""
from dataclasses import dataclass

import numpy as np

from analysis import coarse_grid, packing_triangles, snapshots
from analysis.once import once_per_run

FEWEST_TRIANGLES = 6
FEWEST_CONTACTS = 6       # a stress of one contact says nothing about friction
LEAST_PRESSURE = 0.02  # rho_s g D: below, a cell is carried by single contacts
BINS = np.logspace(-8, 1, 28)
FEWEST_IN_BIN = 8


@dataclass
class Cells:
    """One entry per cell and snapshot."""

    time: np.ndarray      # t_c
    friction: np.ndarray  # mu
    compacity: np.ndarray  # phi
    inertial: np.ndarray  # I
    viscous: np.ndarray   # J, nan in dry runs


@once_per_run
def cells(run):
    """Of all snapshots with contacts in which grains move; None without any, and in space."""
    if 'domain.size' not in run.case or run.in_space():
        return None
    grid = coarse_grid.grid_over(run)
    parts = [part for one in snapshots.snapshots(run) for part in [of_snapshot(run, one, grid)] if part is not None]
    return Cells(*np.concatenate(parts, axis=1)) if parts else None


def of_snapshot(run, snapshot, grid):
    """(5, n) for the cells that can be measured, or None."""
    if snapshot.contacts is None or len(snapshot.contacts.first) == 0:
        return None
    mesh = packing_triangles.triangles(snapshot)
    if mesh is None:
        return None
    area = grid.sums(mesh.middles, mesh.areas)
    pressure, deviator = invariants(stress(grid, snapshot.contacts, area))
    rate = shear_rate(grid, mesh, area)
    good = ((counts(grid, mesh.middles) >= FEWEST_TRIANGLES)
            & (counts(grid, snapshot.contacts.ends.mean(axis=1)) >= FEWEST_CONTACTS) & (pressure > LEAST_PRESSURE) & (rate > 0.0))
    if not good.any():
        return None
    pressure, rate, deviator = pressure[good], rate[good], deviator[good]
    compacity = grid.sums(mesh.middles, mesh.solid)[good] / area[good]
    velocity, diameter = run.scale('u_c'), run.scale('D')
    per_gravity = velocity / np.sqrt(float(run.record.get('g') or 1.0) * diameter)  # u_c / sqrt(g D)
    inertial = rate * per_gravity / np.sqrt(pressure)
    return np.array([np.full(len(rate), snapshot.time), deviator / pressure, compacity, inertial,
                     viscous_number(run, snapshot, rate, pressure, per_gravity)])


def counts(grid, places):
    return grid.sums(places, np.ones(len(places)))


def viscous_number(run, snapshot, rate, pressure, per_gravity):
    """eta_f rate/p = rate/(Re rho_s/rho_f p) with p in rho_s g D and the rate in u_c/D."""
    reynolds = float(run.record.get('reynolds') or 0.0)
    if not run.is_wet() or reynolds <= 0.0:
        return np.full(len(rate), np.nan)
    return per_gravity**2 * rate / (reynolds * snapshot.density * pressure)


def stress(grid, contacts, area):
    """(2, 2, rows, columns) [rho_s g D], compression positive."""
    middles, branches = contacts.ends.mean(axis=1), contacts.branches()
    return np.array([[coarse_grid.ratio(grid.sums(middles, contacts.force[:, i] * branches[:, j]), area)
                      for j in range(2)] for i in range(2)])


def invariants(tensor):
    """(mean of the principal values, half their difference) of the symmetric part."""
    (xx, xy), (yx, yy) = tensor
    return 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), 0.5 * (xy + yx))


def shear_rate(grid, mesh, area):
    """Of the mean velocity gradient of a cell [u_c/D]; nan in empty cells."""
    mean = lambda i, j: coarse_grid.ratio(grid.sums(mesh.middles, mesh.areas * mesh.gradients[:, i, j]), area)
    return np.hypot(mean(0, 0) - mean(1, 1), mean(0, 1) + mean(1, 0))


def medians(number, values):
    """(middles of the decades' parts, medians there) where there are at least 8 values."""
    place = np.digitize(number, BINS)
    found = [(np.sqrt(BINS[k - 1] * BINS[k]), np.median(values[place == k])) for k in range(1, len(BINS))
             if (place == k).sum() >= FEWEST_IN_BIN]
    return np.array(found).T if found else np.empty((2, 0))


def friction_between(run, low, high):
    """Median of mu of an avalanche for I from low to high; None for fewer than 8 cells."""
    found = cells(run) if run.is_avalanche() else None
    if found is None:
        return None
    chosen = (found.inertial >= low) & (found.inertial < high)
    return float(np.median(found.friction[chosen])) if chosen.sum() >= FEWEST_IN_BIN else None
