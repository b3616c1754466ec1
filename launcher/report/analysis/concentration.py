# SPDX-License-Identifier: LGPL-2.1-or-later
"""Concentration over height: the solid share of horizontal layers of the box, at the output times. A disc is cut by the
layers exactly, a sphere likewise; a polygon counts as the disc of its area."""
from dataclasses import dataclass

import numpy as np

from analysis import snapshots
from analysis.once import once_per_run

LAYER = 1.0  # D


@dataclass
class Concentration:
    time: np.ndarray    # (n,) t_c
    edges: np.ndarray   # (m + 1,) heights between the layers [D]
    shares: np.ndarray  # (n, m)


@once_per_run
def concentration(run):
    """None without a domain or grains."""
    there = snapshots.snapshots(run) if 'domain.size' in run.case else []
    if not there:
        return None
    width, height = run.size()
    ground = width * run.depth() if run.in_space() else width
    edges = np.linspace(0.0, height, max(1, int(round(height / LAYER))) + 1)
    period = height if run.has_cyclic_floor() else None
    solid = [in_layers(one, edges, run.in_space(), period) for one in there]
    return Concentration(np.array([one.time for one in there]), edges, np.array(solid) / (ground * np.diff(edges)))


def in_layers(snapshot, edges, in_space=False, period=None):
    """Solid area of each layer [D^2], in space its volume [D^3]. With a period [D], positions run on beyond floor and top,
    and a grain near one of them reaches in at the other."""
    radius = snapshot.radii if in_space else np.sqrt(snapshot.areas / np.pi)
    share = volume_below if in_space else below_level
    height = snapshot.centres[:, 1] if period is None else snapshot.centres[:, 1] % period
    images = (0.0,) if period is None else (-period, 0.0, period)
    return np.diff([sum(share(height + image, radius, level).sum() for image in images) for level in edges])


def below_level(height, radius, level):
    """Area of discs below a level: R^2 (pi/2 + s sqrt(1 - s^2) + asin s), s = (level - y)/R within -1 and 1."""
    s = np.clip((level - height) / radius, -1.0, 1.0)
    return radius**2 * (0.5 * np.pi + s * np.sqrt(1.0 - s**2) + np.arcsin(s))


def volume_below(height, radius, level):
    """Volume of spheres below a level: pi R^3 (2/3 + s - s^3/3)."""
    s = np.clip((level - height) / radius, -1.0, 1.0)
    return np.pi * radius**3 * (2.0 / 3.0 + s - s**3 / 3.0)


def bed(run):
    """(height [D] of the layers that are denser than half of the densest, one on the other; concentration there) at the
    end; None for an empty box. The bed need not stand on the floor of the box."""
    found = concentration(run)
    if found is None or not found.shares[-1].any():
        return None
    last = found.shares[-1]
    filled = last >= 0.5 * last.max()
    return float(np.diff(found.edges)[filled].sum()), float(last[filled].mean())
