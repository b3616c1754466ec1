# SPDX-License-Identifier: LGPL-2.1-or-later
"""How long the immersed columns wait. A column that has not finished starting by the end of its run has a bound, which is
told and never enters a mean or a fit."""
from dataclasses import dataclass

import numpy as np

from analysis import peaks, relaxation
from paper.selection import spread

AT_ONCE = 1.0          # t_c: a column that waits less has not waited
LEAST_WAITING = 0.829  # the dense behaviour: phi from here on (section 3.3)


@dataclass
class Wait:
    """t_relax [t_c], or, where it is a bound, what it exceeds."""

    time: float
    bounds: tuple  # by fits of other lengths; None without any
    bound: bool
    slides: bool  # False: it has not slid at all

    @property
    def text(self):
        if not self.bound:
            return f'{self.time:.3g}'
        return ('> ' if self.slides else 'stands to ') + f'{np.floor(10.0 * self.time) / 10.0:g}'

    @property
    def at_once(self):
        return not self.bound and self.time < AT_ONCE

    @property
    def waits(self):
        return self.time >= AT_ONCE


def wait(run):
    found = relaxation.relaxation(run)
    if found is not None:
        return Wait(found.time, found.times, found.bound, True)
    return Wait(float(run.column(peaks.COLUMN)[0][-1]), None, True, False)


def waits(runs, reynolds, compacity):
    return [wait(run) for run in runs.immersed(compacity=compacity, reynolds=reynolds)]


def told(found):
    """`mean (smallest to largest)`, or one by one where some are bounds."""
    if any(one.bound for one in found):
        return ', '.join(one.text for one in found)
    return spread([one.time for one in found])


@dataclass
class Line:
    """t_relax = slope phi + level of the dense columns with a t_relax."""

    slope: float          # t_c
    level: float
    straight: float       # R^2; None where fewer than three compacities have one
    compacities: list     # of the points
    left_out: int         # columns with a bound


def line(runs, reynolds, compacities):
    """None where fewer than two dense compacities have a t_relax."""
    found = [(float(phi), one) for phi in compacities if float(phi) >= LEAST_WAITING
             for one in waits(runs, reynolds, phi)]
    points = np.array([(phi, one.time) for phi, one in found if not one.bound]).reshape(-1, 2)
    there = sorted(set(points[:, 0]))
    if len(there) < 2:
        return None
    slope, level = np.polyfit(*points.T, 1)
    return Line(float(slope), float(level), straightness(points, slope, level) if len(there) > 2 else None, there,
                sum(one.bound for _, one in found))


def straightness(points, slope, level):
    """R^2."""
    rest = points[:, 1] - slope * points[:, 0] - level
    total = ((points[:, 1] - points[:, 1].mean())**2).sum()
    return float(1.0 - (rest**2).sum() / total) if total > 0.0 else 0.0
