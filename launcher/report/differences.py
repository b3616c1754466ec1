# SPDX-License-Identifier: LGPL-2.1-or-later
"""Differences between the histories of two runs."""
from dataclasses import dataclass

import numpy as np


@dataclass
class Difference:
    """Difference of a quantity q(t) from that of the first run, over their common time; `scale` is the first run's
    max |q| there. Relative values are None if that is 0."""

    begin: float  # t_c
    end: float
    rms: float
    largest: float
    mean: float
    scale: float

    def relative(self, value):
        return value / self.scale if self.scale > 0.0 else None


def common_span(first, second):
    """(begin, end) of the common time of two increasing lists; None if it is a single point or empty."""
    if not len(first) or not len(second):
        return None
    begin, end = max(first[0], second[0]), min(first[-1], second[-1])
    return (begin, end) if end > begin else None


def difference(first, second):
    """Difference of two curves (times, values), interpolated linearly at the times of both; None without a common
    time. Averages are over time, not over rows: rms sqrt(int d^2 dt / T), mean int |d| dt / T."""
    span = common_span(first[0], second[0])
    if span is None:
        return None
    times = np.unique(np.concatenate([first[0], second[0], span]))
    times = times[(times >= span[0]) & (times <= span[1])]
    reference = np.interp(times, *first)
    apart = np.interp(times, *second) - reference
    mean_square = np.trapz(apart**2, times) / (span[1] - span[0])
    mean = np.trapz(np.abs(apart), times) / (span[1] - span[0])
    return Difference(*span, float(np.sqrt(mean_square)), float(np.abs(apart).max()), float(mean),
                      float(np.abs(reference).max()))
