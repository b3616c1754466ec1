# SPDX-License-Identifier: LGPL-2.1-or-later
"""The heap that an avalanche leaves: run-out, height and slope of its free surface (Topin et al. 2011, section 3.2:
"the final spreading length").

The surface, followed to the right from its highest column of one D, first meets bare floor: single grains beyond do
not count. The foot is the farthest point of the grains that begin left of that floor. Run-out: (foot at the end - foot at
the start) / foot at the start. All of it is for columns that stand at the left side and, in space, fill the depth.
"""
from dataclasses import dataclass

import numpy as np

import grain_files
import run_data
import surface
from analysis.once import once_per_run

FITTED = (0.1, 0.9)  # of the height: the part of the surface whose slope is fitted
FEWEST_COLUMNS = 3
STEEPEST = 50.0        # degrees: loose grains do not rest on a steeper slope
SPREAD = 0.5           # D: a foot that moves by less only settles
NEAR = 1.5             # D: grains of a column at a side are not farther from it
STRAIGHT = 0.8         # least share of the variance that the line explains: a column that still stands has no slope


@dataclass
class Deposit:
    """Lengths in D; `slope` in degrees, positive where the surface falls to the right, None if too short to fit."""

    time: float  # t_c
    x: np.ndarray
    height: np.ndarray
    first_foot: float
    foot: float
    top: float
    slope: float
    line: tuple  # (level at x = 0, rise per D) of the fit, or None

    @property
    def run_out(self):
        return (self.foot - self.first_foot) / self.first_foot

    @property
    def lengthening(self):
        """The other reading of a spreading length: that of the whole heap over that of the column."""
        return self.foot / self.first_foot

    @property
    def is_heap(self):
        """It has spread, and a slope at which grains can rest: a column that stands or falls, or a layer, is none."""
        return self.line is not None and self.foot > self.first_foot + SPREAD and self.slope <= STEEPEST

    @property
    def fits(self):
        """Bare floor is left between the foot and the right side of the box."""
        return covered(self.height) < len(self.height)


@once_per_run
def deposit(run):
    """At the last output of an avalanche from the left side; None without grains or domain."""
    if not run.is_avalanche() or 'domain.size' not in run.case or not stands_at_left(run):
        return None
    series = grain_files.quiet_series(run)
    last, first = (surface.last_grains(run), grain_files.read_grains(*series[0])) if series else (None, None)
    if last is None:
        return None
    (x, height), (_, before) = surface.surface(run, last), surface.surface(run, first)
    if not height.any() or not before.any():
        return None
    line = fitted_line(x, height)
    slope = None if line is None else float(np.degrees(np.arctan(-line[1])))
    return Deposit(last.time / run.scale('t_c'), x, height, foot_of(run, first, before), foot_of(run, last, height),
                   float(height.max()), slope, line)


def stands_at_left(run):
    """Whether lengths from the left side are lengths of the column, and means over the depth are heights of it."""
    extent = run_data.first_extent(run)
    if extent is None:
        return False
    low, high = extent
    fills_depth = not run.in_space() or (low[2] <= NEAR and high[2] >= run.depth() - NEAR)
    return run.case.get('domain.left') not in ('free', 'cyclic') and low[0] <= NEAR and fills_depth


def covered(height):
    """How many columns lie before the first one of bare floor to the right of the highest."""
    highest = int(height.argmax())
    bare = np.flatnonzero(height[highest:] == 0.0)
    return highest + int(bare[0]) if len(bare) else len(height)


def foot_of(run, grains, height):
    """Farthest point of the grains that begin left of bare floor, at most the side of the box [D]."""
    left, right = surface.ends_along_x(run, grains)
    return float(min(right[left < covered(height)].max(), run.size()[0]))


def fitted_line(x, height):
    """Least-squares (level, rise) of the surface from its highest column to the foot, between a tenth and nine tenths
    of its height; None for fewer than three columns, or where a line does not describe it."""
    highest, low, high = int(height.argmax()), *(part * height.max() for part in FITTED)
    columns = np.arange(len(x))
    side = (columns >= highest) & (columns < covered(height)) & (height >= low) & (height <= high)
    if side.sum() < FEWEST_COLUMNS:
        return None
    rise, level = np.polyfit(x[side], height[side], 1)
    rest = height[side] - level - rise * x[side]
    if (rest**2).sum() > (1.0 - STRAIGHT) * ((height[side] - height[side].mean())**2).sum():
        return None
    return float(level), float(rise)


def draw(found, axes):
    """The fitted line, within the height of the heap."""
    if found.line is None:
        return
    level, rise = found.line
    heights = np.array([part * found.top for part in FITTED])
    axes.plot((heights - level) / rise, heights, color='black', linestyle='--', linewidth=1.0,
              label=rf'fit, ${found.slope:.1f}\degree$')


def caption(found):
    text = (f'{"Heap" if found.is_heap else "Surface"} at t = {found.time:.4g} t_c: foot at {found.foot:.4g} D, at first {found.first_foot:.4g} D '
            f'(run-out {found.run_out:.3g}), height {found.top:.4g} D')
    return text + ('.' if found.slope is None else f', slope {found.slope:.3g}°.')
