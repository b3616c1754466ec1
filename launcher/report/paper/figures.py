# SPDX-License-Identifier: LGPL-2.1-or-later
"""Figures 1-3 and 5-10 of the paper in its layout. Each returns a matplotlib figure, or None where a run is missing.
(Figure 4 is the drawing of the lattice.)"""
import matplotlib.pyplot as plt
import numpy as np

import curves
import pictures
import relaxation
from analysis import pores
from paper import darcy
from paper.selection import COMPACITIES, DENSE, LOOSE, REYNOLDS

SEDIMENTATION = (('discs-nscd', 'discs, NSCD'), ('discs-md', 'discs, MD'), ('triangles-nscd', 'triangles, NSCD'),
                 ('triangles-md', 'triangles, MD'))
DENSITY_RATIO = 1.5
LEAST_WAITING = 0.829  # the dense behaviour: phi from here on (section 3.3)


def all_figures(runs):
    """[(number, caption, figure)] of those that can be drawn."""
    made = [(1, 'Sedimentation of 300 discs: vertical velocity of the fluid.',
             sequence(runs.of('sedimentation', variant='discs-nscd'))),
            (2, 'Sedimentation of 300 triangles: vertical velocity of the fluid.',
             sequence(runs.of('sedimentation', variant='triangles-nscd'))),
            (3, 'Sedimentation: (a) mean vertical velocity, (b) mean vertical position; bands: seeds.', settling(runs)),
            (5, 'Collapse of the loosest column in the liquid (φ = 0.785, Re = 89).',
             sequence(runs.of('run-out', compacity=LOOSE))),
            (6, 'Collapse of the densest column in the liquid (φ = 0.906, Re = 89).',
             sequence(runs.of('run-out', compacity=DENSE))),
            (7, 'The loosest column in a small closed box.', sequence(runs.of('closed'))),
            (8, 'Norm of the mean velocity: (a) dry, (b) to (d) in a liquid; bands: seeds.', velocities(runs)),
            (9, 'Relaxation time against compacity; bars: fits over 0.5 to 2 t_c; lines: fits from φ = 0.829; '
             'dotted: time of the liquid to flow into a dilating layer (darcy.py), without fitted numbers.',
             waiting(runs)),
            (10, 'Pore volume against the displacement of the centre of gravity, Re = 89.', pore_volume(runs))]
    return [(number, caption, figure) for number, caption, figure in made if figure is not None]


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
    panels = [('(a) dry', 'dry', {})] + [(f'({letter}) Re = {reynolds}', 'immersed', {'reynolds': reynolds})
                                         for letter, reynolds in zip('bcd', REYNOLDS)]
    drawn = 0
    for (title, part, values), place in zip(panels, axes.flat):
        for k, compacity in enumerate(COMPACITIES):
            member = runs.member(part, compacity=compacity, **values)
            if member is not None:
                line(place, k, rf'$\phi = {compacity}$', member, 'mean_velocity_norm', 1.0)
                drawn += 1
        curves.decorate(place, title, r'$|\langle u_s \rangle|\,/\,u_c$')
        if place.get_legend_handles_labels()[1]:
            place.legend(fontsize=8)
        place.set_xlim(0.0, 20.0)
    if drawn:
        return figure
    plt.close(figure)
    return None


def waiting_times(runs, reynolds):
    """(compacities, relaxation.Relaxation) of the columns that have slid; the loosest always counts."""
    found = [(float(phi), relaxation.relaxation(run)) for phi in COMPACITIES
             for run in runs.of('immersed', compacity=phi, reynolds=reynolds)]
    return [(phi, one) for phi, one in found if one is not None]


def waiting_line(runs, reynolds):
    """(slope [t_c], level, R^2) of t_relax against phi from 0.829 on; None where fewer than two compacities have slid,
    R^2 None where only two have."""
    points = np.array([(phi, one.time) for phi, one in waiting_times(runs, reynolds) if phi >= LEAST_WAITING])
    if len(points) == 0 or len(set(points[:, 0])) < 2:
        return None
    slope, level = np.polyfit(*points.T, 1)
    rest = points[:, 1] - slope * points[:, 0] - level
    total = ((points[:, 1] - points[:, 1].mean())**2).sum()
    if len(set(points[:, 0])) < 3:
        return float(slope), float(level), None
    return float(slope), float(level), float(1.0 - (rest**2).sum() / total) if total > 0.0 else 0.0


def waiting(runs):
    figure, axes = curves.panel('', r'$\phi$', r'$t_\mathrm{relax}\,/\,t_c$', size=(6.5, 4.2))
    for k, reynolds in enumerate(REYNOLDS):
        points = waiting_times(runs, reynolds)
        if not points:
            continue
        phi, times = np.array([(phi, one.time) for phi, one in points]).T
        ends = np.array([(one.time - one.lowest, one.highest - one.time) for _, one in points]).T
        axes.errorbar(phi, times, yerr=ends, linestyle='', marker=curves.MARKERS[k], capsize=3, color=f'C{k}',
                      label=rf'$Re_c = {reynolds}$')
        fit = waiting_line(runs, reynolds)
        if fit is not None:
            x = np.array([max(LEAST_WAITING, phi.min()), phi.max()])
            axes.plot(x, fit[0] * x + fit[1], color=f'C{k}', linestyle=curves.dash(k), linewidth=1.2)
    if not axes.get_legend_handles_labels()[1]:
        plt.close(figure)
        return None
    bottom, top = axes.get_ylim()
    for k, reynolds in enumerate(REYNOLDS):
        phi = np.linspace(float(LOOSE), float(DENSE), 100)
        axes.plot(phi, darcy.time_to_dilate(phi, float(reynolds), DENSITY_RATIO), color=f'C{k}', linestyle=':',
                  linewidth=1.0, label=rf'Darcy, $Re_c = {reynolds}$')
    axes.set_ylim(bottom, 1.3 * top)
    axes.legend(fontsize=8)
    return figure


def pore_volume(runs):
    figure, axes = curves.panel('', r'$\delta x\,/\,x_0$', r'$\delta V\,/\,V_0$', size=(6.5, 4.2))
    for k, compacity in enumerate(COMPACITIES):
        for run in runs.of('immersed', compacity=compacity, reynolds='89'):
            found = pores.pore_curve(run)
            if found is not None:
                axes.plot(found.displacement, found.change, label=rf'$\phi = {compacity}$', linestyle=curves.dash(k),
                          linewidth=1.4)
    axes.axhline(0.0, color='black', linewidth=0.6)
    if axes.get_legend_handles_labels()[1]:
        axes.legend(fontsize=8)
        return figure
    plt.close(figure)
    return None
