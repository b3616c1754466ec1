# SPDX-License-Identifier: LGPL-2.1-or-later
"""The relaxation time of an avalanche: how long a dense packing waits before it slides.

Topin et al. 2011, section 3.3: the straight line that fits the acceleration phase of the mean velocity meets the time
axis at t_relax. The acceleration phase is where |<u>| rises most steeply over one t_c. Where that is at the end of the
run, the acceleration phase may still come: a steeper line meets the axis later, so that t_relax has a lower bound only.
"""
from dataclasses import dataclass, field

import numpy as np

from analysis import peaks
from analysis.once import once_per_run

FIT = 1.0                     # t_c, length of the fitted phase, or up to the third row of the history if that is later
OTHER_FITS = (0.5, 1.5, 2.0)  # t_c, to see how much it depends on that
LEAST_PEAK = 0.1              # u_c: below, nothing has slid
STEEPER = 1.0 + 1e-9          # a slope that rounding alone makes larger is the same


@dataclass
class Relaxation:
    """u = slope (t - time) from `begin` to `end`; times in t_c, velocities in u_c."""

    time: float      # t_relax
    slope: float
    begin: float
    end: float
    bound: bool = False  # the fit ends with the run: t_relax is later than `time`
    others: list = field(default_factory=list)  # fits of other lengths, over other rows, that overlap this one

    @property
    def times(self):
        """Smallest and largest t_relax of fits of all lengths; None where no fit has other rows, which tells nothing of
        how much the length matters."""
        times = [self.time, *(fit.time for fit in self.others)]
        return (min(times), max(times)) if self.others else None

    @property
    def lengths(self):
        """Shortest and longest of the fits [t_c]."""
        found = [fit.end - fit.begin for fit in (self, *self.others)]
        return min(found), max(found)

    @property
    def spread(self):
        return None if self.times is None else self.times[1] - self.times[0]

    @property
    def text(self):
        return f'> {np.floor(100.0 * self.time) / 100.0:.2f}' if self.bound else f'{self.time:.2f}'


@once_per_run
def relaxation(run):
    """None unless the scales are an avalanche's and it has slid."""
    if not run.is_avalanche():
        return None
    time, velocity = run.column(peaks.COLUMN)
    if len(velocity) < 2 or velocity.max() < LEAST_PEAK:
        return None
    highest = int(velocity.argmax())
    rising = time[:highest + 1], velocity[:highest + 1]
    found = steepest(*rising, FIT)
    if found is None:
        return None
    others = [steepest(*rising, length, near=found) for length in OTHER_FITS]
    # Where rows are far apart, fits of several lengths are one.
    found.others = [fit for fit in others if fit is not None and (fit.begin, fit.end) != (found.begin, found.end)]
    # The last row may come sooner than those before it: less than a row behind the fit, nothing can be fitted.
    found.bound = found.end > time[-1] - (1.0 - 1e-9) * float(np.diff(time[-3:]).max())
    return None if found.bound and found.time <= 0.0 else found  # later than the start tells nothing


def steepest(time, velocity, length, near=None):
    """The steepest least-squares line over the rows of this length, three at least, of those that overlap the fit `near`;
    None if they are too few."""
    best = None
    for first in range(len(time) - 2):
        end = max(time[first] + length, time[first + 2])  # rows need not be equally far apart
        part = slice(first, int(np.searchsorted(time, end + 1e-9 * length, side='right')))
        if time[-1] < end - 1e-9 * length:
            continue
        if near is not None and (time[part][-1] <= near.begin or time[first] >= near.end):
            continue
        slope, level = np.polyfit(time[part], velocity[part], 1)
        if slope > 0.0 and (best is None or slope > STEEPER * best.slope):
            best = Relaxation(float(-level / slope), float(slope), float(time[first]), float(time[part][-1]))
    return best


def relaxation_time(run):
    """t_relax [t_c]; None where the run does not tell it, bounds included."""
    found = relaxation(run)
    return found.time if found and not found.bound else None


def relaxation_bound(run):
    """What t_relax exceeds [t_c], where the run tells a bound only."""
    found = relaxation(run)
    return found.time if found and found.bound else None


def draw(run, axes):
    """The line of the fit, from the time axis to the peak, over a plot of the mean velocity."""
    found = relaxation(run)
    if found is None:
        return
    top = float(run.column(peaks.COLUMN)[1].max())
    axes.plot([found.time, found.time + top / found.slope], [0.0, top], color='black', linewidth=0.8, linestyle='--',
              label=rf'fit, $t_\mathrm{{relax}} {"" if found.bound else "= "}{found.text}\,t_c$')


def caption(run):
    found = relaxation(run)
    if found is None:
        return ''
    if found.bound:
        return (f'Relaxation time {found.text} t_c: the grains accelerate most at the end of the run (t = {found.begin:.2f} '
                f'to {found.end:.2f} t_c), so that the straight fit there bounds it from below.')
    return (f'Relaxation time {found.text} t_c: where the steepest straight fit (t = {found.begin:.2f} to '
            f'{found.end:.2f} t_c) meets the time axis; {bounds_in_words(found)}.')


def bounds_in_words(found):
    if found.times is None:
        return 'the rows are too far apart for fits of other lengths, which would bound it'
    (lowest, highest), (shortest, longest) = found.times, found.lengths
    return f'{lowest:.2f} to {highest:.2f} t_c with fits over {shortest:.2g} to {longest:.2g} t_c'
