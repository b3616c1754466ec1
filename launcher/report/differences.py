# SPDX-License-Identifier: LGPL-2.1-or-later
"""Differences between the histories of two runs."""
from dataclasses import dataclass

import numpy as np

SAME_TIME = 1e-9  # of the larger end of the common span


@dataclass
class Difference:
    """Difference of a quantity q(t) from that of the first run, over their common time; `scale` is the largest |q| of
    the first run's own rows there. Relative values are None if that is 0."""

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


def integral_of_square(times, values):
    """int q^2 dt of q linear between the times: h (a^2 + a b + b^2)/3 from a to b."""
    a, b = values[:-1], values[1:]
    return float((np.diff(times) * (a**2 + a * b + b**2)).sum() / 3.0)


def integral_of_size(times, values):
    """int |q| dt of q linear between the times: two triangles where it changes its sign."""
    a, b = values[:-1], values[1:]
    size = np.abs(a) + np.abs(b)
    crossing = a * b < 0.0
    mean = 0.5 * np.divide(a**2 + b**2, size, out=size.copy(), where=crossing)
    return float((np.diff(times) * mean).sum())


def compared_times(first, second):
    """Where two curves with these increasing times are compared, and the span of these times; (None, None) without a common
    one. At the rows of the one that has fewer in the common span: what the other has in between is curvature to the one
    and no difference. Where fewer than two are there, at the rows of both and the ends of the span."""
    span = common_span(first, second)
    if span is None:
        return None, None
    tolerance = SAME_TIME * max(abs(span[0]), abs(span[1]))
    inside = [times[(times >= span[0] - tolerance) & (times <= span[1] + tolerance)] for times in (first, second)]
    times = np.unique(np.clip(min(inside, key=len), *span))
    if len(times) < 2:
        times = np.unique(np.clip(np.concatenate([*inside, span]), *span))
    return times, (float(times[0]), float(times[-1]))


def difference(first, second):
    """Difference of two curves (times, values), linear between the times at which they are compared; None without a
    common time. Averages are over time, not over rows: rms sqrt(int d^2 dt / T), mean int |d| dt / T."""
    times, span = compared_times(first[0], second[0])
    if span is None:
        return None
    reference = np.interp(times, *first)
    apart = np.interp(times, *second) - reference
    mean_square = integral_of_square(times, apart) / (span[1] - span[0])
    mean = integral_of_size(times, apart) / (span[1] - span[0])
    return Difference(*span, float(np.sqrt(mean_square)), float(np.abs(apart).max()), float(mean),
                      largest_size(first, common_span(first[0], second[0])))


def largest_size(curve, span):
    """Largest |q| of a curve (times, values) within a span, at its own rows and at the ends: rows of a coarser curve
    may miss its peak."""
    times, values = curve
    inside = values[(times >= span[0]) & (times <= span[1])]
    return float(np.abs(np.append(inside, np.interp(span, times, values))).max())
