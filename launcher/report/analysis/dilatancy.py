# SPDX-License-Identifier: LGPL-2.1-or-later
"""Dilatancy angle psi of a packing that shears: sin psi = (growth of its area) / (shear), both as rates; psi > 0 where
it expands. With the principal rates of strain d1 >= d2 (extension positive) it is sin psi = (d1 + d2)/(d1 - d2) in a
cell, and for the whole packing the ratio of the sums over its triangles, weighted by their areas."""
from dataclasses import dataclass

import numpy as np

import findings
from analysis import peaks
from analysis import packing_triangles, snapshots
from analysis.once import once_per_run


@dataclass
class Dilatancy:
    time: np.ndarray    # t_c
    growth: np.ndarray  # sum of A div u [D^2/t_c]
    shear: np.ndarray   # sum of A times the shear rate [D^2/t_c]

    def angles(self):
        """Degrees; nan at rest."""
        return angle(self.growth, self.shear)


def angle(growth, shear):
    sine = np.divide(growth, shear, out=np.full(np.shape(growth), np.nan), where=np.asarray(shear) > 0.0)
    return np.degrees(np.arcsin(np.clip(sine, -1.0, 1.0)))


@once_per_run
def dilatancy(run):
    """Over the snapshots of an avalanche in which grains move; None without any, and in space."""
    if not run.is_avalanche() or run.in_space():
        return None
    rows = [(one.time, *rates(packing_triangles.triangles(one))) for one in snapshots.snapshots(run)]
    moving = [row for row in rows if row[2] > 0.0]
    return Dilatancy(*np.array(moving).T) if moving else None


def rates(mesh):
    if mesh is None:
        return 0.0, 0.0
    return float((mesh.areas * mesh.dilatancy()).sum()), float((mesh.areas * mesh.shear_rate()).sum())


def initial_angle(run):
    """Degrees, of the whole motion until the mean velocity has risen to half of its peak; None if nothing slid."""
    found, half = dilatancy(run), peaks.half_time(run)
    if found is None or half is None:
        return None
    early = findings.until(found.time, half)
    if early.sum() < 2:
        return None
    growth, shear = (np.trapz(rate[early], found.time[early]) for rate in (found.growth, found.shear))
    return float(angle(growth, shear)) if shear > 0.0 else None
