# SPDX-License-Identifier: LGPL-2.1-or-later
"""The panels of the analysis in a report: what applies to a run, drawn. Each `add_*` adds a section or nothing."""
import numpy as np

import curves
import findings
import fluid_fields
import grain_files
import surface
from analysis import (concentration, deposit, dilatancy, energy, pore_pressure, pores, rheology, shear_band, snapshots,
                      weight_balance)
from analysis.once import or_remark
from curves import MARKERS, TIME_LABEL, panel

SURFACES = 5
PRESSURE_FIELDS = 3
PROFILES = 3
CARRIED = (('floor', 'contacts, floor'), ('sides', 'contacts, side walls'), ('inner', 'contacts, walls inside'),
           ('prescribed', 'prescribed grains'), ('fluid', 'liquid'))


def add_all(page, run):
    """In the order of the page. A closed box has neither heap nor slip plane, and a column only once it has slid; a
    suspension has a concentration. What is
    measured on triangles of the plane has no meaning in space."""
    in_plane = (add_deposit, add_shear, add_pores, add_pressure, add_weight, add_energy, add_rheology, add_concentration)
    in_space = (add_deposit, add_pressure, add_weight, add_energy, add_concentration)
    for add in in_space if run.in_space() else in_plane:
        or_remark(run, add.__name__.removeprefix('add_').capitalize(), lambda: add(page, run))


def add_deposit(page, run):
    found = deposit.deposit(run)
    if found is None:
        return
    figure, axes = panel('Surface of the grains', r'$x\,/\,D$', r'$y\,/\,D$')
    series = grain_files.grain_series(run)
    chosen = [series[i] for i in snapshots.evenly(len(series), SURFACES)]
    for k, (time, path) in enumerate(chosen):
        x, height = surface.trimmed(*surface.surface(run, grain_files.read_grains(time, path)))
        axes.plot(x, height, color=curves.in_order(k, len(chosen)), linewidth=1.3,
                  label=rf'$t = {time / run.scale("t_c"):.3g}\,t_c$')
    if found.is_heap:
        deposit.draw(found, axes)
    axes.set(xlim=(0.0, None), ylim=(0.0, None))
    axes.legend(fontsize=8)
    page.heading('Heap' if found.is_heap else 'Surface')
    page.panels([(figure, 'heap')], deposit.caption(found) + ('' if findings.rest_time(run) else ' It still moves.') + (
        ' Highest points of the grains in columns of one D x D, mean over the depth; below half a D the floor '
        'counts as bare.' if run.in_space() else ' Highest point of the grains in each column of one D.'))


def add_shear(page, run):
    found = shear_band.shear_band(run)
    if found is None:
        return
    figure, axes = panel('Shear rate', r'$x\,/\,D$', r'$y\,/\,D$', bar=True)
    figure.colorbar(shear_band.draw(found, axes), ax=axes, label=r'rate $\times\,t_c$')
    now = shear_band.moment(run)
    grid, change = pores.change_per_cell(run, now)
    other, beside = panel('Change of the pores', r'$x\,/\,D$', r'$y\,/\,D$', bar=True)
    limit = max(float(np.nanquantile(np.abs(change), 0.98)) if np.isfinite(change).any() else 0.0, 1e-3)
    image = beside.pcolormesh(*grid.edges(), change, cmap='PuOr', vmin=-limit, vmax=limit)
    other.colorbar(image, ax=beside, label=r'$\delta V / V_0$', extend='both')
    reach = now.centres.max(axis=0) + 2.0
    for place in (axes, beside):
        place.set(xlim=(0.0, reach[0]), ylim=(0.0, reach[1]), aspect='equal')
    page.heading('Slip plane and pores at that time' if found.is_slip_plane else 'Shear and pores while it speeds up')
    page.panels([(figure, 'shear'), (other, 'pore_cells')], shear_band.caption(found)
                + f' Change of the pore volume at constant solid in cells of {grid.cell:g} D since the start.')


def add_pores(page, run):
    found, angles = pores.pore_curve(run), dilatancy.dilatancy(run)
    if found is None:
        return
    figure, axes = panel('Pore volume', r'$\delta x\,/\,x_0$', r'$\delta V\,/\,V_0$')
    axes.plot(found.displacement, found.change, linewidth=1.4, label='column')
    axes.plot(found.void_displacement, found.void_change, linestyle='--', marker='.', linewidth=1.2,
              label='at constant solid')
    axes.axhline(0.0, color='black', linewidth=0.6)
    axes.legend(fontsize=8)
    shown = [(figure, 'pores')]
    text = 'Change of the pore volume against the displacement of the centre of gravity (Topin 2011, Fig. 10).'
    known = pores.change_at(run)
    if known is not None:
        text += f' At δx/x₀ = {pores.AT:g}: {known:+.3g}.'
    if angles is not None:
        figure, axes = panel('Dilatancy angle', TIME_LABEL, 'degrees')
        axes.plot(angles.time, angles.angles(), linewidth=1.4, marker='.')
        axes.axhline(0.0, color='black', linewidth=0.6)
        shown.append((figure, 'dilatancy'))
        first = dilatancy.initial_angle(run)
        text += '' if first is None else f' Dilatancy angle until half of the peak velocity: {first:.3g}°.'
    page.heading('Pores and dilatancy')
    page.panels(shown, text)


def add_pressure(page, run):
    found = pore_pressure.probes(run)
    if found is None:
        return
    page.heading('Pore pressure')
    figure, axes = panel('Pressure at fixed places', TIME_LABEL, r'$p\,/\,(\rho_s - \rho_f)\,g D$')
    for k, (name, values) in enumerate(zip(found.names, found.values.T)):
        axes.plot(found.time, values, label=name, linewidth=1.3, marker=MARKERS[k % len(MARKERS)], markersize=3)
    axes.legend(fontsize=8)
    told = ('Reduced pressure in submerged weights of a layer of solid one D high; negative: it holds the packing '
            'together.')
    maps = [] if run.in_space() else pressure_maps(run)
    page.panels([(figure, 'pressure_probes'), *maps], told + level_told(run, maps))


def level_told(run, maps):
    """What the pressures are relative to where no side of the box fixes a level."""
    if pore_pressure.has_level(run):
        return ''
    if not pore_pressure.has_written_probes(run):
        return ' Relative to the upper right corner.'
    return ' No side of the box fixes its level' + ('; maps are relative to the upper right corner.' if maps else '.')


def pressure_maps(run):
    """At a few times after the start, with one scale."""
    fields = fluid_fields.field_times(run)[1:]
    maps = []
    for time, folder in [fields[i] for i in snapshots.evenly(len(fields), PRESSURE_FIELDS)]:
        try:
            maps.append((time / run.scale('t_c'), pore_pressure.field(run, time, folder)))
        except (ValueError, KeyError, OSError) as error:
            run.remarks.append(f'Pressure at {time:g}: {error}')
    limit = max([1e-3] + [float(np.quantile(np.abs(values), 0.99)) for _, values in maps])
    return [(pressure_map(run, time, values, limit), f'pressure_{k}') for k, (time, values) in enumerate(maps)]


def pressure_map(run, time, values, limit):
    figure, axes = panel(rf'Pressure at $t = {time:.3g}\,t_c$', r'$x\,/\,D$', r'$y\,/\,D$', bar=True)
    width, height = run.size()
    image = axes.imshow(values, origin='lower', extent=(0, width, 0, height), cmap='RdBu_r', vmin=-limit, vmax=limit,
                        interpolation='nearest')
    figure.colorbar(image, ax=axes, extend='both')
    grains = grain_files.grains_at(run, time * run.scale('t_c'))
    if grains is not None:
        axes.plot(*grains.centres.T / run.scale('D'), linestyle='', marker='.', markersize=0.8, color='black', alpha=0.4)
    return figure


def add_weight(page, run):
    found = weight_balance.carriers(run)
    if found is None:
        return
    figure, axes = panel('Who carries the weight', TIME_LABEL, 'share of the weight')
    for k, (name, label) in enumerate(CARRIED):
        values = getattr(found, name)
        if np.abs(values).max() > 1e-6:
            axes.plot(found.time, values, label=label, linewidth=1.3, marker=MARKERS[k], markersize=3)
    axes.plot(found.time, found.rest(), label='none: they accelerate', color='black', linestyle=':', linewidth=1.3)
    axes.legend(fontsize=8)
    profiles = (weight_balance.profile(run, one) for one in reversed(snapshots.snapshots(run)))
    last = next(profile for profile in profiles if profile is not None)
    other, beside = panel(rf'Over the height, $t = {last.time:.3g}\,t_c$', 'share of the weight', r'$y\,/\,D$')
    beside.plot(last.weight, last.level, label='weight above', color='black', linewidth=1.3)
    beside.plot(last.contacts, last.level, label='contacts', linewidth=1.3, marker='.', markersize=3)
    if run.is_wet():
        beside.plot(last.contacts + last.fluid, last.level, label='contacts + liquid', linewidth=1.3, linestyle='--')
    beside.legend(fontsize=8)
    defect = weight_balance.final_defect(run)
    page.heading('Effective stress and weight')
    page.panels([(figure, 'weight'), (other, 'weight_profile')],
                'Vertical forces on the grains over their (submerged) weight; right: on the grains above a level.'
                + (' Contacts are springs: single ones are those of the last sub-step, and only what accelerates the grains '
                   'is of the mean over the window.' if run.has_springs() else '')
                + ('' if defect is None else f' At rest at the end: balanced to {defect:.1e}.'))


def add_energy(page, run):
    found = energy.budget(run)
    if found is None or len(found.time) < 2:  # a grain has left within the first interval
        return
    figure, axes = panel('Energy of the grains', TIME_LABEL, r'energy $/\,(\Sigma m\,u_c^2)$')
    for k, (label, values) in enumerate((('potential energy lost', -found.potential), ('their motion', found.kinetic),
                                         ('to contacts', -found.contacts), ('to the liquid', -found.fluid))):
        if np.abs(values).max() > 0.0:
            axes.plot(found.time, values, label=label, linewidth=1.3, linestyle=curves.dash(k))
    liquid = energy.fluid_kinetic(run)
    if liquid is not None:
        axes.plot(*liquid, label='motion of the liquid', linewidth=1.0, marker='.', color='#888888')
    axes.legend(fontsize=8)
    other, beside = panel('Defect of the budget', TIME_LABEL, 'over the largest term')
    beside.plot(found.time[found.known], np.abs(found.defect()), linewidth=1.3)
    curves.logarithmic(beside)
    page.heading('Energy')
    page.panels([(figure, 'energy'), (other, 'energy_defect')], energy.caption(run, found))


def add_rheology(page, run):
    found = rheology.cells(run) if run.is_avalanche() else None
    if found is None:
        return
    numbers = [('inertial', r'inertial number $I$')] + ([('viscous', r'viscous number $J$')] if run.is_wet() else [])
    shown = []
    for value, label, title in (('friction', r'$\mu$', 'Friction'), ('compacity', r'$\phi$', 'Compacity')):
        for name, axis in numbers:
            figure, axes = panel(title, axis, label, bar=True)
            abscissa, ordinate = getattr(found, name), getattr(found, value)
            cloud = axes.scatter(abscissa, ordinate, c=found.time, s=3, alpha=0.4, cmap='viridis', linewidths=0)
            axes.plot(*rheology.medians(abscissa, ordinate), color='black', marker='o', markersize=3, linewidth=1.2)
            axes.set_xscale('log')
            axes.set_ylim(0.0 if value == 'friction' else None, float(np.quantile(ordinate, 0.99)) * 1.05)
            figure.colorbar(cloud, ax=axes, label=TIME_LABEL).solids.set(alpha=1)
            shown.append((figure, f'{value}_{name}'))
    page.heading('Local rheology')
    page.panels(shown, f'Each point is a cell of {rheology.coarse_grid.CELL:g} D at one output; black: medians. '
                       'Stress of the contacts, rate of the mean velocity gradient.')


def add_concentration(page, run):
    found = concentration.concentration(run) if not run.is_avalanche() else None
    if found is None or len(found.time) < 2:
        return
    figure, axes = panel('Concentration', TIME_LABEL, r'$y\,/\,D$', bar=True)
    axes.grid(False)
    image = axes.pcolormesh(curves.edges_of(found.time), found.edges, found.shares.T, cmap='viridis', vmin=0.0)
    figure.colorbar(image, ax=axes, label='solid share')
    other, beside = panel('Concentration over height', 'solid share', r'$y\,/\,D$')
    middles, chosen = 0.5 * (found.edges[1:] + found.edges[:-1]), snapshots.evenly(len(found.time), 4)
    for k, i in enumerate(chosen):
        beside.plot(found.shares[i], middles, linewidth=1.3, color=curves.in_order(k, len(chosen)),
                    label=rf'$t = {found.time[i]:.3g}\,t_c$')
    beside.legend(fontsize=8)
    bed = concentration.bed(run)
    told = 'the box is empty.' if bed is None else (f'the layers above half of the densest, {bed[0]:.3g} D in all, hold '
                                                    f'{bed[1]:.3g} on average.')
    page.heading('Concentration over height')
    page.panels([(figure, 'concentration'), (other, 'concentration_profiles')],
                f'Solid share of layers of one D. At the end {told}')
