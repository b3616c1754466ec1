# SPDX-License-Identifier: LGPL-2.1-or-later
"""The phases in which a loose column collapses (Topin et al. 2011, section 3.2): "(1) a free-fall regime, where the top
falls vertically and the particles localized at the bottom are ejected horizontally; (2) a heap regime, where the upper
particles move along an inclined stationary deposit; (3) a horizontal regime where the particles move essentially
horizontally".

Directions are those of mean velocities, in degrees below the horizontal: of the quarter of the grains that was on top at
first, of the quarter that was at the bottom, and of the grains that move, which are faster than a tenth of the speed that
one in ten exceeds (as in shear_band.py).
"""
from dataclasses import dataclass

import numpy as np

import findings
from analysis import shear_band, snapshots
from analysis.once import once_per_run

STEEP = 60.0      # degrees: what falls more steeply falls vertically
FLAT = 15.0       # degrees: what moves less steeply moves horizontally
DEPOSIT = 0.1     # least share of the grains that rest below a heap regime


@dataclass
class Moment:
    time: float     # t_c
    top: float      # degrees
    bottom: float
    moving: float
    resting: float  # share of the grains

    def falls(self):
        return self.top >= STEEP and abs(self.bottom) < 90.0 - STEEP

    def heaps(self):
        return FLAT <= self.moving < STEEP and self.resting >= DEPOSIT

    def is_flat(self):
        return abs(self.moving) < FLAT


@dataclass
class Phases:
    """The moments that show a phase best, each after the one before; None where there is none. Of heaps, those that flow on
    horizontally come first."""

    fall: Moment
    heap: Moment
    flat: Moment

    @property
    def complete(self):
        return None not in (self.fall, self.heap, self.flat)

    @property
    def text(self):
        fall = (f'the top falls at {self.fall.top:.0f}° and the bottom leaves at {self.fall.bottom:.0f}° '
                f'({self.fall.time:.3g} t_c)' if self.fall else 'no free fall')
        heap = (f'grains move at {self.heap.moving:.0f}° over {100 * self.heap.resting:.0f} % at rest '
                f'({self.heap.time:.3g} t_c)' if self.heap else 'no heap')
        flat = f'at {self.flat.moving:.0f}° ({self.flat.time:.3g} t_c)' if self.flat else 'never horizontally'
        return f'{fall}, {heap}, {flat}'


def direction(velocities):
    """Of the mean, degrees below the horizontal towards the right; nan of no grains."""
    if len(velocities) == 0:
        return np.nan
    x, y = velocities.mean(axis=0)
    return float(np.degrees(np.arctan2(-y, x)))


def moments(run):
    """Of the snapshots until the grains rest: what creeps in a heap at rest has a direction too, but is no phase."""
    there = snapshots.snapshots(run)
    free = there[0].free()
    ids, heights = there[0].ids[free], there[0].centres[free, 1]
    low, high = np.quantile(heights, [0.25, 0.75])
    tops, bottoms = ids[heights >= high], ids[heights <= low]
    return [moment(one, tops, bottoms) for one in there
            if one.velocities.any() and not findings.is_at_rest(run, one.time)]


def moment(snapshot, tops, bottoms):
    velocities = snapshot.velocities[snapshot.free()]
    speeds = np.hypot(*velocities.T)
    fast = speeds >= shear_band.SLOW * np.quantile(speeds, shear_band.FAST_QUANTILE)
    of = lambda ids: snapshot.velocities[np.isin(snapshot.ids, ids)]
    return Moment(snapshot.time, direction(of(tops)), direction(of(bottoms)), direction(velocities[fast]),
                  float(1.0 - fast.mean()))


@once_per_run
def phases(run):
    """None without grains of an avalanche."""
    if not run.is_avalanche() or len(snapshots.snapshots(run)) < 2:
        return None
    found = moments(run)
    fall = next((one for one in found if one.falls()), None)
    later = [one for one in found if fall is None or one.time > fall.time]
    last_flat = max((one.time for one in later if one.is_flat()), default=0.0)
    heap = max((one for one in later if one.heaps()), key=lambda one: (one.time < last_flat, one.resting), default=None)
    flat = next((one for one in later if one.is_flat() and (heap is None or one.time > heap.time)), None)
    return Phases(fall, heap, flat)
