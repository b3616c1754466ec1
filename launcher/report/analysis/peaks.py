# SPDX-License-Identifier: LGPL-2.1-or-later
"""Comparison of avalanches: the peak velocity, and the difference between two mean curves."""
from dataclasses import dataclass

import numpy as np

from differences import difference

COLUMN = 'mean_velocity_norm'  # |<u>|, Fig. 8 of Topin et al. 2011


@dataclass
class Peak:
    """Largest |<u>| [u_c] and its time [t_c]."""

    value: float
    time: float


def peak(run):
    """The peak of one run or of a mean curve; None if the grains never moved."""
    time, values = run.column(COLUMN)
    if not len(values) or values.max() <= 0.0:
        return None
    highest = int(values.argmax())
    return Peak(float(values[highest]), float(time[highest]))


def half_time(run):
    """When |<u>| has risen to half of its peak [t_c]; None if the grains never moved."""
    found = peak(run)
    if found is None:
        return None
    time, velocity = run.column(COLUMN)
    return float(time[int(np.argmax(velocity >= 0.5 * found.value))])


@dataclass
class MemberPeaks:
    mean: Peak    # of the mean curve
    single: list  # of each run

    def of(self, name):
        """Smallest and largest value or time over the runs."""
        values = [getattr(single, name) for single in self.single]
        return min(values), max(values)


def peaks(member):
    mean = peak(member.data)
    single = [peak(run) for run in member.runs]
    return MemberPeaks(mean, single) if mean and all(single) else None


@dataclass
class Pair:
    """Difference of |<u>|(t) of two members over their common time, divided by the largest value of the first
    there."""

    first: str
    second: str
    largest: float
    mean: float   # over time
    begin: float  # t_c
    end: float


def pairs(members):
    """All pairs of members that moved during a common time."""
    found = []
    for i, first in enumerate(members):
        for second in members[i + 1:]:
            apart = difference(first.data.column(COLUMN), second.data.column(COLUMN))
            if apart and apart.scale > 0.0:
                found.append(Pair(first.name, second.name, apart.relative(apart.largest),
                                  apart.relative(apart.mean), apart.begin, apart.end))
    return found
