# SPDX-License-Identifier: LGPL-2.1-or-later
"""The solid of the grains: their volumes, their mean density rho_s, and the unit of contact forces that is made of it.

rho_s is that of history.csv: sum of rho V over sum of V of all grains that are in the box at the time, prescribed ones
among them. In the plane a volume is an area.
"""
import numpy as np

import grain_files
from analysis.once import UNREADABLE, once_per_run


def volumes(run, grains):
    """Areas of discs, or of the outlines of polygons [D^2]; in space the volumes of spheres [D^3]."""
    diameter = run.scale('D')
    radii = grains.radii / diameter
    if run.in_space():
        return 4.0 / 3.0 * np.pi * radii**3
    areas = np.pi * radii**2
    for i, corners in (grains.outlines or {}).items():
        x, y = corners.T / diameter
        areas[i] = 0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1)))
    return areas


def square_gyrations(run, grains):
    """(n,) I/M about the centre of mass [D^2]: R^2/2 of discs, 2 R^2/5 of spheres; of polygons with corners p, q, ...
    sum of c (p.p + p.q + q.q) over 6 times sum of c, c = p x q."""
    diameter = run.scale('D')
    squares = (0.4 if run.in_space() else 0.5) * (grains.radii / diameter)**2
    for i, corners in (grains.outlines or {}).items():
        p = (corners - grains.centres[i]) / diameter
        q = np.roll(p, -1, axis=0)
        c = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
        squares[i] = c @ (p * p + p * q + q * q).sum(axis=1) / (6.0 * c.sum())
    return squares


def ratios_in_liquid(run, grains):
    """(n,) R_h/R, what the liquid sees of a grain: h + s/(cells per R), the shift s of the surface in space only."""
    ratio = float(run.case.get('fluid.hydrodynamic_radius', 1.0))
    if not run.in_space():
        return np.full(len(grains.radii), ratio)
    cells = float(run.case['fluid.cells_per_diameter']) * grains.radii / run.scale('D')
    return ratio + float(run.case.get('fluid.surface_shift', 0.0)) / cells


def densities(run, grains):
    """(n,) over rho_f. Files without densities are of equal grains."""
    if grains.densities is None:
        return np.full(len(grains.radii), float(run.case.get('grains.density_ratio', 1.0)))
    return grains.densities / float(run.record.get('rho') or 1.0)


def mean_density(run, grains):
    """rho_s/rho_f of the grains of one output; of an empty box, or None, that of the case."""
    if grains is None or len(grains.radii) == 0:
        return float(run.case.get('grains.density_ratio', 1.0))
    return float(np.average(densities(run, grains), weights=volumes(run, grains)))


@once_per_run
def first_mean_density(run):
    """rho_s/rho_f of the first output of the grains that can be read; of runs without any, that of the case."""
    for output in grain_files.quiet_series(run):
        try:
            return mean_density(run, grain_files.read_grains(*output))
        except UNREADABLE:
            continue
    return mean_density(run, None)


def unit_force(run, grains):
    """rho_s g D^2 per unit length out of the plane, in space rho_s g D^3, of the grains of one output. Dry runs in units
    of D, u_c use the density of a fictitious fluid as unit."""
    density = float(run.record.get('rho') or 1.0) * mean_density(run, grains)
    return density * float(run.record.get('g') or 1.0) * run.scale('D')**(3 if run.in_space() else 2)
