# SPDX-License-Identifier: LGPL-2.1-or-later
"""The numbers of a report: time of coming to rest, extremes, wall time by participant."""
from dataclasses import dataclass

import numpy as np

# At rest: the mean speed stays below this fraction of its maximum.
REST_FRACTION = 0.01
# Two times are the same within this fraction: series of files tell nine digits, rows ten, and folders of OpenFOAM sums of
# its steps.
SAME_TIME = 1e-8
# (column, name) of the parts of a window's wall time.
PARTICIPANTS = [('wall_fluid', 'fluid'), ('wall_grains', 'grains'), ('wall_coupling', 'coupling')]
# Numbers in the record of a run: windows in which a solver stopped before its tolerance.
UNCONVERGED = (('unconverged_windows', 'the contact solver missed its tolerance'),
               ('unconverged_multiplier_windows', 'the multiplier problem stopped at its iteration limit'),
               ('unconverged_splitting_windows',
                'pressure or viscosity with rigid grains missed fluid.splitting_tolerance'),
               ('unconverged_joint_windows', 'contacts and fluid did not agree to coupling.tolerance'))


def rest_time(run):
    """First output time [t_c] from which the grains are at rest; None if the run ends before, or without grains."""
    time, speed = run.column('mean_speed')
    if len(speed) < 2 or speed.max() == 0.0 or run.end('mean_speed') is None:
        return None
    moving = np.flatnonzero(speed >= REST_FRACTION * speed.max())
    first = moving[-1] + 1
    return time[first] if first < len(time) else None


def has_moved(run):
    speed = run.column('mean_speed')[1]
    return len(speed) == 0 or speed.max() > 0.0


def mean_rest_time(runs):
    """Mean of rest_time over some runs [t_c]; None unless all come to rest."""
    times = [rest_time(run) for run in runs]
    return None if None in times else float(np.mean(times))


def is_at_rest(run, time):
    """Whether an output [t_c] is of grains at rest."""
    since = rest_time(run)
    return since is not None and time >= since * (1.0 - SAME_TIME)


def until(times, end):
    """Which of some outputs, or whether one, is not after a time of the rows [t_c]."""
    return times <= end * (1.0 + SAME_TIME)


def half_fall(run):
    """When the mean height has gone half-way from its first to its last value [t_c]; None unless it falls."""
    time, height = run.column('mean_position_y')
    if len(height) < 2 or height[-1] >= height[0] or run.has_cyclic_floor():
        return None
    half = 0.5 * (height[0] + height[-1])
    after = int(np.argmax(height <= half))
    return float(np.interp(half, height[[after, after - 1]], time[[after, after - 1]]))


def recorded(run, name):
    """One of the `maxima` of run.json; None without it."""
    value = (run.record.get('maxima') or {}).get(name)
    return None if value is None or np.isnan(value) else value


def largest(run, column, in_record=None):
    """Largest value of a quantity over all windows that run.json or the rows of the history tell of; or None. A run that is
    at work or was killed has its maxima only in the rows, and in run.json perhaps those of an earlier part."""
    _, values = run.column(column)
    known = [recorded(run, in_record), values.max() if len(values) else None]
    return max((float(value) for value in known if value is not None), default=None)


def unconverged_windows(run):
    """Number of windows whose contact solve missed its tolerance, by run.json or by the rows, whichever has more; or
    None. Springs solve nothing: their 0 in run.json is no finding."""
    if run.has_springs():
        return None
    _, since = run.column('unconverged')
    known = [recorded(run, 'unconverged_windows'), since.sum() if len(since) else None]
    return max((int(count) for count in known if count is not None), default=None)


def unconverged(run):
    """(what happened, number of windows) of the solvers that the run tells of."""
    counts = {name: recorded(run, name) for name, _ in UNCONVERGED} | {'unconverged_windows': unconverged_windows(run)}
    return [(what, counts[name]) for name, what in UNCONVERGED if counts[name] is not None]


def windows_done(run):
    """By run.json, or by the last row where that is later; None if neither tells it."""
    _, steps = run.column('step')
    known = [run.record.get('windows_done'), steps[-1] if len(steps) else None]
    return max((int(count) for count in known if count is not None), default=None)


def covers_all(run):
    """Whether the maxima of run.json are over all windows that the run tells of. One that was killed or is at work has none
    there, or those of its earlier part."""
    return bool(run.record.get('maxima')) and run.record.get('windows_done') in (None, windows_done(run))


def extent(run):
    """Which windows the largest values are of, to be put after "of" or "in"."""
    return 'any window' if covers_all(run) else 'the earlier parts and the rows' if run.record.get('maxima') else 'the rows'


def of_worst(runs, measure):
    """The largest value of measure(run) over some runs; None if none has it."""
    return max((value for value in map(measure, runs) if value is not None), default=None)


@dataclass
class WallTime:
    """Rows of a history with wall times; seconds per window, each a mean since the previous row."""

    time: np.ndarray     # t_c
    windows: np.ndarray  # covered by a row
    window: np.ndarray
    parts: dict          # name of a participant: seconds per window

    def rest(self):
        """The remaining time of a window; 0 if participants overlap by more than that."""
        return np.maximum(0.0, self.window - sum(self.parts.values()))

    def overlaps(self):
        """True if participants work at the same time for a notable part of the run (5 %)."""
        return self.total(sum(self.parts.values())) > 1.05 * self.total(self.window)

    def total(self, seconds):
        """Seconds of the run."""
        return float((seconds * self.windows).sum())


def wall_time(run):
    """None if the history has no wall time."""
    if run.history is None or 'wall_step' not in run.history:
        return None
    given = np.isfinite(run.history['wall_step'])
    if not given.any():
        return None
    windows = np.diff(run.history['step'], prepend=0.0)
    parts = {name: np.nan_to_num(run.history[column][given]) for column, name in PARTICIPANTS
             if len(run.column(column)[1])}
    return WallTime(run.history['time'][given], windows[given], run.history['wall_step'][given], parts)


def wall_seconds(run):
    """Wall time (of the run, mean per window), over the windows covered by the history."""
    wall = wall_time(run)
    if wall is None:
        return None, None
    total = wall.total(wall.window)
    return total, total / float(wall.windows.sum())
