# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures 1-3 and 5-10 of the paper in its layout. Each returns a matplotlib figure, or None where a run is missing.
(Figure 4 is the drawing of the lattice.)"""
import matplotlib.pyplot as plt
import numpy as np

import curves
import pictures
from analysis import pores
from paper import darcy, waiting
from paper.selection import COLUMNS, COMPACITIES, DENSE, LOOSE, REYNOLDS

SEDIMENTATION = (('discs-nscd', 'discs, NSCD'), ('discs-md', 'discs, MD'), ('triangles-nscd', 'triangles, NSCD'),
                 ('triangles-md', 'triangles, MD'))
DENSITY_RATIO = 1.5
OPEN, CLOSED = COLUMNS


def all_figures(runs):
    """[(number, caption, figure)] of those that can be drawn. Figures 8 to 10 are drawn of both sets of columns, those
    of closed pores with the letter c."""
    made = [(1, 'Sedimentation of 300 discs: vertical velocity of the fluid.',
             sequence(runs.of('sedimentation', variant='discs-nscd'))),
            (2, 'Sedimentation of 300 triangles: vertical velocity of the fluid.',
             sequence(runs.of('sedimentation', variant='triangles-nscd'))),
            (3, 'Sedimentation: (a) mean vertical velocity, (b) mean vertical position; bands: seeds.', settling(runs)),
            (5, f'Collapse of the loosest column in the liquid, φ = 0.785, Re = 89{told_conditions(runs, "run-out")}.',
             sequence(runs.of('run-out', compacity=LOOSE))),
            (6, f'Collapse of the densest column in the liquid, φ = 0.906, Re = 89{told_conditions(runs, "run-out")}.',
             sequence(runs.of('run-out', compacity=DENSE))),
            (7, f'The loosest column in a small closed box{told_conditions(runs, "closed")}.', sequence(runs.of('closed')))]
    made += figures_of_columns(runs, '') + figures_of_columns(runs.with_columns(CLOSED), 'c')
    return [(number, caption, figure) for number, caption, figure in made if figure is not None]


def figures_of_columns(runs, letter):
    how = told_conditions(runs, runs.columns)
    lines = f'lines: fits from φ = {waiting.LEAST_WAITING}'
    estimate = '; dotted: time of the liquid to flow into a dilating layer (darcy.py), without fitted numbers'
    return [(f'8{letter}', f'Norm of the mean velocity: (a) dry, (b) to (d) in a liquid{how}; bands: seeds.',
             velocities(runs)),
            (f'9{letter}', f'Relaxation time against compacity{how}; bars: fits over 0.5 to 2 t_c; arrows: bounds of columns '
             'that have not slid or accelerate most at the end of the run; '
             f'{lines}{estimate if runs.columns == OPEN else ""}.', relaxation_times(runs)),
            (f'10{letter}', f'Pore volume against the displacement of the centre of gravity, Re = 89{how}.',
             pore_volume(runs))]


def told_conditions(runs, part):
    conditions = runs.conditions(part)
    return f' ({conditions})' if conditions else ''


def sequence(found):
    """Pictures at six times."""
    chosen = pictures.instants(found[0]) if found else []
    return pictures.figure(found[0], [pictures.load(found[0], instant) for instant in chosen]) if chosen else None


def settling(runs):
    members = [(label, runs.member('sedimentation', variant=variant)) for variant, label in SEDIMENTATION]
    members = [(label, member) for label, member in members if member is not None]
    if not members:
        return None
    figure, axes = plt.subplots(1, 2, figsize=(10.0, 3.8), layout='constrained')
    for k, (label, member) in enumerate(members):
        height = member.data.size()[1]
        line(axes[0], k, label, member, 'mean_velocity_y', 1.0)
        line(axes[1], k, label, member, 'mean_position_y', height)
    curves.decorate(axes[0], '(a)', r'$\langle u_y \rangle\,/\,u_c$')
    curves.decorate(axes[1], '(b)', r'$\langle y \rangle\,/\,H$')
    axes[1].set_ylim(0.0, 1.0)
    axes[0].legend(fontsize=8)
    return figure


def line(axes, k, label, member, column, unit):
    time, values = member.data.column(column)
    axes.plot(time, values / unit, label=label, color=f'C{k}', linestyle=curves.dash(k), linewidth=1.4)
    if member.is_group():
        time, low, high = member.band(column)
        axes.fill_between(time, low / unit, high / unit, color=f'C{k}', alpha=0.18, linewidth=0.0)


def velocities(runs):
    figure, axes = plt.subplots(2, 2, figsize=(10.0, 7.0), layout='constrained', sharex=True)
    panels = [('(a) dry', 'dry', {})] + [(f'({letter}) Re = {reynolds}', runs.columns, {'reynolds': reynolds})
                                         for letter, reynolds in zip('bcd', REYNOLDS)]
    drawn = 0
    for (title, part, values), place in zip(panels, axes.flat):
        for k, compacity in enumerate(COMPACITIES):
            member = runs.member(part, compacity=compacity, **values)
            if member is not None:
                line(place, k, rf'$\phi = {compacity}$', member, 'mean_velocity_norm', 1.0)
                drawn += part == runs.columns or runs.columns == OPEN
        curves.decorate(place, title, r'$|\langle u_s \rangle|\,/\,u_c$')
        if place.get_legend_handles_labels()[1]:
            place.legend(fontsize=8)
        place.set_xlim(0.0, 20.0)
    if drawn:
        return figure
    plt.close(figure)
    return None


def relaxation_times(runs):
    figure, axes = curves.panel('', r'$\phi$', r'$t_\mathrm{relax}\,/\,t_c$', size=(8.0, 4.2))
    for k, reynolds in enumerate(REYNOLDS):
        draw_waits(axes, k, reynolds, [(float(phi), one) for phi in COMPACITIES
                                       for one in waiting.waits(runs, reynolds, phi)])
        fit = waiting.line(runs, reynolds, COMPACITIES)
        if fit is not None:
            x = np.array([fit.compacities[0], fit.compacities[-1]])
            axes.plot(x, fit.slope * x + fit.level, color=f'C{k}', linestyle=curves.dash(k), linewidth=1.2)
    if not axes.get_legend_handles_labels()[1]:
        plt.close(figure)
        return None
    if runs.columns == OPEN:
        draw_estimate(axes, darcy.permeabilities(runs))
    # Beside the axes: points, bounds and lines together reach every corner.
    axes.legend(fontsize=8, loc='upper left', bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0)
    figure.subplots_adjust(right=0.78)
    return figure


def draw_waits(axes, k, reynolds, found):
    """Points with bars, and arrows upwards from bounds."""
    known, bounds = ([(phi, one) for phi, one in found if one.bound == bound] for bound in (False, True))
    if known:
        axes.errorbar([phi for phi, _ in known], [one.time for _, one in known],
                      yerr=np.array([bar(one) for _, one in known]).T, linestyle='',
                      marker=curves.MARKERS[k], capsize=3, color=f'C{k}', label=rf'$Re_c = {reynolds}$')
    if bounds:
        aside = 0.0006 * (k - 1)  # those of several Re stand at the end of the runs
        axes.plot([phi + aside for phi, _ in bounds], [one.time for _, one in bounds], linestyle='',
                  marker=r'$\uparrow$', markersize=9, color=f'C{k}', label=rf'$Re_c = {reynolds}$, longer')


def bar(one):
    """How far the bounds of a waiting time are below and above it; nan, which is not drawn, without bounds."""
    low, high = one.bounds or (np.nan, np.nan)
    return one.time - low, high - one.time


def draw_estimate(axes, lattices):
    """The estimate of darcy.py, dotted; nothing without its permeabilities."""
    if lattices is None:
        return
    bottom, top = axes.get_ylim()
    for k, reynolds in enumerate(REYNOLDS):
        phi = np.linspace(float(LOOSE), float(DENSE), 100)
        axes.plot(phi, darcy.time_to_dilate(phi, float(reynolds), DENSITY_RATIO, lattices), color=f'C{k}', linestyle=':',
                  linewidth=1.0, label=rf'Darcy, $Re_c = {reynolds}$')
    axes.set_ylim(bottom, 1.3 * top)


def pore_volume(runs):
    figure, axes = curves.panel('', r'$\delta x\,/\,x_0$', r'$\delta V\,/\,V_0$', size=(6.5, 4.2))
    for k, compacity in enumerate(COMPACITIES):
        found = [pores.pore_curve(run) for run in runs.immersed(compacity=compacity, reynolds='89')]
        for seed, curve in enumerate(curve for curve in found if curve is not None):
            axes.plot(curve.displacement, curve.change, label=None if seed else rf'$\phi = {compacity}$', color=f'C{k}',
                      linestyle=curves.dash(k), linewidth=1.4)
    axes.axhline(0.0, color='black', linewidth=0.6)
    if axes.get_legend_handles_labels()[1]:
        axes.legend(fontsize=8)
        return figure
    plt.close(figure)
    return None
