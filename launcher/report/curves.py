# SPDX-License-Identifier: LGPL-2.1-or-later
"""The curves of a report: tables of plots over history.csv, all against t/t_c."""
from dataclasses import dataclass, field

import matplotlib.pyplot as plt
import numpy as np

import findings
from analysis import relaxation

# Residuals of single contacts are round-off; drawn at their value they would compress all other curves.
LOG_FLOOR = 1e-16
TIME_LABEL = r'$t\,/\,t_c$'
PANEL = (5.4, 3.5)  # inches: its text reads at 420 pixels
LARGEST = 'largest of any window'
MARKERS = 'os^Dv<>P'
DASHES = ('-', '--', '-.', ':', (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (3, 3)))


@dataclass
class Curve:
    column: str
    label: str
    largest: str = ''  # in `maxima` of run.json: over all windows, of which the rows are some


@dataclass
class Plot:
    title: str
    unit: str
    curves: list = field(default_factory=list)
    logarithmic: bool = False
    divide_by_height: bool = False  # lengths in D over the height of the domain
    relaxation: bool = False        # with the fit of relaxation.py
    in_space: str = ''              # the unit there, if it is another
    of_springs: tuple = ()          # title and unit where springs act in sub-steps instead of a contact solver

    def title_of(self, run):
        return self.of_springs[0] if self.of_springs and run.has_springs() else self.title

    def unit_of(self, run):
        unit = self.of_springs[1] if self.of_springs and run.has_springs() else self.unit
        return self.in_space if self.in_space and run.in_space() else unit


# Fig. 3 of Topin et al. 2011.
SETTLING = [
    Plot('(a) Mean vertical velocity', r'$\langle u_y \rangle\,/\,u_c$',
         [Curve('mean_velocity_y', '')]),
    Plot('(b) Mean vertical position', r'$\langle y \rangle\,/\,H$', [Curve('mean_position_y', '')],
         divide_by_height=True),
]

# Fig. 8 of Topin et al. 2011.
COLLAPSE = [
    Plot('(a) Mean velocity', r'$\langle u \rangle\,/\,u_c$',
         [Curve('mean_velocity_norm', r'norm $|\langle u \rangle|$'),
          Curve('mean_velocity_x', r'$\langle u_x \rangle$'),
          Curve('mean_velocity_y', r'$\langle u_y \rangle$')], relaxation=True),
    Plot('(b) Extent', r'length $/\,D$',
         [Curve('front_x', r'front, $\max(x+R)$'), Curve('mean_position_x', r'$\langle x \rangle$'),
          Curve('mean_position_y', r'$\langle y \rangle$')]),
]

MOTION = [
    Plot('Speed of the grains', r'speed $/\,u_c$',
         [Curve('mean_velocity_norm', r'of the mean, $|\langle u \rangle|$'),
          Curve('mean_speed', r'mean, $\langle |u| \rangle$')]),
    Plot('Kinetic energy', r'energy $/\,(\Sigma m\,u_c^2)$', [Curve('kinetic_energy', '')]),
    Plot('Deepest overlap', r'overlap $/\,D$', [Curve('max_penetration', '', largest='penetration')]),
    Plot('Contacts with an impulse', 'count', [Curve('contacts', '')]),
]

# Averages over the contacts, at the output times.
NETWORK = [
    Plot('Coordination', 'contacts per grain', [Curve('coordination', '')]),
    Plot('Stress in the packing', r'stress $/\,(\rho_s g D)$',
         [Curve('sigma_xx', r'$\sigma_{xx}$'), Curve('sigma_yy', r'$\sigma_{yy}$'),
          Curve('sigma_xy', r'$\sigma_{xy}$'), Curve('sigma_zz', r'$\sigma_{zz}$')]),
    Plot('Anisotropy of the contacts', 'fabric anisotropy', [Curve('fabric_anisotropy', '')]),
    Plot('Pores between the grains', r'area $/\,D^2$', [Curve('pore_volume', '')], in_space=r'volume $/\,D^3$'),
]

SOLVERS = [
    Plot('Residuals', 'dimensionless',
         [Curve('contact_residual', 'contact (scaled natural map)'),
          Curve('multiplier_residual', r'multipliers (rms slip $/\,u_c$)'),
          Curve('divergence', r'divergence after step 1 ($\times D/u_c$)', largest='divergence'),
          Curve('remaining_divergence', r'rms divergence with rigid grains ($\times D/u_c$)'),
          Curve('joint_mismatch', 'joint: grains against fluid', largest='joint_mismatch')], logarithmic=True),
    Plot('Momentum checks', 'relative defect',
         [Curve('grain_balance', r'grains: $M\,dU/dt = (M-m_f)g + F_c + F_h$', largest='grain_balance'),
          Curve('fluid_balance', 'fluid: multipliers and boundaries', largest='fluid_balance')], logarithmic=True),
    Plot('Contact solver', 'sweeps', [Curve('contact_iterations', '')],
         of_springs=('Springs', 'sub-steps of a window')),
    Plot('Multiplier solver', 'iterations', [Curve('multiplier_iterations', 'multipliers'),
                                             Curve('pressure_iterations', 'pressure with rigid grains'),
                                             Curve('joint_rounds', 'joint rounds')]),
]


def panels(run, plots, section):
    """(figure, name) of each of the plots for which the history has numbers."""
    shown = []
    for plot in plots:
        if available(plot, run):
            result, axes = bare_panel()
            draw(plot, run, axes)
            shown.append((result, f'{section}-{available(plot, run)[0].column}'))
    return shown


def available(plot, run):
    """The curves of a plot with at least one number in the history."""
    return [curve for curve in plot.curves if len(run.column(curve.column)[1])]


def draw(plot, run, axes):
    height = run.size()[1] if plot.divide_by_height and 'domain.size' in run.case else None
    curves = available(plot, run)
    for k, curve in enumerate(curves):
        time, values = run.column(curve.column)
        line, = axes.plot(time, values / height if height else values, label=curve.label, linewidth=1.4, linestyle=dash(k),
                          marker='.' if len(values) == 1 else None)
        draw_largest(run, curve, axes, line.get_color())
    decorate(axes, plot.title_of(run), plot.unit_of(run) if height or not plot.divide_by_height else r'$\langle y \rangle\,/\,D$')
    if plot.logarithmic:
        logarithmic(axes)
    if height:
        axes.set_ylim(0.0, 1.0)
    if plot.relaxation:
        relaxation.draw(run, axes)
    names = axes.get_legend_handles_labels()[1]
    if len(names) > 1 or LARGEST in names:
        axes.legend(fontsize=8)


def draw_largest(run, curve, axes, colour):
    """Dotted, in the colour of the curve: between two rows there may be windows with larger values."""
    value = findings.recorded(run, curve.largest) if findings.covers_all(run) else None
    if value:
        said = LARGEST in axes.get_legend_handles_labels()[1]
        axes.axhline(value, color=colour, linestyle=':', linewidth=1.2, label=None if said else LARGEST)


def bare_panel(size=PANEL, right=0.97):
    """A figure of one plot with fixed margins, and its axes: finding the margins takes longer than the drawing."""
    result, axes = plt.subplots(figsize=size)
    result.subplots_adjust(left=0.83 / size[0], right=right, bottom=0.55 / size[1], top=1.0 - 0.35 / size[1])
    return result, axes


def panel(title, x_label, y_label, size=PANEL, bar=False):
    """A figure of one plot, and its axes; with room for a colour bar and its label if asked for."""
    result, axes = bare_panel(size, 0.9 if bar else 0.97)
    decorate(axes, title, y_label)
    axes.set_xlabel(x_label)
    return result, axes


def dash(i):
    """A style of line of its own, so that coinciding curves show."""
    return DASHES[i % len(DASHES)]


def in_order(i, count):
    """A colour for the i-th of several times."""
    return plt.get_cmap('viridis')(0.9 * i / max(1, count - 1))


def edges_of(middles):
    """Half-way between the middles, and as far beyond the first and the last."""
    between = 0.5 * (middles[1:] + middles[:-1])
    return np.concatenate([[2 * middles[0] - between[0]], between, [2 * middles[-1] - between[-1]]])


def decorate(axes, title, unit):
    axes.set_title(title, fontsize=10)
    axes.set_xlabel(TIME_LABEL)
    axes.set_ylabel(unit)
    axes.grid(alpha=0.3)
    axes.tick_params(labelsize=9)
    axes.ticklabel_format(axis='y', scilimits=(-3, 4), useMathText=True)  # wide numbers push the label out of the margin


def logarithmic(axes):
    """Zeros cannot be drawn and values below round-off are meaningless: both are removed from the curve."""
    positive = False
    for line in axes.lines:
        values = np.asarray(line.get_ydata(), dtype=float)
        line.set_ydata(np.where(values > LOG_FLOOR, values, np.nan))
        positive = positive or (values > LOG_FLOOR).any()
    if positive:
        axes.set_yscale('log')
        axes.relim()
        axes.autoscale_view()
        at_least_a_decade(axes)


def at_least_a_decade(axes):
    """With less, ticks like 6 x 10^-4 are labelled too, which push the label of the axis out of the margin."""
    low, high = axes.get_ylim()
    if high < 10.0 * low:
        axes.set_ylim(10.0**np.floor(np.log10(low)) / 1.2, 10.0**np.ceil(np.log10(high)) * 1.2)
