# SPDX-License-Identifier: LGPL-2.1-or-later
"""The curves of a report: one table of plots over history.csv, all against t/t_c."""
from dataclasses import dataclass

import numpy as np


# Residuals of lone contacts are round-off; drawn at their value they would flatten everything else.
LOG_FLOOR = 1e-8


@dataclass
class Curve:
    column: str
    label: str


@dataclass
class Plot:
    title: str
    unit: str
    curves: list
    logarithmic: bool = False
    divide_by_height: bool = False  # lengths in D over the height of the domain


PLOTS = [
    Plot('Mean velocity of the grains', 'velocity / u_c',
         [Curve('mean_velocity_y', 'vertical'), Curve('mean_velocity_x', 'horizontal')]),
    Plot('Mean height of the grains', 'height / H', [Curve('mean_position_y', 'mean height')],
         divide_by_height=True),
    Plot('Deepest overlap', 'overlap / D', [Curve('max_penetration', 'max_penetration')]),
    Plot('Contacts with an impulse, and sweeps of the solver', 'count',
         [Curve('contacts', 'contacts'), Curve('contact_iterations', 'sweeps')]),
    Plot('Residuals', 'dimensionless',
         [Curve('contact_residual', 'contact (scaled natural map)'),
          Curve('multiplier_residual', 'multipliers (rms slip / u_c)'),
          Curve('divergence', 'divergence after step 1 (D / u_c)')], logarithmic=True),
    Plot('Iterations of the multiplier problem', 'count',
         [Curve('multiplier_iterations', 'multiplier iterations')]),
    Plot('Wall time of a window', 'seconds',
         [Curve('wall_step', 'window'), Curve('wall_fluid', 'fluid'), Curve('wall_grains', 'grains'),
          Curve('wall_coupling', 'coupling')]),
]


def available(plot, history):
    """The curves of a plot with at least one number in the history."""
    return [curve for curve in plot.curves
            if curve.column in history and np.isfinite(history[curve.column]).any()]


def draw(plot, history, height, axes):
    for curve in available(plot, history):
        values = history[curve.column] / (height if plot.divide_by_height else 1.0)
        if plot.logarithmic:
            values = np.where(values > 0.0, np.maximum(values, LOG_FLOOR), np.nan)
        axes.plot(history['time'], values, label=curve.label, linewidth=1.4)
    if plot.logarithmic:
        axes.set_yscale('log')
    if plot.divide_by_height:
        axes.set_ylim(0.0, 1.0)
    axes.set_title(plot.title, fontsize=10)
    axes.set_xlabel('t / t_c')
    axes.set_ylabel(plot.unit, fontsize=8)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8, frameon=False)
